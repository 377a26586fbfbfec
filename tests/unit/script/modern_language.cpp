// FISH of newer versions: each construct with its value, and each mistake with its message.
#include "fake_world.hpp"

#include <ctime>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

namespace kaya::script::test {
namespace {

using ::testing::HasSubstr;

/// The text that FISH shows for the value of a modern function with these lines.
std::string shown(const std::string& body) {
    Stage s;
    s.fish("fish define f\n" + body + "\nend\n");
    return std::get<std::string>(s.value("[string(f)]"));
}

struct Case {
    const char* body;
    const char* value;
};

TEST(ModernFish, EachConstructHasItsValue) {
    const Case cases[] = {
        // arithmetic
        {"f = 7 / 2", "3.5"},
        {"f = 6 / 3", "2"},
        {"f = 7 // 2", "3"},
        {"f = -7 // 2", "-4"},
        {"f = 7 % 4", "3"},
        {"f = 7.5 // 2", "3"},
        {"f = 2 * 3 // 4", "1"},
        {"local a = 2\na += 3\na *= 4\na -= 2\na /= 4\nf = a", "4.5"},
        {"local a := 2\nf = a", "2"},
        {"f = 1 < 2 and 2 < 1 or not 0", "1"},
        {"f = ~(1 > 2) & true", "1"},
        {"f = vector(2,4,6) / 2", "(1,2,3)"},
        // lists
        {"f = list(1, 'a', 2.5)", "{1, a, 2.5}"},
        {"f = list", "{}"},
        {"f = list.sequence(1, 4)", "{1, 4}"},
        {"f = list.seq(3)", "{3}"},
        {"f = list.seq(1, 0, -0.5, 7, 'a', list(2))", "{1, 0, -0.5, 7, a, {2}}"},
        {"f = list.sequence('a', 'b')", "{a, b}"},
        {"local x = list\nx('end') = 1\nx('e') = 2\nx('start') = 0\nf = x", "{0, 1, 2}"},
        {"local x = list(1,2,3)\nf = x('start') + x('end') + x(2)", "6"},
        {"local x = list(1,2,3,4)\nf = x(2,3)", "{2, 3}"},
        {"local x = list(1,2,3,4)\nx(2,3) = list(9)\nf = x", "{1, 9, 4}"},
        {"local x = list(1,2,3,4)\nx(2,3) = list\nf = x", "{1, 4}"},
        {"local x = list(5,6,7)\nf = x(list(3,1))", "{7, 5}"},
        {"local x = list(1,2)\nlocal y = x\ny(1) = 9\nf = list(x, y)", "{{1, 2}, {9, 2}}"},
        {"local x = list(1,2)\nlocal y = list(x)\nx(1) = 9\nf = y", "{{1, 2}}"},
        {"f = list(1,2) + list(3,4)", "{4, 6}"},
        {"f = list(1,2) * 3 - 1", "{2, 5}"},
        // splitting
        {"f = math.abs(::list(-1, 2, -3))", "{1, 2, 3}"},
        {"f = math.max(::list(1, 5), ::list(4, 2))", "{4, 5}"},
        {"f = math.max(::list(1, 5), 3)", "{3, 5}"},
        {"f = math.abs(::list)", "{}"},
        {"f = list.sum(math.abs(::math.min(::list(1, -2), 0)))", "2"},
        {"local x = list(7, 8, 9)\nf = x(::list(3, 1))", "{9, 7}"},
        {"local x = list(7, 8, 9)\nx(::list(1, 3)) = 0\nf = x", "{0, 8, 0}"},
        {"local x = list(7, 8, 9)\nx(::list(1, 3)) =:: list(5, 6)\nf = x", "{5, 8, 6}"},
        {"local x = list(7, 8, 9)\nx(::list(1, 3)) += 1\nf = x", "{8, 8, 10}"},
        {"local x = list(7, 8, 9)\nx(::list(1, 3)) *=:: list(2, 3)\nf = x", "{14, 8, 27}"},
        // matrices
        {"f = matrix(2, 3)", "{{0, 0, 0}, {0, 0, 0}}"},
        {"f = matrix(list(list(1,2), list(3,4)))", "{{1, 2}, {3, 4}}"},
        {"f = matrix(list(1, 2))", "{{1}, {2}}"},
        {"f = matrix(vector(1,2,3))", "{{1}, {2}, {3}}"},
        {"f = matrix(tensor(1,2,3,4,5,6))", "{{1, 4, 5}, {4, 2, 6}, {5, 6, 3}}"},
        {"local m = matrix(2, 2)\nm(1,2) = 5\nlocal n = m\nn(1,2) = 6\nf = list(m(1,2), n(1,2), m->rows, m->cols)",
         "{5, 6, 2, 2}"},
        {"local m = matrix(list(list(1,2), list(3,4)))\nf = m * m - m + 2 * m / 2", "{{7, 10}, {15, 22}}"},
        {"local m = matrix(list(list(1,2), list(3,4)))\nf = -m * matrix(list(1, 1))", "{{-3}, {-7}}"},
        {"f = matrix.identity(3) * vector(1,2,3)", "(1,2,3)"},
        {"f = matrix.transpose(matrix(list(list(1,2,3), list(4,5,6))))", "{{1, 4}, {2, 5}, {3, 6}}"},
        {"f = matrix.det(matrix(list(list(1,2), list(3,4))))", "-2"},
        {"f = matrix.inverse(matrix(list(list(2,0), list(0,4))))", "{{0.5, 0}, {0, 0.25}}"},
        {"f = math.outer.product(vector(1,2,3), vector(1,0,0))", "{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}"},
        {"f = type.name(matrix(1, 1))", "matrix"},
        {"f = matrix(1, 1) = matrix(1, 1)", "1"},
        {"f = matrix(1, 2) = matrix(2, 1)", "0"},
        {"f = tensor.prin(tensor(1,-3,2,0,0,0))", "(-3,1,2)"},
        {"local t = tensor(-4,-2,-7,1,0.5,-0.3)\nlocal d = tensor.prin.from(tensor.prin(t), tensor.prin.dir(t)) - t\n"
         "f = tensor.j2(d) < 1e-24 & math.abs(tensor.trace(d)) < 1e-12",
         "1"},
        {"f = list.append(list(1), 2, 3)", "{1, 2, 3}"},
        {"f = list.prepend(list(1), 0)", "{0, 1}"},
        {"f = list.concatenate(list(1), list(2,3))", "{1, 2, 3}"},
        {"f = list.insert(list(1,3), 2, 2)", "{1, 2, 3}"},
        {"f = list.remove(list(1,2,3), 2)", "{1, 3}"},
        {"f = list.range(list(1,2,3), 2, 3)", "{2, 3}"},
        {"f = list.resize(list(1), 3)", "{1, 0, 0}"},
        {"f = list.reverse(list(1,2,3))", "{3, 2, 1}"},
        {"f = list.sort(list(3,1,2))", "{1, 2, 3}"},
        {"f = list.sort(list('b','a'))", "{a, b}"},
        {"f = list.find.index(list(5,6), 6) + list.find.index(list(5), 7)", "2"},
        {"f = list.count(list(1,2,1), 1)", "2"},
        {"f = list.sum(list(1,2,3.5)) + list.max(list(1,4)) - list.min(list(2,1))", "9.5"},
        {"f = list.create(2, 7)", "{7, 7}"},
        {"local x = list(1,2)\nf = x->size + x->sum", "5"},
        {"f = list.size(list(1,list(2,3)))", "2"},
        // maps
        {"local m = map('b', 2, 1, 'one')\nf = m", "{1: one, b: 2}"},
        {"local m = map\nm('k') = 5\nf = m('k')", "5"},
        {"local m = map('k', 1)\nlocal n = m\nn('k') = 2\nf = m('k') * 10 + n('k')", "12"},
        {"f = map.keys(map('b', 1, 'a', 2, 3, 0))", "{3, a, b}"},
        {"f = map.size(map('a', 1)) + map.has(map('a', 1), 'a')", "2"},
        {"f = map.value(map('a', 1), 'b', 7)", "7"},
        {"f = map.merge(map('a', 1), map('b', 2))", "{a: 1, b: 2}"},
        {"f = map.remove(map.add(map('a', 1), 'b', 2), 'a')", "{b: 2}"},
        {"local s = 0\nloop foreach v map('a', 1, 'b', 10)\ns = s + v\nendloop\nf = s", "11"},
        // vectors, tensors, structures
        {"local v = vector(1,2,3)\nv->y = 9\nf = v->x + v->y + comp.z(v)", "13"},
        {"local v = vector(1,2,3)\nlocal w = v\nw->x = 9\nf = v", "(1,2,3)"},
        {"local v = vector(1,2,3)\ncomp.x(v) = 5\nf = v(1) + v(3)", "8"},
        {"local t = tensor(1,2,3,4,5,6)\nt->xy = 7\nf = t->xx + t->yx + t(3) + t(2,3)", "17"},
        {"f = tensor(1,2,3,4,5,6) * 2 + tensor(1,1,1,0,0,0)", "(3,5,7,8,10,12)"},
        {"f = tensor.trace(tensor(1,2,3,0,0,0)) + tensor.j2(tensor(3,0,0,0,0,0))", "9"},
        {"struct bolt(length, angle)\nlocal b = struct bolt(2)\nb->angle = 30\nf = b->length * b->angle", "60"},
        {"struct bolt(length)\nlocal b = struct bolt(2)\nlocal c = b\nc->length = 5\nf = b", "bolt{length: 2}"},
        {"struct part(at)\nlocal p = struct part(vector(1,2,3))\np->at->x = 7\nf = p->at", "(7,2,3)"},
        {"local l = list(vector(1,2,3))\nl(1)->z = 8\nf = l", "{(1,2,8)}"},
        // arrays are shared
        {"array a(2)\nlocal b = a\nb(1) = 4\nf = a(1) + a->size(1)", "6"},
        {"array a(2)\nlocal b = array.copy(a)\nb(1) = 4\nf = a(1)", "0"},
        // statements
        {"local a = 3\nif a > 2 then f = 5", "5"},
        {"local n = 0\nloop i (1, 9)\nif i > 4 then exit loop\nn += i\nendloop\nf = n", "10"},
        {"local n = 0\nloop foreach i list(1,2,3)\nif i = 2 then continue\nn += i\nendloop\nf = n", "4"},
        {"local s = 0\nloop foreach local x list(1,2,3)\ns += x\nx = 100\nendloop\nf = s", "6"},
        {"local l = list(1,2,3)\nlocal s = 0\nloop foreach x l\ns += x\nl('end') = x\nendloop\nf = s * 10 + list.size(l)",
         "66"},
        {"local s = 0\nloop foreach x vector(1,2,3)\ns += x\nendloop\nf = s", "6"},
        {"local ls = list(list(1), list(2))\nloop foreach x ls\nx(1) = 9\nendloop\nf = ls", "{{1}, {2}}"},
        {"local s = 0\nloop for (local i = 1, i <= 3, i = i + 1)\ns += i\nendloop\nf = s", "6"},
        {"local a = 2\ncase_of a\ncase 1\nf = 'one'\ncase 2\nf = 'two'\nendcase", "two"},
        {"f = list(1, ...\n 2, & ; more\n 3)", "{1, 2, 3}"},
        {"return 4", "4"},
        // texts and numbers
        {"f = string.find('abcabc', 'c', 4) + string.len('abc')", "9"},
        {"f = string.replace('a.b.c', '.', '%')", "a%b%c"},
        {"f = string.split('a,b,,c', ',')", "{a, b, , c}"},
        {"f = string.join(list(1,'b'), '-')", "1-b"},
        {"f = string.simplify('  a   b ') + string.upper('c') + string.lower('D')", "a bCd"},
        {"f = string.compare('a', 'b') + string.compare('b', 'b')", "-1"},
        {"f = 'abc'", "abc"},
        {"f = type.name(1) + type.name(1.5) + type.name(list) + type.name(vector(0,0,0))", "intfloatlistvector"},
        {"f = math.ceiling(1.2) + math.floor(-1.2) + math.isnan(1.0)", "0"},
        {"f = math.abs(math.tanh(50.0) - 1) < 1e-12", "1"},
        {"f = math.abs(math.cosh(1.0)^2 - math.sinh(1.0)^2 - 1) < 1e-12", "1"},
        {"f = boolean(3) + boolean(0)", "1"},
        {"f = math.outer.product(vector(1,2,3), vector(1,2,3))", "(1,4,9,2,3,6)"},
    };
    for (const auto& one : cases) EXPECT_EQ(shown(one.body), one.value) << one.body;
}

TEST(ModernFish, EachMistakeHasItsMessage) {
    const Case cases[] = {
        {"f = list(1)(2)", "left over"},
        {"f = list(1,2)->sise", "has no 'sise'"},
        {"local l = list(1,2)\nf = l(3)", "l(3) is outside of the list of 2"},
        {"local l = list\nf = l('end')", "is empty"},
        {"local l = list(1)\nl(1,1) = 5", "is replaced by the integer 5"},
        {"local m = map('a', 1)\nf = m('b')", "has no key the text 'b'"},
        {"f = map(1)", "'map' is given 1 values"},
        {"f = map(list(1), 2)", "a list cannot be the key of a map"},
        {"f = tensor(1,2)", "'tensor' is given 2 numbers"},
        {"local t = tensor\nf = t(7)", "outside of the tensor"},
        {"local v = vector(1,2,3)\nf = v(4)", "outside of the vector"},
        {"local v = vector(1,2,3)\nv(1) = 2", "cannot be set by their numbers"},
        {"local v = vector(1,2,3)\nf = v->w", "has no 'w'"},
        {"f = struct bolt(1)", "there is no structure 'bolt'"},
        {"struct bolt(a)\nf = struct bolt(1,2)", "has 1 members, here it is given 2"},
        {"struct bolt(a)\nlocal b = struct bolt\nf = b->c", "has no member 'c'"},
        {"struct bolt(a,a)", "names the member 'a' twice"},
        {"struct bolt(1)", "are names"},
        {"f = math.abs(::3)", "'::' splits a list, here it is given the integer 3"},
        {"f = math.max(::list(1), ::list(1,2))", "lists of 1 and 2 elements are split together"},
        {"f = ::list(1)", "expected a value, found '::'"},
        {"f = list(1)->at(::list(1))", "'::' has no meaning here"},
        {"local x = list(1)\nx(1) =:: list(1)", "'=::' needs a list that is split on its left"},
        {"local x = list(1,2)\nx(::list(1,2)) =:: 3", "'=::' gives the elements of a list"},
        {"local x = list(1,2)\nx(::list(1,2)) =:: list(3)", "1 values are given to more elements"},
        {"f = matrix(0, 2)", "takes the numbers of rows and columns"},
        {"f = matrix(1001, 1000)", "has up to 1000000 elements"},
        {"f = matrix(list(list(1,2), list(3)))", "a row of the matrix has 1 numbers"},
        {"local m = matrix(2, 2)\nf = m(3,1)", "m(3,1) is outside of the matrix of 2 rows and 2 columns"},
        {"local m = matrix(2, 2)\nf = m(1)", "has a row and a column"},
        {"local m = matrix(2, 2)\nm(1,1) = 'a'", "a number is needed here"},
        {"f = matrix(2, 2) * matrix(3, 1)", "cannot be combined by '*'"},
        {"f = matrix(2, 2) + 1", "cannot be combined by '+'"},
        {"f = matrix.inverse(matrix(2, 2))", "has no inverse"},
        {"f = matrix.det(matrix(2, 3))", "as many rows as columns, here it has 2 and 3"},
        {"f = matrix.ludcmp(matrix(2, 2))", "not supported"},
        {"f = tensor.prin(3)", "must be a tensor, here it is the integer 3"},
        {"list.append(f, 1)", "the result of 'list.append' is not used"},
        {"f = list.append(3, 1)", "must be a list, here it is the integer 3"},
        {"f = list.sort(list(1,'a'))", "cannot order the text 'a'"},
        {"f = list.create(1000000000)", "would make a list of 1000000000 elements"},
        {"f = list.min(list)", "is given an empty list"},
        {"f = list(1,2) + list(1)", "lists of 2 and 1 elements"},
        {"f = tensor(1,2,3,4,5,6) * list(1)", "cannot"},
        {"f = 1 / 0", "division by zero"},
        {"f = 1 // 0", "division by zero"},
        {"f = 1.0 % 0.0", "division by zero"},
        {"f = 'a' / 2", "cannot be divided"},
        {"loop foreach x 3\nendloop", "'loop foreach' needs a list"},
        {"if 1 then loop while 1", "'loop' cannot follow 'then' on its line"},
        {"f = block.poss(0)", "there is no FISH variable or function 'block.poss'"},
        {"f = fracture.list", "not supported"},
        {"f = list->", "the name of a member"},
        {"f = 0->pos", "left over"},
        {"local p = 0\nf = p->pos", "the integer 0 has no 'pos'"},
        {"f = string.find(1, 'a')", "takes texts, here it is given the integer 1"},
        {"f = system.command('true')", "which a deck may not do"},
        {"f = mech.solve('speed')", "knows no limit 'speed'"},
        {"f = f + 1", "call each other too deeply"},
    };
    for (const auto& one : cases) {
        std::string message;
        try {
            message = "no error: " + shown(one.body);
        } catch (const Diagnostic& problem) {
            message = problem.message;
            EXPECT_GE(problem.place.line, 1) << one.body;
        }
        EXPECT_THAT(message, HasSubstr(one.value)) << one.body;
    }
}

TEST(ModernFish, ErrorsNameTheLineOfTheDeck) {
    Stage s;
    s.fish("fish define f\n  local l = list(1,2)\n\n  f = l(5)\nend\n");
    try {
        s.value("f");
        FAIL();
    } catch (const Diagnostic& problem) { EXPECT_EQ(problem.place.line, 4); }
}

TEST(ModernFish, ArgumentsMayHaveValues) {
    Stage s;
    s.fish("fish define f(a, b = 2, c = a * 10)\n  f = list(a, b, c)\nend\n");
    EXPECT_EQ(s.value("[string(f(1))]"), Value(std::string("{1, 2, 10}")));
    EXPECT_EQ(s.value("[string(f(1, 5))]"), Value(std::string("{1, 5, 10}")));
    EXPECT_EQ(s.value("[string(f(1, 5, 6))]"), Value(std::string("{1, 5, 6}")));
    EXPECT_THROW(s.value("[f()]"), Diagnostic);
    EXPECT_THROW(s.value("[f(1,2,3,4)]"), Diagnostic);
    EXPECT_THROW(s.fish("fish define g(a = 1, b)\nend\n"), Diagnostic);
}

TEST(ModernFish, ListsOfTheCallerStayAsTheyAre) {
    Stage s;
    s.fish("fish define change(l)\n  l(1) = 9\n  change = l\nend\n");
    s.fish("fish define f\n  local l = list(1,2)\n  local m = change(l)\n  f = list(l, m)\nend\n");
    EXPECT_EQ(s.value("[string(f)]"), Value(std::string("{{1, 2}, {9, 2}}")));
}

TEST(ModernFish, TheOwnNameIsTheValueInClassicFunctionsAndACallInModernOnes) {
    Stage s;
    s.fish("def f\n  f = 1\n  f = f + 1\nend\n");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{2}));
    s.fish("fish define g\n  depth = depth + 1\n  if depth > 3 then return 100\n  g = g + depth\nend\n");
    EXPECT_EQ(s.value("g"), Value(std::int64_t{112})); // 100 and three times the depth 4
    s.fish("fish define h(n)\n  h = 1\n  if n > 1 then h = n * h(n - 1)\nend\n");
    EXPECT_EQ(s.value("h(5)"), Value(std::int64_t{120}));
}

