#include "lang/interp/lexer.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya::lang {
namespace {

std::vector<Statement> statements(const std::string& text) {
    std::vector<Statement> all;
    Lexer lexer(source_from_text("t", text));
    Statement s;
    while (lexer.next(s)) all.push_back(s);
    return all;
}

Statement statement(const std::string& text) {
    auto all = statements(text);
    EXPECT_EQ(all.size(), 1u) << text;
    return all.empty() ? Statement{} : all.front();
}

std::vector<std::string> texts(const std::string& text) {
    std::vector<std::string> words;
    for (const auto& w : statement(text).words) words.push_back(w.text);
    return words;
}

using Texts = std::vector<std::string>;

TEST(Lexer, BlanksOfTheLanguage) {
    EXPECT_EQ(texts("poly brick (0,1) (0,1),0 1"), (Texts{"poly", "brick", "0", "1", "0", "1", "0", "1"}));
    EXPECT_EQ(texts("\tprop\tmat=1 dens = 5"), (Texts{"prop", "mat", "1", "dens", "5"}));
}

TEST(Lexer, CaseIsFoldedButKept) {
    const auto s = statement("Group Block 'Left Wall' NORTH");
    EXPECT_EQ(s.words[0].folded, "group");
    EXPECT_EQ(s.words[0].text, "Group");
    EXPECT_EQ(s.words[2].text, "Left Wall");
    EXPECT_EQ(s.words[2].kind, WordKind::text);
    EXPECT_EQ(s.words[3].folded, "north");
}

TEST(Lexer, Comments) {
    EXPECT_EQ(texts("new ; poly brick"), Texts{"new"});
    EXPECT_EQ(texts("title 'a;b' ;c"), (Texts{"title", "a;b"}));
    EXPECT_TRUE(statements("; only\n\n   ;comments\n").empty());
    EXPECT_TRUE(statements("").empty());
}

TEST(Lexer, BracketsOverSeveralLinesAreOneStatement) {
    struct Case {
        const char* text;
        Texts words;
    };
    const Case cases[] = {
        {"[\n a = 1\nf(2) ; c\n]", {"a = 1", "f(2) ; c"}},
        {"  [a = 1\n\n; none\n  b = ']'  ]  ; end", {"a = 1", "b = ']'  "}},
        {"[ ; begin ]\na = (1 + ...\n  2)\n]", {"a = (1 + ...\n  2)"}},
        {"[a = x & ; more\n  y\nb\n]", {"a = x & ; more\n  y", "b"}},
        {"[\nl = m[1]\n]", {"l = m[1]"}},
    };
    for (const Case& one : cases) {
        const Statement s = statement(one.text);
        Texts words;
        for (const auto& word : s.words) {
            EXPECT_EQ(word.kind, WordKind::expression);
            words.push_back(word.text);
        }
        EXPECT_EQ(words, one.words) << one.text;
        EXPECT_EQ(s.first_line, 1);
    }
    const auto all = statements("new\n[\n]\n[\n  a = 1\n]\n[b]\nnew");
    ASSERT_EQ(all.size(), 4u) << "an empty bracket is no statement";
    EXPECT_EQ(all[1].first_line, 4);
    EXPECT_EQ(all[1].last_line, 6);
    EXPECT_EQ(all[1].words[0].place.line, 5);
    EXPECT_EQ(all[1].words[0].place.column, 3);
    EXPECT_EQ(all[2].words[0].text, "b");
}

TEST(Lexer, BracketsThatAreNeverClosedAreOpen) {
    for (const char* text : {"[\na = 1\nnew", "[a = 1\nnew\n[b = 2]", "[\na\n] new", "[\n ; ]\n"}) {
        const auto all = statements(text);
        ASSERT_FALSE(all.empty());
        EXPECT_EQ(all.front().words.front().kind, WordKind::open) << text;
    }
}

TEST(Lexer, Continuation) {
    for (const char* text : {"a b &\nc", "a b ...\nc", "a b&\nc", "a b...\nc", "a b & ; comment\n  c", "a b... ;x\nc",
                             "a &\nb ...\n c", "a b)&\nc", "a b&\n ; a line taken out\nc"})
        EXPECT_EQ(texts(text), (Texts{"a", "b", "c"})) << text;
    EXPECT_EQ(statements("a &\n\nb").size(), 2u) << "a blank line ends the statement";
    EXPECT_EQ(texts("a 3....\n5"), (Texts{"a", "3.", "5"}));
    EXPECT_EQ(texts("a b &"), (Texts{"a", "b"})) << "nothing follows the mark";
}

TEST(Lexer, PlacesAcrossContinuation) {
    const auto s = statement("poly &\n   brick 'x'");
    EXPECT_EQ(s.words[1].place.line, 2);
    EXPECT_EQ(s.words[1].place.column, 4);
    EXPECT_EQ(s.words[1].place.length, 5);
    EXPECT_EQ(s.words[2].place.length, 3) << "the quotes belong to the word";
    EXPECT_EQ(s.first_line, 1);
    EXPECT_EQ(s.last_line, 2);
}

TEST(Lexer, Numbers) {
    const auto s = statement("3 3. .5 -0.15 +0.01 1e-6 1E6 -4 007");
    const double values[] = {3, 3, .5, -.15, .01, 1e-6, 1e6, -4, 7};
    const bool whole[] = {true, false, false, false, false, false, false, true, true};
    for (std::size_t i = 0; i < s.words.size(); ++i) {
        EXPECT_EQ(s.words[i].kind, WordKind::number) << s.words[i].text;
        EXPECT_DOUBLE_EQ(s.words[i].number, values[i]);
        EXPECT_EQ(s.words[i].whole, whole[i]) << s.words[i].text;
    }
    for (const auto& w : statement("inf nan -inf - + . 1e 1e+ 3dec 0x10 1-2 +-1 --1 1.2.3 building0513").words)
        EXPECT_EQ(w.kind, WordKind::word) << w.text;
    EXPECT_TRUE(std::isinf(statement("1e999").words[0].number));
    EXPECT_EQ(statement("1e-999").words[0].number, 0);
    EXPECT_FALSE(statement("99999999999999999999").words[0].whole) << "more than 64 bits";
}

TEST(Lexer, Quotes) {
    EXPECT_EQ(texts("a 'it''s' \"say \"\"no\"\"\" ''"), (Texts{"a", "it's", "say \"no\"", ""}));
    EXPECT_EQ(texts("a 'x & y ...' b"), (Texts{"a", "x & y ...", "b"}));
    EXPECT_EQ(texts("don't"), Texts{"don't"}) << "a quote inside a word is part of it";
    const auto s = statement("a 'never");
    EXPECT_EQ(s.words[1].kind, WordKind::open);
    EXPECT_EQ(s.words[1].place.column, 3);
}

TEST(Lexer, NamesAndExpressions) {
    const auto s = statement("bound xvel @v @f(1, g(2)) [a*(b+c)] [list['x]']] @ ");
    ASSERT_EQ(s.words.size(), 7u);
    EXPECT_EQ(s.words[2].text, "v");
    EXPECT_EQ(s.words[3].text, "f(1, g(2))");
    EXPECT_EQ(s.words[3].kind, WordKind::symbol);
    EXPECT_EQ(s.words[4].text, "a*(b+c)");
    EXPECT_EQ(s.words[4].kind, WordKind::expression);
    EXPECT_EQ(s.words[5].text, "list['x]']");
    EXPECT_EQ(s.words[6].kind, WordKind::symbol);
    EXPECT_TRUE(s.words[6].text.empty());
    EXPECT_EQ(statement("@f(1").words[0].kind, WordKind::open);
    EXPECT_EQ(statement("[a").words[0].kind, WordKind::open);
    EXPECT_EQ(texts("@a(1)&\n2"), (Texts{"a(1)", "2"}));
}

TEST(Lexer, RawKeepsWhatWasTyped) {
    EXPECT_EQ(statement("title  Shear (test), a = 5 ; note").raw(1), "Shear (test), a = 5");
    EXPECT_EQ(statement("title Shear ( test ) ; note").raw(1), "Shear ( test )");
    EXPECT_EQ(statement("title ( one ) brick").raw(1), "( one ) brick");
    EXPECT_EQ(statement("title Shear, ; note").raw(1), "Shear");
    EXPECT_EQ(statement("title one &\n  two").raw(1), "one two");
    EXPECT_EQ(statement("title It's late").raw(1), "It's late");
    EXPECT_EQ(statement("title").raw(1), "");
}

TEST(Lexer, LongLinesAndOddBytes) {
    std::string line = "poly";
    for (int i = 0; i < 2500; ++i) line += " 1";
    EXPECT_EQ(statement(line).words.size(), 2501u);
    EXPECT_EQ(statement(std::string(200000, '(') + "a").words.size(), 1u);
    EXPECT_EQ(statement("@f" + std::string(100000, '(')).words.size(), 1u);
    EXPECT_EQ(texts("gr\xFCn \xE2\x82\xAC"), (Texts{"gr\xFCn", "\xE2\x82\xAC"}));
    EXPECT_EQ(texts("a & b"), (Texts{"a", "&", "b"})) << "a mark inside the line is a word like any other";
}

} // namespace
} // namespace kaya::lang
