// Behaviour of FISH programs, statement by statement.
#include "fake_world.hpp"

#include <gmock/gmock.h>

namespace kaya::script::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::int64_t whole(const Value& value) { return std::get<std::int64_t>(value); }

/// Runs the lines as the body of a function `f` and returns its value.
Value run(const std::string& body) {
    Stage s;
    s.fish("def f\n" + body + "\nend\n");
    return s.value("f");
}

TEST(FishLanguage, IntegersStayIntegersAndDivisionsCut) {
    EXPECT_EQ(run("f = 7 / 2"), Value(std::int64_t{3}));
    EXPECT_EQ(run("f = -7 / 2"), Value(std::int64_t{-3}));
    EXPECT_EQ(run("f = 7 / 2.0"), Value(3.5));
    EXPECT_EQ(run("f = 7.0 / 2"), Value(3.5));
    EXPECT_EQ(run("f = 1 / 2 * 2"), Value(std::int64_t{0}));
    EXPECT_EQ(run("a = 7\nb = 2\nf = a / b"), Value(std::int64_t{3}));
    EXPECT_EQ(run("f = 2 + 3 * 4 - 1"), Value(std::int64_t{13}));
    EXPECT_EQ(run("f = 12 / 2 / 3"), Value(std::int64_t{2}));
    EXPECT_EQ(run("f = 12 / (2 / 3.0)"), Value(18.0));
    EXPECT_EQ(run("f = 10 - (3 - 2)"), Value(std::int64_t{9}));
    EXPECT_EQ(run("f = 1.5 + 1"), Value(2.5));
    EXPECT_EQ(run("f = 99999999999"), Value(99999999999.0)); // more than ten digits: a real number
}

TEST(FishLanguage, PowersBindToTheRightAndKeepIntegers) {
    EXPECT_EQ(run("f = 2 ^ 3 ^ 2"), Value(std::int64_t{512}));
    EXPECT_EQ(run("f = -2 ^ 2"), Value(std::int64_t{-4}));
    EXPECT_EQ(run("f = 2 ^ -1"), Value(0.5));
    EXPECT_EQ(run("f = 4.0 ^ 0.5"), Value(2.0));
    EXPECT_EQ(run("f = 10 ^ 30"), Value(1e30)); // too large for an integer
    EXPECT_EQ(run("f = 3 * 2 ^ 2"), Value(std::int64_t{12}));
}

TEST(FishLanguage, SignsMayStandTogether) {
    EXPECT_EQ(run("a = 3\nf = 1 - -a"), Value(std::int64_t{4}));
    EXPECT_EQ(run("a = 3\nf = - - a"), Value(std::int64_t{3}));
    EXPECT_EQ(run("f = +2.5"), Value(2.5));
}

TEST(FishLanguage, ComparisonsHaveTheValuesOneAndZero) {
    EXPECT_EQ(run("f = (3 > 2) + (2 # 2) + (2 = 2.0) + ('a' = 'a')"), Value(std::int64_t{3}));
    EXPECT_EQ(run("f = 2 <= 2"), Value(std::int64_t{1}));
    EXPECT_EQ(run("f = 1 != 1"), Value(std::int64_t{0}));
    EXPECT_EQ(run("f = 1 == 1 & 2 < 1"), Value(std::int64_t{0}));
    EXPECT_EQ(run("f = 1 = 1 | 2 < 1"), Value(std::int64_t{1}));
    EXPECT_EQ(run("f = not 0"), Value(std::int64_t{1}));
}

TEST(FishLanguage, ABareValueIsACondition) {
    EXPECT_EQ(run("found = 1\nif found then\nf = 5\nendif"), Value(std::int64_t{5}));
    EXPECT_EQ(run("found = 0.0\nif found\nf = 5\nelse\nf = 6\nendif"), Value(std::int64_t{6}));
    EXPECT_EQ(run("if contact_head then\nf = 5\nendif"), Value(std::int64_t{5}));
    EXPECT_EQ(run("if not(found) then\nf = 5\nendif"), Value(std::int64_t{5}));
    EXPECT_EQ(run("if and(1 > 0, 2 > 1) then\nf = 5\nendif"), Value(std::int64_t{5}));
}