TEST(ModernFish, WithoutAutomaticCreationVariablesAreDeclared) {
    Stage s;
    s.scripts.create_automatically(false);
    s.fish("fish define f\n  global total = 1\n  local x = 2\n  f = total + x\nend\n");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{3}));
    s.fish("fish define g\n  total = total + 1\n  g = total\nend\n");
    EXPECT_EQ(s.value("g"), Value(std::int64_t{2}));
    s.fish("fish define h\n  local sum = 1\n  h = sun\nend\n");
    try {
        s.value("h");
        FAIL();
    } catch (const Diagnostic& problem) {
        EXPECT_THAT(problem.message, HasSubstr("'sun' is not declared"));
        EXPECT_EQ(problem.place.line, 3);
        EXPECT_EQ(problem.place.column, 7);
    }
    s.scripts.create_automatically(true);
    s.fish("fish define h\n  h = sun\nend\n");
    EXPECT_EQ(s.value("h"), Value(std::int64_t{0}));
}

TEST(ModernFish, ClassicDecksKeepTheirVariables) {
    Stage s;
    s.fish("def f\n  array list(3)\n  list(2) = 5\n  map = 7\n  tensor = 1\n  f = list(2) + map + tensor\nend\n");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{13}));
    EXPECT_EQ(s.value("7 / 2"), Value(std::int64_t{3}));
    EXPECT_EQ(s.value("[7 / 2]"), Value(3.5));
}

