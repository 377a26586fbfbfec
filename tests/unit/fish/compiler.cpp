// Errors in the text of a function, each with its position and words; and the generated Lua.
#include "lang/fish/compiler.hpp"

#include <gmock/gmock.h>

namespace kaya::fish {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Place place_of(const std::string& text, int line = 1) {
    auto source = std::make_shared<SourceText>();
    source->name = "deck.3ddat";
    source->lines.assign(static_cast<std::size_t>(line - 1), "; before");
    std::string rest;
    for (const char c : text + "\n") {
        if (c == '\n') source->lines.push_back(std::exchange(rest, {}));
        else rest += c;
    }
    return {source, line, 1, 1};
}

/// A world with sin, a pointer function and a read-only quantity.
Meaning meaning(std::string_view name) {
    if (name == "sin") return {NameKind::built_in, 1, 1, false};
    if (name == "max") return {NameKind::built_in, 1, 20, false};
    if (name == "gp_xvel") return {NameKind::built_in, 1, 1, true};
    if (name == "time") return {NameKind::built_in, 0, 0, false};
    if (name == "helper") return {NameKind::function, 2, 2, false};
    return {};
}

std::string compiled(const std::string& text, int line = 1) {
    return generate(read_function(text, place_of(text, line)), meaning);
}

struct Mistake {
    const char* text;
    int line, column, length;
    const char* message;
    const char* hint;
};

const Mistake mistakes[] = {
    {"def f\n a = 1\n", 1, 1, 3, "the function 'f' has no 'end'",
     "write 'end' on a separate line after its last statement"},
    {"def\nend", 1, 4, 1, "expected the name of the function, found the end of the line", ""},
    {"def 3f\nend", 1, 5, 1, "'3f' is neither a number nor a name", "a name must not begin with a digit"},
    {"f\nend", 1, 1, 1, "a FISH function begins with 'def'", ""},
    {"def f(a,a)\nend", 1, 9, 1, "the argument 'a' is named twice", ""},
    {"def f(f)\nend", 1, 7, 1, "an argument has the name of its function", "give it another name"},
    {"def f(a\nend", 1, 8, 1, "expected ')' for the arguments of the function, found the end of the line", ""},
    {"def f x\nend", 1, 7, 1, "'x' is left over after the head of the function", "one statement stands on one line"},
    {"def f(x)\n whilestepping\nend", 1, 1, 3, "'f' runs in every cycle and cannot have arguments",
     "remove the arguments, or 'whilestepping'"},
    {"def f\nend\nmore", 3, 1, 4, "there is more text after the 'end' of the function", ""},
    {"def f\nend f", 2, 5, 1, "'f' is left over after 'end'", "one statement stands on one line"},
    {"def f\n a = (1 + 2\nend", 2, 12, 1, "expected ')' for the parenthesis, found the end of the line", ""},
    {"def f\n a = 1 + 2)\nend", 2, 11, 1, "')' is left over after the assignment", "one statement stands on one line"},
    {"def f\n a = 1 +\nend", 2, 9, 1, "expected a value, found the end of the line",
     "a number, a text in quotes, a name or a parenthesis belongs there"},
    {"def f\n a =\nend", 2, 5, 1, "expected a value, found the end of the line",
     "a number, a text in quotes, a name or a parenthesis belongs there"},
    {"def f\n a = 1 2\nend", 2, 8, 1, "'2' is left over after the assignment", "one statement stands on one line"},
    {"def f\n a = * 2\nend", 2, 6, 1, "expected a value, found '*'",
     "a value stands before it; powers are written a ^ b"},
    {"def f\n a = 1 < 2 < 3\nend", 2, 12, 1, "two comparisons in a row",
     "join them with '&', or put one in parentheses"},
    {"def f\n a = sin(1, )\nend", 2, 13, 1, "expected a value, found ')'",
     "a number, a text in quotes, a name or a parenthesis belongs there"},
    {"def f\n a = sin(1\nend", 2, 11, 1, "expected ')' for the arguments of 'sin', found the end of the line", ""},
    {"def f\n a = 'text\nend", 2, 6, 5, "the text has no closing quote", "put ' after it"},
    {"def f\n a = b ~ c\nend", 2, 8, 1, "'~' has no meaning in FISH", "FISH writes # for unequal"},
    {"def f\n a = 12abc\nend", 2, 6, 2, "'12a' is neither a number nor a name", "a name must not begin with a digit"},
    {"def f\n a = 1e999\nend", 2, 6, 5, "1e999 is beyond the range of numbers", ""},
    {"def f\n 3 = a\nend", 2, 2, 1, "expected a statement, found '3'", ""},
    {"def f\n b c\nend", 2, 4, 1, "expected '=' after 'b', found 'c'", ""},
    {"def f\n a = 1 &\n", 2, 1, 8, "the last line ends with a continuation mark", "remove the '&' or '...'"},
    {"def f\n if a > 1 then b = 2\n endif\nend", 2, 16, 1, "'b' is left over after the condition",
     "one statement stands on one line"},
    {"def f\n if then\n endif\nend", 2, 5, 4, "expected a value, found 'then'",
     "a number, a text in quotes, a name or a parenthesis belongs there"},
    {"def f\n if a\nend", 3, 1, 3, "expected 'endif' to close the 'if' of line 2, found 'end'",
     "write a line 'endif' before it"},
    {"def f\n if a\n else\n else\n endif\nend", 4, 2, 4, "a second 'else' in one 'if'", ""},
    {"def f\n endif\nend", 2, 2, 5, "'endif' closes nothing: no block is open here", ""},
    {"def f\n then\nend", 2, 2, 4, "'then' cannot begin a statement", ""},
    {"def f\n loop while a\n endif\nend", 3, 2, 5, "expected 'endloop' to close the 'loop' of line 2, found 'endif'",
     "write a line 'endloop' before it"},
    {"def f\n loop while a\n", 2, 2, 4, "this 'loop' has no 'endloop'", "write a line 'endloop' after its last line"},
    {"def f\n loop i (1)\n endloop\nend", 2, 7, 1, "a loop needs two limits, and a step if wanted; this one has 1",
     "write: loop i (1, 10) or loop i (10, 1, -1)"},
    {"def f\n loop i 1,2\n endloop\nend", 2, 9, 1, "expected '(' for the limits of the loop, found '1'",
     "write: loop i (from, to)"},
    {"def f\n loop\n endloop\nend", 2, 6, 1,
     "expected the loop variable, 'while', 'foreach' or 'for', found the end of the line", ""},
    {"def f\n loop for (i = 1, i < 3)\n endloop\nend", 2, 24, 1, "expected ',' for the step of the loop, found ')'",
     ""},
    {"def f\n exit loop\nend", 2, 2, 4, "'exit loop' stands outside of any loop", ""},
    {"def f\n exit section\nend", 2, 2, 4, "'exit section' stands outside of any section", ""},
    {"def f\n continue\nend", 2, 2, 8, "'continue' stands outside of any loop", ""},
    {"def f\n case 1\nend", 2, 2, 4, "'case' stands outside of a case_of block",
     "it begins with a line: case_of EXPRESSION"},
    {"def f\n command\n poly brick\nend", 2, 2, 7, "this 'command' has no 'endcommand'", ""},
    {"def f\n command\n poly brick [a\n endcommand\nend", 3, 13, 1, "the bracket is not closed",
     "put ] after the expression"},
    {"def f\n command\n poly brick [a + ]\n endcommand\nend", 3, 17, 1, "expected a value, found the end of the line",
     "a number, a text in quotes, a name or a parenthesis belongs there"},
    {"def f\n def g\n end\nend", 2, 2, 3, "a function begins inside of another one",
     "the function 'f' of line 1 has no 'end' yet"},
    {"def f\n array a\nend", 2, 8, 1, "the array 'a' has no size", "write a(n) or a(n,m)"},
    {"def f\n array 3\nend", 2, 8, 1, "expected the name of an array, found '3'", ""},
    {"def f\n local 3\nend", 2, 8, 1, "expected the name of a variable, found '3'", ""},
    // Errors that depend on the meaning of names.
    {"def f\n sin = 3\nend", 2, 2, 3, "'sin' can be read, not set", ""},
    {"def f\n time = 3\nend", 2, 2, 4, "'time' can be read, not set", "use another name for the variable"},
    {"def f\n a = sin(1,2)\nend", 2, 6, 3, "'sin' takes 1 argument, here it is given 2", ""},
    {"def f\n a = max()\nend", 2, 6, 3, "'max' takes 1 to 20 arguments, here it is given none", ""},
    {"def f\n a = helper(1)\nend", 2, 6, 6, "'helper' takes 2 arguments, here it is given 1", ""},
    {"def f\n helper = 1\nend", 2, 2, 6, "'helper' is a function: it cannot be assigned here",
     "use another name for the variable"},
    {"def f\n gp_xvel = 1\nend", 2, 2, 7, "'gp_xvel' takes 1 argument, here it is given none", ""},
    {"def f\n f(3) = 2\nend", 2, 2, 1, "'f' is this function: a call of it cannot be assigned", ""},
    {"def f\n a() = 2\nend", 2, 2, 1, "'a()' names no element of an array", ""},
};

TEST(FishCompiler, EveryMistakeHasAPlaceAndWords) {
    for (const auto& mistake : mistakes) {
        try {
            compiled(mistake.text);
            ADD_FAILURE() << "accepted:\n" << mistake.text;
        } catch (const Diagnostic& d) {
            EXPECT_EQ(d.place.line, mistake.line) << mistake.text;
            EXPECT_EQ(d.place.column, mistake.column) << mistake.text;
            EXPECT_EQ(d.place.length, mistake.length) << mistake.text;
            EXPECT_EQ(d.message, mistake.message) << mistake.text;
            EXPECT_EQ(d.hint, mistake.hint) << mistake.text;
        }
    }
}

TEST(FishCompiler, PlacesCountFromTheLineOfTheDeck) {
    const std::string text = "def f\n a = (\nend";
    try {
        read_function(text, place_of(text, 41));
        FAIL();
    } catch (const Diagnostic& d) {
        EXPECT_EQ(render(d), "deck.3ddat:42:7: error: expected a value, found the end of the line\n"
                             "    42 |  a = (\n"
                             "       |       ^ a number, a text in quotes, a name or a parenthesis belongs there");
    }
}

TEST(FishCompiler, TooDeepTextIsRefusedBeforeLuaSeesIt) {
    const auto message = [](const std::string& text) {
        try {
            compiled(text);
        } catch (const Diagnostic& d) { return d.message; }
        return std::string("accepted");
    };
    EXPECT_EQ(message("def f\n a = " + std::string(200, '(') + "1\nend"), "the expression is nested too deeply");
    EXPECT_EQ(message("def f\n a = " + std::string(5000, '-') + "1\nend"), "the expression is nested too deeply");
    std::string sum = "1";
    for (int i = 0; i < 1000; ++i) sum += i % 2 == 0 ? "+1" : "-1";
    EXPECT_EQ(message("def f\n a = " + sum + "\nend"), "accepted");
    EXPECT_EQ(message("def f\n a = " + sum + "+1\nend"), "the expression has more than 1000 operators");
    std::string blocks = "def f\n";
    for (int i = 0; i < 60; ++i) blocks += "if 1\n";
    EXPECT_EQ(message(blocks + "end"), "more than 40 blocks stand in each other");
    std::string call = "def f\n a = max(1";
    for (int i = 0; i < 60; ++i) call += ",1";
    EXPECT_EQ(message(call + ")\nend"), "'max' is given more than 50 arguments");
}

TEST(FishCompiler, EachStatementStaysOnItsLine) {
    const std::string lua = compiled("def f\n\n a = 1\n ; comment\n if a &\n  > 0\n  a = 2\n endif\nend", 10);
    std::vector<std::string> lines;
    std::string rest;
    for (const char c : lua + "\n") {
        if (c == '\n') lines.push_back(std::exchange(rest, {}));
        else rest += c;
    }
    ASSERT_EQ(lines.size(), 9);
    EXPECT_EQ(lines[2], "G.a = 1; ");
    EXPECT_EQ(lines[4], "if G.a > 0 then ");
    EXPECT_EQ(lines[6], "G.a = 2; ");
    EXPECT_EQ(lines[7], "end ");
    EXPECT_EQ(lines[8], "return v_return end");
}

TEST(FishCompiler, ArithmeticIsPlainLuaWhereBothAgree) {
    const auto expression = [](const std::string& text) {
        return generate(read_expression(text, place_of(text)), meaning);
    };
    EXPECT_THAT(expression("a + b * (c - 1)"), HasSubstr("return G.a + G.b * (G.c - 1) end"));
    EXPECT_THAT(expression("a / 2.5 - a / 2"), HasSubstr("return G.a / 2.5 - R.divide(G.a, 2) end"));
    EXPECT_THAT(expression("gp_xvel(p) = -1"), HasSubstr("W_gp_xvel(G.p, given)"));
    EXPECT_THAT(expression("0.1 + 1e300 + 3."), HasSubstr("return 0.1 + 1e+300 + 3.0 end"));
    EXPECT_THAT(expression("while + time"), HasSubstr("return G[\"while\"] + A_time() end"));
}

TEST(FishCompiler, AFunctionListsTheNamesItUses) {
    const std::string text = "def f(a)\n local b\n b = c(1) + sin(a)\n command\n hist @d [g]\n endcommand\n f = e\nend";
    const Function function = read_function(text, place_of(text));
    EXPECT_EQ(function.name, "f");
    EXPECT_THAT(function.arguments, ElementsAre("a"));
    EXPECT_THAT(function.mentions, ElementsAre("c", "e", "f", "g", "sin"));
    const std::string lines = "def f\n command\n [a = b]\n [c(1)]\n endcommand\nend";
    EXPECT_THAT(read_function(lines, place_of(lines)).mentions, ElementsAre("a", "b", "c"));
}

TEST(FishCompiler, WhilesteppingIsSeenInBothSpellings) {
    for (const std::string word : {"whilestepping", "while_stepping", "WhileStepping"}) {
        const std::string text = "def f\n" + word + "\nend";
        EXPECT_TRUE(read_function(text, place_of(text)).whilestepping);
    }
}

} // namespace
} // namespace kaya::fish