TEST(FishLanguage, ClassicLogicWorksOnBits) {
    EXPECT_EQ(run("f = and(12, 10)"), Value(std::int64_t{8}));
    EXPECT_EQ(run("f = or(12, 10)"), Value(std::int64_t{14}));
    EXPECT_EQ(run("f = not(0)"), Value(std::int64_t{-1}));
    EXPECT_EQ(run("f = lshift(3, 2) + rshift(16, 3)"), Value(std::int64_t{14}));
}

TEST(FishLanguage, ElseIfAndElse) {
    const std::string body = "if a = 1\nf = 10\nelse if a = 2 then\nf = 20\nelseif a = 3\nf = 30\nelse\nf = 40\nend_if";
    EXPECT_EQ(run("a = 1\n" + body), Value(std::int64_t{10}));
    EXPECT_EQ(run("a = 2\n" + body), Value(std::int64_t{20}));
    EXPECT_EQ(run("a = 3\n" + body), Value(std::int64_t{30}));
    EXPECT_EQ(run("a = 4\n" + body), Value(std::int64_t{40}));
}

TEST(FishLanguage, LoopsOverARangeIncludeBothEnds) {
    EXPECT_EQ(run("loop i (1, 4)\nf = f + i\nendloop"), Value(std::int64_t{10}));
    EXPECT_EQ(run("loop i (10, 1, -3)\nf = f * 100 + i\nend_loop"), Value(std::int64_t{10070401}));
    EXPECT_EQ(run("loop i (3, 2)\nf = f + i\nendloop"), Value(std::int64_t{0}));
    EXPECT_EQ(run("loop x (0.0, 1.0, 0.25)\nf = f + 1\nendloop"), Value(std::int64_t{5}));
    EXPECT_EQ(run("n = 3\nloop i (1, n)\nn = 10\nf = f + 1\nendloop"), Value(std::int64_t{3}));
    EXPECT_EQ(run("loop i (1, 10)\ni = i + 1\nf = f + 1\nendloop"), Value(std::int64_t{5}));
}

TEST(FishLanguage, LoopWhileForAndForeach) {
    EXPECT_EQ(run("loop while f < 7\nf = f + 2\nendloop"), Value(std::int64_t{8}));
    EXPECT_EQ(run("loop for (i = 0, i < 4, i = i + 1)\nf = f + i\nendloop"), Value(std::int64_t{6}));
    EXPECT_EQ(run("array a(3)\na(1) = 5\na(3) = 7\nloop foreach local x a\nf = f + x\nx = 99\nendloop"),
              Value(std::int64_t{12}));
}

TEST(FishLanguage, ExitLoopAndContinue) {
    EXPECT_EQ(run("loop i (1, 10)\nif i = 3\ncontinue\nendif\nif i = 6\nexit loop\nendif\nf = f + i\nendloop"),
              Value(std::int64_t{12}));
    EXPECT_EQ(run("loop while 1\nloop j (1, 5)\nif j = 2\nexit loop\nendif\nf = f + 1\nendloop\n"
                  "if f = 3\nexit loop\nendif\nendloop"),
              Value(std::int64_t{3}));
    EXPECT_EQ(run("loop for (i = 0, i < 5, i = i + 1)\nif i < 3\ncontinue\nendif\nf = f + i\nendloop"),
              Value(std::int64_t{7}));
}

TEST(FishLanguage, ExitLeavesTheFunctionWithItsValue) {
    EXPECT_EQ(run("f = 1\nexit\nf = 2"), Value(std::int64_t{1}));
    EXPECT_EQ(run("loop while 1\nf = f + 1\nif f > 4\nexit\nendif\nendloop"), Value(std::int64_t{5}));
    EXPECT_EQ(run("return 3 * 4\nf = 1"), Value(std::int64_t{12}));
}

TEST(FishLanguage, CaseOfRunsTheMatchingCaseOrTheStatementsBefore) {
    const std::string body = "case_of a\nf = -1\ncase 1\nf = 10\ncase 2.0\nf = 20\ncase 'x'\nf = 30\nendcase";
    EXPECT_EQ(run("a = 1\n" + body), Value(std::int64_t{10}));
    EXPECT_EQ(run("a = 2\n" + body), Value(std::int64_t{20}));
    EXPECT_EQ(run("a = 'x'\n" + body), Value(std::int64_t{30}));
    EXPECT_EQ(run("a = 9\n" + body), Value(std::int64_t{-1}));
    EXPECT_EQ(run("caseof 3\ncase 1\nf = 10\nend_case"), Value(std::int64_t{0}));
    EXPECT_EQ(run("case_of 3\nf = 4\nendcase"), Value(std::int64_t{4}));
}