TEST(ModernFish, ValuesReachTheProgramAndComeBack) {
    Stage s;
    s.fish("fish define f\n  f = list(1, map('a', 2), tensor(1,2,3,4,5,6))\nend\n");
    const Value value = s.value("f");
    const auto& list = *std::get<std::shared_ptr<const Compound>>(value);
    EXPECT_EQ(list.kind, "list");
    EXPECT_EQ(list.text, "{1, {a: 2}, (1,2,3,4,5,6)}");
    ASSERT_EQ(list.members.size(), 3u);
    EXPECT_EQ(list.members[0], Value(std::int64_t{1}));
    const auto& map = *std::get<std::shared_ptr<const Compound>>(list.members[1]);
    EXPECT_EQ(map.keys, std::vector<Value>{std::string("a")});
    s.scripts.set("again", value);
    EXPECT_EQ(s.value("[string(again)]"), Value(std::string("{1, {a: 2}, (1,2,3,4,5,6)}")));
    EXPECT_THROW(s.scripts.number("f"), Diagnostic);
}

TEST(ModernFish, AreStoredAndRestored) {
    Stage s;
    s.fish("fish define f\n  struct bolt(length)\n  global l = list(1, list(2), map('k', struct bolt(3)))\n"
           "  global t = tensor(1,2,3,4,5,6)\nend\n");
    s.scripts.call("f");
    s.scripts.create_automatically(false);
    const ScriptState state = from_bytes(to_bytes(s.scripts.state()));
    Stage other;
    other.scripts.restore(state);
    EXPECT_EQ(other.value("[string(l) + string(t)]"),
              Value(std::string("{1, {2}, {k: bolt{length: 3}}}(1,2,3,4,5,6)")));
    EXPECT_EQ(other.value("[struct bolt(7)->length]"), Value(std::int64_t{7}));
    EXPECT_FALSE(other.scripts.state().automatic_create);
    EXPECT_EQ(to_bytes(other.scripts.state()), to_bytes(s.scripts.state()));
}

