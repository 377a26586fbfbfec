// Commands whose names have more than two words, as in the newer dialect.
#include "lang/commands/builder.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/help.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaya::lang {
namespace {

Language dialect() {
    Entry<Save> assign({"block"}, {"zone"});
    assign.then({"cmodel"}).then({"assign"}).help("gives zones a model");
    assign.argument(text("name"), &Save::file);
    Entry<Restore> generate({"block"}, {"zone"});
    generate.then({"generate"}).help("makes zones");
    generate.argument(text("edge"), &Restore::file);
    Entry<Title> whole({"block"}, {"zone"});
    whole.then({"cmodel"}).then({"assign"}).then({"all"}).help("of all zones");
    return {{{"blocks", "", {assign, generate, whole}}}, {}};
}

Statement statement_of(const std::string& text) {
    Lexer lexer(source_from_text("test.3dd", text));
    Statement statement;
    EXPECT_TRUE(lexer.next(statement));
    return statement;
}

Diagnostic mistake(const std::string& text) {
    try {
        (void)bind_statement(dialect(), statement_of(text));
    } catch (const Diagnostic& d) { return d; }
    ADD_FAILURE() << "'" << text << "' was accepted";
    return Diagnostic("");
}

TEST(DeepNames, AreFoundWordByWord) {
    const Language language = dialect();
    const Statement statement = statement_of("bl zo cm as elastic");
    Spelled spelled;
    const auto bound = bind_statement(language, statement, nullptr, &spelled);
    EXPECT_EQ(bound.spec->name(), "block zone cmodel assign");
    EXPECT_EQ(std::any_cast<Save>(bound.command).file, "elastic");
    EXPECT_EQ(spelled, (Spelled{{0, "block"}, {1, "zone"}, {2, "cmodel"}, {3, "assign"}}));
    const auto other = bind_statement(language, statement_of("block zone gen 2"));
    EXPECT_EQ(std::any_cast<Restore>(other.command).file, "2");
}

TEST(DeepNames, TheLongestCounts) {
    const Language language = dialect();
    EXPECT_EQ(bind_statement(language, statement_of("block zone cmodel assign all")).spec->name(),
              "block zone cmodel assign all");
}

TEST(DeepNames, TheFirstWrongWordIsNamed) {
    EXPECT_EQ(mistake("block zoen cmodel").message, "'zoen' is not a kind of block");
    const auto wrong = mistake("block zone cmodle assign elastic");
    EXPECT_EQ(wrong.message, "'cmodle' is not a kind of block zone");
    EXPECT_EQ(wrong.hint, "did you mean 'cmodel'?");
    EXPECT_EQ(wrong.place.column, 12);
    EXPECT_EQ(mistake("block zone cmodel asign elastic").message, "'asign' is not a kind of block zone cmodel");
}

TEST(DeepNames, AMissingWordIsSaid) {
    const auto missing = mistake("block zone");
    EXPECT_EQ(missing.message, "a word is missing after 'zone'");
    EXPECT_EQ(missing.hint, "expected: cmodel, generate");
    EXPECT_EQ(mistake("block zone cmodel").hint, "expected: assign");
}

TEST(DeepNames, HelpAndCompletionFollowThem) {
    const Language language = dialect();
    EXPECT_THAT(help_on(language, "block zone generate"), testing::StartsWith("block zone generate edge"));
    EXPECT_EQ(completions(language, "block zone c"), std::vector<std::string>{"cmodel"});
    EXPECT_EQ(completions(language, "block zone "), (std::vector<std::string>{"cmodel", "generate"}));
}

} // namespace
} // namespace kaya::lang