TEST(FishLanguage, SectionsAreLeftFromInside) {
    EXPECT_EQ(run("section\nf = 1\nloop i (1, 5)\nif i = 2\nexit section\nendif\nf = f + 10\nendloop\nf = 99\n"
                  "endsection\nf = f + 100"),
              Value(std::int64_t{111}));
    EXPECT_EQ(run("section\nsection\nexit section\nf = 1\nendsection\nf = f + 2\nendsection"), Value(std::int64_t{2}));
}

TEST(FishLanguage, NamesIgnoreCaseAndLinesContinue) {
    EXPECT_EQ(run("NumCyc = 4\nf = numcyc + &\n  NUMCYC ... ; more follows\n  + 1"), Value(std::int64_t{9}));
    EXPECT_EQ(run("f = 1 ; f = 2"), Value(std::int64_t{1}));
    EXPECT_EQ(run("a = ';'\nf = a"), Value(std::string(";")));
}

TEST(FishLanguage, WordsOfLuaAreNamesLikeOthers) {
    EXPECT_EQ(run("nil = 1\nrepeat = 2\nlocal until = 3\nfunction = 4\nf = nil + repeat + until + function"),
              Value(std::int64_t{10}));
    EXPECT_EQ(run("local größe = 3\nf = größe * 2"), Value(std::int64_t{6}));
}

TEST(FishLanguage, ArgumentsAndLocalsHideGlobals) {
    Stage s;
    s.fish("def add(a, b)\n local c = a + b\n add = c\nend");
    s.fish("def f\n a = 100\n c = 7\n f = add(1, add(2, 3)) + a + c\nend");
    EXPECT_EQ(whole(s.value("f")), 113);
    s.fish("def g\n argument n\n local array v(2)\n v(2) = n\n g = v(2) + v(1)\nend");
    EXPECT_EQ(whole(s.value("g(4)")), 4);
    EXPECT_FALSE(s.scripts.knows("v"));
}

TEST(FishLanguage, FunctionsCallThemselves) {
    Stage s;
    s.fish("def fac(n)\n if n < 2\n fac = 1\n else\n fac = n * fac(n - 1)\n endif\nend");
    EXPECT_EQ(whole(s.value("@fac(10)")), 3628800);
}

TEST(FishLanguage, ARedefinitionReplacesAndItsCallersFollow) {
    Stage s;
    s.fish("def a\n a = b\nend");
    EXPECT_EQ(whole(s.value("a")), 0); // b is a variable so far
    s.fish("def b\n b = 5\nend");
    EXPECT_EQ(whole(s.value("a")), 5);
    s.fish("def b\n b = 6\nend");
    EXPECT_EQ(whole(s.value("a")), 6);
    s.fish("def b(n)\n b = n\nend");
    EXPECT_THAT(message_of([&] { s.value("a"); }), HasSubstr("'b' takes 1 argument, here it is given none"));
}

TEST(FishLanguage, AnArrayOfTheSameSizesIsKept) {
    // As in typical output functions: the statement is in the loop that fills the array.
    EXPECT_EQ(run("loop n (1,3)\narray a(5,1)\na(n,1) = n\nendloop\nf = a(1,1) * 100 + a(2,1) * 10 + a(3,1)"),
              Value(std::int64_t{123}));
    EXPECT_EQ(run("array a(6)\na(1) = 4\narray a(2,3)\nf = a(1,1)"), Value(std::int64_t{0}));
    EXPECT_EQ(run("array a(2)\na(2) = 4\nk = 2.0\narray a(k)\nf = a(2)"), Value(std::int64_t{4}));
    Stage s;
    s.fish("def g\n local array v(2)\n v(2) = v(2) + 1\n g = v(2)\nend");
    EXPECT_EQ(s.value("g"), Value(std::int64_t{1}));
    EXPECT_EQ(s.value("g"), Value(std::int64_t{1})); // local: a new one in each call
}