TEST(ModernFish, NestedListsHaveNoEnd) {
    Stage s;
    s.fish("fish define f\n  local l = list\n  loop i (1, 3000)\n    l = list(l)\n  endloop\n  f = string(l)\nend\n");
    try {
        s.value("f");
    } catch (const Diagnostic& problem) { EXPECT_FALSE(problem.message.empty()); }
    EXPECT_EQ(s.value("[1 + 1]"), Value(std::int64_t{2})); // the machine still runs
}

/// CPU seconds, the least of three.
double seconds(Stage& s, const char* call) {
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
        const std::clock_t start = std::clock();
        s.scripts.call(call);
        least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

TEST(ModernFish, LoopsOverAListOfSubContactsTakeLessThanTwiceTheTimeOfLoopWhile) {
    Stage s(1000, 100);
    s.fish("fish define each\n  sum = 0.0\n  loop foreach local c block.contact.list\n"
           "    loop foreach local p block.contact.subcontactlist(c)\n      sum += cx_nforce(p)\n    endloop\n"
           "  endloop\nend\n");
    s.fish("def walk\n  sum = 0.0\n  c = contact_head\n  loop while c # 0\n    p = c_cx(c)\n    loop while p # 0\n"
           "      sum = sum + cx_nforce(p)\n      p = cx_next(p)\n    endloop\n    c = c_next(c)\n  endloop\nend\n");
    const double by_list = seconds(s, "each");
    const Value sum = s.value("sum");
    const double by_pointer = seconds(s, "walk");
    EXPECT_EQ(s.value("sum"), sum);
    fmt::print("100,000 sub-contacts: loop foreach {:.1f} ms, loop while {:.1f} ms\n", 1e3 * by_list, 1e3 * by_pointer);
    EXPECT_LT(by_list, 2 * by_pointer);
}

/// Random expressions of whole numbers without division have the same value in both dialects.
TEST(ModernFish, RandomExpressionsAgreeWithClassicOnes) {
    std::mt19937_64 random(40);
    const auto pick = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
    const std::function<std::string(int)> expression = [&](int depth) -> std::string {
        if (depth == 0 || pick(5) == 0)
            return pick(2) == 0 ? std::to_string(pick(9) + 1) : fmt::format("{}.5", pick(9));
        static constexpr const char* signs[] = {"+", "-", "*", "<", ">=", "=", "#", "&", "|"};
        return fmt::format("({} {} {})", expression(depth - 1), signs[pick(9)], expression(depth - 1));
    };
    for (int i = 0; i < 200; ++i) {
        const std::string text = expression(4);
        Stage s;
        s.fish(fmt::format("def c\n  c = {}\nend\n", text));
        s.fish(fmt::format("fish define m\n  m = {}\nend\n", text));
        EXPECT_EQ(s.value("c"), s.value("m")) << text;
    }
}

} // namespace
} // namespace kaya::script::test
