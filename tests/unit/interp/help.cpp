#include "lang/interp/help.hpp"

#include "bound.hpp"

#include <gmock/gmock.h>
#include <map>
#include <set>

namespace kaya::lang {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Help, UsageOfACommand) {
    std::map<std::string, std::string> usages;
    for (const auto& family : classic().families)
        for (const auto& command : family.commands) usages[command.name()] = usage(command);
    EXPECT_EQ(usages["poly brick"],
              "poly brick x1 x2 [y1 y2] [z1 z2] [region n] [material n] [constitutive n] [group name]");
    EXPECT_EQ(usages["facetri edge"], "facetri edge edge [range ...]");
    EXPECT_EQ(usages["define"], "define name [argument ...] ... end");
}

TEST(Help, ListNamesEveryCommand) {
    const std::string list = help_list(classic());
    for (const auto& family : classic().families)
        for (const auto& command : family.commands) EXPECT_THAT(list, HasSubstr("    " + command.name() + " "));
}

TEST(Help, OnACommandInAnySpelling) {
    for (const char* word : {"solve", "SOL"}) {
        EXPECT_THAT(help_on(classic(), word), HasSubstr("ratio r"));
        EXPECT_THAT(help_on(classic(), word), HasSubstr("solve ratio 1e-6 cyc 5000"));
    }
    EXPECT_THAT(help_on(classic(), "poly"), HasSubstr("limits in x"));
    EXPECT_THAT(help_on(classic(), "gen edge"), HasSubstr("average edge of a zone"));
    EXPECT_THAT(help_on(classic(), "print"), HasSubstr("also spelled: list (print)"));
}

TEST(Help, NamesQuantitiesByUnits) {
    EXPECT_THAT(help_on(classic(), "prop"), HasSubstr("density of blocks [mass/length^3]"));
    const Units si("si");
    EXPECT_THAT(help_on(classic(), "prop", si), HasSubstr("density of blocks [kg/m^3]"));
    EXPECT_THAT(help_on(classic(), "gravity", si), HasSubstr("gx gy gz [m/s^2]"));
    // Brackets of syntax and of examples are not quantities.
    for (const std::string_view word : {"range", "fish list", "poly", "bound", "hist"}) {
        const std::string plain = help_on(classic(), word), labelled = help_on(classic(), word, si);
        EXPECT_EQ(plain.substr(0, plain.find('\n')), labelled.substr(0, labelled.find('\n'))) << word;
    }
    EXPECT_THAT(help_on(classic(), "range", si), HasSubstr("[distance distance]"));
}

TEST(Help, FormsOfACommand) {
    const std::string all = help_on(classic(), "hist");
    EXPECT_THAT(all, HasSubstr("largest unbalanced force"));
    const std::string one = help_on(classic(), "hist write");
    EXPECT_THAT(one, HasSubstr("hist write 2 3 4 vs 5 curves.csv"));
    EXPECT_THAT(one, Not(HasSubstr("largest unbalanced force")));
}

TEST(Help, OnKeywordsAndRanges) {
    EXPECT_THAT(help_on(classic(), "xvel"), HasSubstr("boundary ... xvel v"));
    EXPECT_THAT(help_on(classic(), "xvel"), HasSubstr("history ... xvel x y z"));
    EXPECT_THAT(help_on(classic(), "sine"), HasSubstr("boundary ... hist ... sine")) << "inside of a keyword";
    EXPECT_THAT(help_on(classic(), "range"), HasSubstr("inside a sphere"));
    EXPECT_THAT(help_on(classic(), "range"), HasSubstr("range name"));
}

TEST(Help, OnAnUnknownWord) {
    try {
        help_on(classic(), "densty");
        FAIL();
    } catch (const Diagnostic& d) {
        EXPECT_EQ(d.message, "there is no command and no keyword 'densty'");
        EXPECT_EQ(d.hint, "did you mean 'density'?");
    }
}

/// The topic of a hint "expected: a, b, ...; 'kaya help TOPIC' lists all"; empty if the hint lists all itself.
std::string topic_of(const std::string& hint) {
    constexpr std::string_view before = "'kaya help ", after = "' lists all";
    const auto from = hint.find(before);
    if (from == std::string::npos || !hint.ends_with(after)) return {};
    const auto begin = from + before.size();
    return hint.substr(begin, hint.size() - after.size() - begin);
}

/// The hint of a line that ends with an unknown word, and the proposals of `?` there.
struct WrongPlace {
    std::string hint;
    std::vector<std::string> words;
};

WrongPlace wrong_place(const std::string& line) {
    WrongPlace place;
    try {
        bound(line + " zzqqzzqqzz");
    } catch (const Diagnostic& d) { place.hint = d.hint; }
    try {
        bound(line + " ?");
    } catch (const Choices& choices) { place.words = choices.words; } catch (const Diagnostic&) {
    }
    return place;
}

TEST(Help, TopicsOfHintsListAllThatMayStandThere) {
    std::vector<std::string> lines{"hide range", "bound xvel 0 range"};
    for_each_command(classic(), [&](const CommandSpec& command) { lines.push_back(command.name()); });
    std::set<std::string> topics;
    for (const auto& line : lines) {
        const auto [hint, words] = wrong_place(line);
        const std::string topic = topic_of(hint);
        if (topic.empty()) continue;
        topics.insert(topic);
        EXPECT_GT(words.size(), 8u) << line;
        const std::string page = help_on(classic(), topic), range = help_on(classic(), "range");
        for (const auto& word : words)
            if (page.find(word) == std::string::npos) {
                // Elements of a range without its word; the page of the command names that page.
                EXPECT_THAT(range, HasSubstr(word)) << "'kaya help " << topic << "' does not list it";
                EXPECT_THAT(page, HasSubstr("help range")) << topic;
            }
    }
    for (const char* topic : {"range", "history", "boundary", "list", "solve", "set"})
        EXPECT_TRUE(topics.contains(topic)) << topic;
}

TEST(Completion, OfCommandsKeywordsAndElements) {
    EXPECT_THAT(completions(classic(), "po"), ElementsAre("poly"));
    EXPECT_THAT(completions(classic(), "poly br"), ElementsAre("brick"));
    EXPECT_THAT(completions(classic(), "BOUND XV"), ElementsAre("xvel", "xvelocity", "xviscous"));
    EXPECT_THAT(completions(classic(), "hide range sp"), ElementsAre("sphere"));
    EXPECT_THAT(completions(classic(), "hide range plane ab"), ElementsAre("above"));
    EXPECT_THAT(completions(classic(), "solve ratio 1e-5 el"), ElementsAre("elastic"));
    EXPECT_TRUE(completions(classic(), "solve ratio ").empty()) << "a number must follow";
    EXPECT_TRUE(completions(classic(), "polly br").empty());
    EXPECT_GT(completions(classic(), "").size(), 30u);
}

} // namespace
} // namespace kaya::lang