TEST(FishLanguage, ArraysHaveBoundsAndDimensions) {
    EXPECT_EQ(run("array a(2,3) b(4)\na(2,1) = 5\nb(4) = 6\nf = a(2,1) * 10 + b(4) + a(1,1)"), Value(std::int64_t{56}));
    EXPECT_EQ(run("array a(2,3)\na(1,1) = 1\narray a(3,2)\nf = a(1,1)"), Value(std::int64_t{0}));
    EXPECT_EQ(run("n = 3\narray a(n)\nf = array_size(a, 1) * 10 + array_dim(a)"), Value(std::int64_t{31}));
    EXPECT_EQ(run("array a(2)\na(1.0 + 1) = 8\nf = a(2)"), Value(std::int64_t{8}));
}

TEST(FishLanguage, TextsJoinWithPlus) {
    EXPECT_EQ(run("f = 'wall' + string(12) + '.sav'"), Value(std::string("wall12.sav")));
    EXPECT_EQ(run("a = '10'\nb = '20'\nf = a + b"), Value(std::string("1020")));
    EXPECT_EQ(run("f = 'n = ' + 2.5"), Value(std::string("n = 2.5")));
    EXPECT_EQ(run("f = 'it''s' + \"\\n\""), Value(std::string("it's\n")));
    EXPECT_EQ(run("f = 'a' < 'b'"), Value(std::int64_t{1}));
}

TEST(FishLanguage, TextsHaveFunctions) {
    EXPECT_EQ(run("f = substr('gridpoint', 5, 3)"), Value(std::string("poi")));
    EXPECT_EQ(run("f = substr('grid', 9)"), Value(std::string("")));
    EXPECT_EQ(run("f = toupper('aB') + tolower('Cd') + string(strlen('abc'))"), Value(std::string("ABcd3")));
    EXPECT_EQ(run("f = index('contact', 'tac')"), Value(std::int64_t{4}));
    EXPECT_EQ(run("f = index('contact', 'x')"), Value(std::int64_t{0}));
    EXPECT_EQ(run("f = parse('a, 2 3.5', 2)"), Value(std::int64_t{2}));
    EXPECT_EQ(run("f = parse('a, 2 3.5', 3)"), Value(3.5));
    EXPECT_EQ(run("f = parse(\"x 'two words'\", 2)"), Value(std::string("two words")));
    EXPECT_EQ(run("f = parse('a', 2)"), Value(std::int64_t{0}));
    EXPECT_EQ(run("f = int('12') + int(3.9) + int(-3.9)"), Value(std::int64_t{12}));
    EXPECT_EQ(run("f = float('1e3')"), Value(1000.0));
    EXPECT_EQ(run("f = string(7, 3, '0')"), Value(std::string("007")));
    EXPECT_EQ(run("f = string(1.0/3, 1, ' ', 12)"), Value(std::string("0.333333333333")));
    EXPECT_EQ(run("f = string(1e6) + ' ' + string(123456789.0) + ' ' + string(-0.5)"),
              Value(std::string("1e+06 1.23457e+08 -0.5")));
    EXPECT_EQ(run("f = type(1) * 10000 + type(1.0) * 1000 + type('a') * 100 + type(block_head) * 10 + "
                  "type(vector(1,2,3))"),
              Value(std::int64_t{12346}));
}

TEST(FishLanguage, Mathematics) {
    EXPECT_EQ(run("f = abs(-3)"), Value(std::int64_t{3}));
    EXPECT_EQ(run("f = max(1, 2.5, 2)"), Value(2.5));
    EXPECT_EQ(run("f = min(3, 2, 4)"), Value(std::int64_t{2}));
    EXPECT_EQ(run("f = max(3, 2.5)"), Value(3.0));
    EXPECT_EQ(run("f = sqrt(16) + ln(exp(2)) + log(1000)"), Value(9.0));
    EXPECT_EQ(run("f = sin(90 * degrad) + cos(0) + atan2(0, 1)"), Value(2.0));
    EXPECT_EQ(run("f = round(2.5) * 10 + sgn(-4)"), Value(std::int64_t{29}));
    EXPECT_EQ(run("f = 4 * atan(1) - pi"), Value(0.0));
}

