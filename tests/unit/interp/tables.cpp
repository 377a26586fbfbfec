// The tables prove themselves: every right example binds, every wrong one gives exactly its message.
#include "bound.hpp"

#include <set>

namespace kaya::lang {
namespace {

template <class Visit> void for_each_command(Visit visit) {
    for (const auto& family : classic().families)
        for (const auto& command : family.commands) visit(command);
}

TEST(Tables, RightExamplesBindToTheirCommand) {
    int count = 0;
    for_each_command([&](const CommandSpec& command) {
        EXPECT_FALSE(command.right.empty()) << command.name() << " has no example";
        for (const auto& example : command.right) {
            ++count;
            SCOPED_TRACE(std::string(example.text));
            try {
                EXPECT_EQ(bound(std::string(example.text)).spec, &command);
            } catch (const Diagnostic& d) {
                ADD_FAILURE() << render(d);
            }
        }
    });
    EXPECT_GT(count, 80);
}

TEST(Tables, WrongExamplesGiveTheirMessageAndPlace) {
    int count = 0;
    for_each_command([&](const CommandSpec& command) {
        for (const auto& example : command.wrong) {
            ++count;
            SCOPED_TRACE(std::string(example.text));
            const Diagnostic d = mistake(std::string(example.text));
            EXPECT_EQ(d.message, example.message);
            EXPECT_TRUE(d.place) << "no place";
            EXPECT_GE(d.place.column, 1);
            EXPECT_FALSE(d.hint.empty() && d.code.empty());
        }
    });
    EXPECT_GT(count, 80);
}

TEST(Tables, CommandsThatTakeWordsHaveWrongExamples) {
    for_each_command([](const CommandSpec& command) {
        if (command.raw || command.otherwise) return; // these may take anything
        if (command.arguments.empty() && command.keywords.empty()) return;
        EXPECT_FALSE(command.wrong.empty()) << command.name();
    });
}

TEST(Tables, EverythingIsExplained) {
    for_each_command([](const CommandSpec& command) {
        EXPECT_FALSE(command.help.empty()) << command.name();
        for (const auto& keyword : command.keywords) EXPECT_FALSE(keyword.help.empty()) << command.name();
    });
    for (const auto& element : classic().range_elements) EXPECT_FALSE(element.help.empty());
}

/// A word that an earlier entry takes in full could never be reached.
void expect_distinct(const std::vector<KeywordSpec>& keywords, const std::string& where) {
    std::set<std::string_view> seen;
    for (const auto& keyword : keywords) {
        for (const Spelling& s : keyword.words)
            EXPECT_TRUE(seen.insert(s.word).second) << where << ": " << s.word;
        expect_distinct(keyword.keywords, where + " " + std::string(keyword.words.front().word));
    }
}

TEST(Tables, NoWordStandsTwice) {
    for_each_command([](const CommandSpec& command) { expect_distinct(command.keywords, command.name()); });
    expect_distinct(classic().range_elements, "range");
}

TEST(Tables, ShortSpellingsResolveInTableOrder) {
    const std::pair<const char*, const char*> spellings[] = {
        {"pro mat 1 k 1", "property"}, {"prop mat 1 k 1", "property"}, {"pri max", "list"},
        {"chang mat 1", "change"}, {"grav 0 0 1", "gravity"}, {"his unbal", "history"},
        {"hist unbal", "history"}, {"cyc 5", "cycle"}, {"st 5", "cycle"}, {"rest a", "restore"},
        {"ret", "return"}, {"pl block", "plot"}, {"po br 0 1", "poly brick"}, {"ge ed 1", "generate edge"},
        {"bo xv 0", "boundary"}, {"ini xv 0", "initialize"}, {"DAMP LOCAL", "damp"}, {"so", "solve"},
        {"see", "seek"}, {"sho", "seek"}, {"se dyn on", "set"}, {"del", "delete"},
        {"def f\nend", "define"}, {"jm jkn 1", "jmodel"}, {"hist wr a", "history write"},
        {"ti x", "title"},
    };
    for (const auto& [typed, meant] : spellings) EXPECT_EQ(bound(typed).spec->name(), meant) << typed;
}

TEST(Tables, OneLetterIsNoAbbreviation) {
    EXPECT_EQ(mistake("p mat 1").message, "'p' is not a command");
    EXPECT_EQ(mistake("poly b 0 1").message, "'b' is not a kind of poly");
}

} // namespace
} // namespace kaya::lang