TEST(FishLanguage, Vectors) {
    EXPECT_EQ(run("v = vector(1,2,3) + vector(1,0,0) * 2\nf = xcomp(v) * 100 + ycomp(v) * 10 + zcomp(v)"),
              Value(323.0));
    EXPECT_EQ(run("v = vector(1,2,3)\nw = v\nycomp(v) = 7\nf = ycomp(v) * 10 + ycomp(w)"), Value(72.0));
    EXPECT_EQ(run("f = dot(vector(1,2,3), cross(vector(1,0,0), vector(0,1,0)))"), Value(3.0));
    EXPECT_EQ(run("f = mag(unit(vector(3,4,0)))"), Value(1.0));
    EXPECT_EQ(run("f = vector(1,2,3) = vector(1,2,3)"), Value(std::int64_t{1}));
    EXPECT_EQ(run("f = -vector(1,2,4) / 2"), Value(Vec3(-0.5, -1, -2)));
    EXPECT_NEAR(std::get<double>(run("f = dipfromnorm(normfromdipdd(30, 110)) + ddfromnorm(normfromdipdd(30, 110))")),
                140, 1e-12);
}

TEST(FishLanguage, TablesInterpolateAndGrow) {
    EXPECT_EQ(run("table(1, 0) = 0\ntable(1, 2) = 4\ntable(1, 1) = 1\nf = table(1, 1.5) * 10 + table_size(1)"),
              Value(28.0));
    EXPECT_EQ(run("xtable(3, 1) = 5\nytable(3, 1) = 6\nvtable(3, 2) = vector(7, 8, 0)\n"
                  "f = xtable(3, 2) * 100 + ytable(3, 1) * 10 + ycomp(vtable(3, 2))"),
              Value(768.0));
    EXPECT_EQ(run("f = table_size(9)"), Value(std::int64_t{0}));
}

TEST(FishLanguage, RandomNumbersAreTheSameInEveryRun) {
    const Value first = run("loop i (1, 100)\nf = f + urand * grand\nendloop");
    EXPECT_EQ(first, run("loop i (1, 100)\nf = f + urand * grand\nendloop"));
    Options options;
    options.seed = 2;
    Stage s(2, 4, options);
    s.fish("def f\nloop i (1, 100)\nf = f + urand * grand\nendloop\nend");
    EXPECT_NE(s.value("f"), first);
}

TEST(FishLanguage, FieldsAreReadAndWrittenThroughPointers) {
    Stage s;
    s.fish("def f\n c = contact_head\n p = c_cx(c)\n cx_nforce(p) = 12\n b = c_b1(c)\n"
           " b_vel(b) = vector(1,2,3)\n xcomp(b_vel(b)) = 9\n damp_local = 0.5\n"
           " f = cx_nforce(p) + b_id(b) + time + xcomp(b_vel(b)) + ycomp(b_vel(b))\nend");
    EXPECT_EQ(s.value("f"), Value(12 + 1 + 0.25 + 9 + 2));
    EXPECT_EQ(s.world.normal_force[0], 12);
    EXPECT_EQ(s.world.damping, 0.5);
}

TEST(FishLanguage, NullPointersEqualZero) {
    Stage s;
    s.fish("def f\n c = c_next(contact_head)\n if c_b1(c) = 0\n f = 1\n endif\n if c_next(c) = null\n f = f "
           "+ 2\n endif\n"
           " if contact_head # 0\n f = f + 4\n endif\nend");
    EXPECT_EQ(whole(s.value("f")), 7);
}

TEST(FishLanguage, NearestObjectsAndExtraValues) {
    Stage s;
    s.fish("def f\n b = b_near(1, 2.5, 3)\n b_extra(b) = 'north'\n b_extra(b, 2) = 8\n f = "
           "b_extra(block_head) + string(b_extra(b, 2))\n"
           " c_near(vector(4,5,6))\n n = b_extra(b, 3)\nend");
    EXPECT_EQ(s.text("f"), "north8");
    EXPECT_EQ(s.world.asked, Vec3(4, 5, 6));
    EXPECT_EQ(whole(s.value("n")), 0);
}

TEST(FishLanguage, CommandsGetLocalValuesAndExpressions) {
    Stage s;
    s.fish("def build(n)\n local x = 0.1 + 0.2\n name = 'stone wall'\n command\n  poly brick 0,@x 0,[n*2] "
           "0,1 ; [comment]\n"
           "  hist @sstav\n\n  group block [name] range z [-x] &\n   0\n  title 'say [x] @n'\n  @other\n "
           "endcommand\nend");
    s.scripts.call("build(3)", {});
    ASSERT_EQ(s.world.commands.size(), 5);
    EXPECT_EQ(s.world.commands[0].text, "  poly brick 0,0.30000000000000004 0,6 0,1 ");
    EXPECT_EQ(s.world.commands[0].line, 5);
    EXPECT_EQ(s.world.commands[0].chunk, "test.3ddat");
    EXPECT_EQ(s.world.commands[1].text, "  hist @sstav");
    EXPECT_EQ(s.world.commands[2].text, "  group block 'stone wall' range z -0.30000000000000004 &\n   0");
    EXPECT_EQ(s.world.commands[3].text, "  title 'say [x] @n'");
    EXPECT_EQ(s.world.commands[4].line, 11);
}

/// A bracket that is the whole line is evaluated, as it is in a deck; its value is not a command.
TEST(FishLanguage, BracketsAloneOnALineOfCommandsAreEvaluated) {
    Stage s;
    s.fish("def note(k)\n calls = calls + k\nend");
    s.fish("fish define outer(n)\n local last = 0\n command\n  go\n  [note(n)] ; once\n  [last = n + 1]\n"
           "  [total = calls*2]\n  go [n]\n endcommand\n outer = last\nend");
    s.value("calls = 0");
    EXPECT_EQ(whole(s.value("outer(4)")), 5);
    EXPECT_EQ(whole(s.value("calls")), 4);
    EXPECT_EQ(whole(s.value("total")), 8);
    ASSERT_EQ(s.world.commands.size(), 2);
    EXPECT_EQ(s.world.commands[0].text, "  go");
    EXPECT_EQ(s.world.commands[1].text, "  go 4");
    EXPECT_EQ(s.world.commands[1].line, 8);
}

TEST(FishLanguage, CommandsMayCallFunctions) {
    Stage s;
    s.fish("def inner\n inner = 3\n n = n + 1\nend");
    s.fish("def outer\n command\n  go\n end_command\n outer = n\nend");
    s.world.on_command = [&](const std::string&) { s.scripts.call("@inner"); };
    EXPECT_EQ(whole(s.value("outer")), 1);
}

TEST(FishLanguage, WhilesteppingRunsAfterEveryCycleUntilItIsReplaced) {
    Stage s;
    s.fish("def watch\n while_stepping\n n = n + 1\nend");
    for (int i = 1; i <= 3; ++i) s.scripts.run_hooks(Moment::after_cycle, i);
    s.scripts.run_hooks(Moment::before_cycle, 4);
    EXPECT_EQ(whole(s.value("n")), 3);
    s.fish("def watch\n n = 100\nend");
    EXPECT_FALSE(s.scripts.has_hooks(Moment::after_cycle));
}

TEST(FishLanguage, BigFunctionsFitIntoTheLimitsOfLua) {
    std::string body = "def f\n", sum = "f = 0";
    for (int i = 0; i < 300; ++i) body += " local v" + std::to_string(i) + " = " + std::to_string(i) + "\n";
    for (int i = 0; i < 300; ++i) sum += " + v" + std::to_string(i);
    for (int i = 0; i < 2000; ++i) body += " global" + std::to_string(i) + " = " + std::to_string(i) + ".5\n";
    Stage s;
    s.fish(body + sum + "\nend");
    EXPECT_EQ(whole(s.value("f")), 44850);
    EXPECT_EQ(s.number("global1999"), 1999.5);
}

TEST(FishLanguage, NestedBlocksUpToForty) {
    std::string body;
    for (int i = 0; i < 38; ++i) body += "loop i" + std::to_string(i) + " (1, 1)\n";
    body += "f = f + 1\n";
    for (int i = 0; i < 38; ++i) body += "endloop\n";
    EXPECT_EQ(run(body), Value(std::int64_t{1}));
}

} // namespace
} // namespace kaya::script::test
