// The fraction of misspelt words with the right suggestion, measured over the whole table.
#include "bound.hpp"

#include "lang/interp/short_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <optional>
#include <random>
#include <set>

namespace kaya::lang {
namespace {

/// All words that differ from `word` by one letter: omitted, doubled, inserted, replaced or swapped.
std::set<std::string> one_letter_off(const std::string& word) {
    static constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";
    std::set<std::string> all;
    for (std::size_t i = 0; i <= word.size(); ++i) {
        const std::string before = word.substr(0, i), after = word.substr(i);
        for (const char c : letters) {
            all.insert(before + c + after);
            if (!after.empty()) all.insert(before + c + after.substr(1));
        }
        if (!after.empty()) all.insert(before + after.substr(1));
        if (after.size() > 1) all.insert(before + after[1] + after[0] + after.substr(2));
    }
    all.erase(word);
    return all;
}

struct Score {
    int asked = 0, right = 0;
    std::vector<std::string> missed;
};

/// `resolves` returns whether the table accepts a word at this point; then there is no suggestion.
template <class Resolves>
void measure(const std::vector<std::vector<std::string_view>>& entries, Resolves resolves, Score& score) {
    std::vector<std::string_view> candidates;
    for (const auto& spellings : entries) candidates.insert(candidates.end(), spellings.begin(), spellings.end());
    for (const auto& spellings : entries)
        for (const auto word : spellings) {
            if (word.size() < 3) continue; // a short word is within one letter of nearly every other
            for (const auto& typed : one_letter_off(std::string(word))) {
                if (resolves(typed)) continue;
                ++score.asked;
                const auto near = did_you_mean(typed, candidates);
                if (std::find(spellings.begin(), spellings.end(), near) != spellings.end()) ++score.right;
                else score.missed.push_back(fmt::format("{} for {}: '{}'", typed, word, near));
            }
        }
}

std::vector<std::string_view> spellings_of(const std::vector<Spelling>& words) {
    std::vector<std::string_view> all;
    for (const Spelling& s : words) all.push_back(s.word);
    return all;
}

Score measure_keywords(const std::vector<KeywordSpec>& keywords) {
    Score score;
    std::vector<std::vector<std::string_view>> entries;
    for (const auto& keyword : keywords) entries.push_back(spellings_of(keyword.words));
    measure(
        entries, [&](const std::string& typed) { return find_keyword(keywords, typed) != nullptr; }, score);
    return score;
}

double percent(const Score& score) { return 100.0 * score.right / score.asked; }

/// The first words of classic commands; those of the modern dialect are few, and words of its tree are measured below.
TEST(Suggestions, OneLetterMisspellingsOfCommands) {
    std::vector<std::vector<std::string_view>> entries;
    std::set<std::string_view> seen;
    for (const auto& family : classic().families)
        for (const auto& command : family.commands)
            if (seen.insert(command.words.front().word).second) entries.push_back(spellings_of(command.words));
    const auto resolves = [&](const std::string& typed) {
        for (const auto& family : classic().families)
            for (const auto& command : family.commands)
                for (const Spelling& s : command.words)
                    if (s.matches(typed)) return true;
        return false;
    };
    Score score;
    measure(entries, resolves, score);
    fmt::print("commands: {} of {} ({:.1f} %)\n", score.right, score.asked, percent(score));
    EXPECT_GT(score.asked, 5000);
    EXPECT_GE(percent(score), 97);
}

TEST(Suggestions, OneLetterMisspellingsOfKeywords) {
    Score total;
    const auto add = [&](const Score& score, const std::string& where) {
        total.asked += score.asked;
        total.right += score.right;
        if (score.asked > 0 && percent(score) < 90)
            fmt::print("  {}: {:.1f} %, e.g. {}\n", where, percent(score), score.missed.front());
    };
    for (const Language* dialect : {&classic(), &modern()}) {
        for_each_command(*dialect,
                         [&](const CommandSpec& command) { add(measure_keywords(command.keywords), command.name()); });
        add(measure_keywords(dialect->range_elements), "range");
    }
    fmt::print("keywords: {} of {} ({:.1f} %)\n", total.right, total.asked, percent(total));
    EXPECT_GT(total.asked, 10000);
    EXPECT_GE(percent(total), 90);
}

/// The second and third words of modern lines: each among those that may stand there.
TEST(Suggestions, OneLetterMisspellingsOfTheModernTree) {
    std::map<std::string, std::vector<std::vector<std::string_view>>> below;
    for_each_command(modern(), [&](const CommandSpec& command) {
        std::string before(command.words.front().word);
        for (const auto& words : command.form) {
            auto& known = below[before];
            const auto spelled = spellings_of(words);
            if (std::ranges::find(known, spelled) == known.end()) known.push_back(spelled);
            before.append(" ").append(words.front().word);
        }
    });
    Score score;
    for (const auto& [before, entries] : below)
        measure(
            entries,
            [&, &entries = entries](const std::string& typed) {
                return std::ranges::any_of(entries, [&](const auto& words) {
                    return std::ranges::any_of(words, [&](auto word) { return Spelling(word, 2).matches(typed); });
                });
            },
            score);
    fmt::print("tree: {} of {} ({:.1f} %)\n", score.right, score.asked, percent(score));
    EXPECT_GT(score.asked, 10000);
    EXPECT_GE(percent(score), 95);
}

/// The whole words of a line; nothing when it does not bind.
std::optional<Spelled> words_of_line(const std::string& line) {
    try {
        Lexer lexer(source_from_text("test", line));
        Statement statement;
        Spelled spelled;
        if (!next_statement(language(), lexer, statement)) return std::nullopt;
        bind_statement(language(), statement, nullptr, &spelled);
        return spelled;
    } catch (const Diagnostic&) { return std::nullopt; }
}

/// The proposal of the message about a line; empty when the line binds or has none.
std::optional<std::string> proposal(const std::string& line) {
    try {
        bound(line);
        return std::nullopt;
    } catch (const Diagnostic& d) {
        const auto from = d.hint.find("did you mean '");
        if (from == d.hint.npos) return "";
        const auto begin = d.hint.find('\'', from) + 1;
        return d.hint.substr(begin, d.hint.find('\'', begin) - begin);
    }
}

/// Two slips in each word of the table that a line holds. A proposal is right when the line means the same with it as before.
void measure_line(const std::string& line, std::mt19937_64& random, Score& score) {
    const auto words = words_of_line(line);
    if (!words || line.find('\n') != line.npos) return;
    Lexer lexer(source_from_text("test", line));
    Statement statement;
    lexer.next(statement);
    for (const auto& [at, whole] : *words) {
        if (whole.size() < 4) continue;
        const Place& place = statement.words[at].place;
        const auto with = [&](const std::string& word) {
            std::string other = line;
            return other.replace(static_cast<std::size_t>(place.column - 1), static_cast<std::size_t>(place.length),
                                 word);
        };
        const auto slips = one_letter_off(std::string(whole));
        for (int k = 0; k < 2; ++k) {
            const auto pick = std::uniform_int_distribution<std::size_t>(0, slips.size() - 1)(random);
            const std::string& slip = *std::next(slips.begin(), static_cast<std::ptrdiff_t>(pick));
            const auto proposed = proposal(with(slip));
            if (!proposed) continue; // a word, or a beginning of one
            ++score.asked;
            if (words_of_line(with(*proposed)) == words) ++score.right;
            else score.missed.push_back(fmt::format("{}: '{}'", with(slip), *proposed));
        }
    }
}

TEST(Suggestions, OneLetterMisspellingsInWholeLinesOfBothDialects) {
    constexpr std::uint64_t seed = 40;
    for (const Language* dialect : {&classic(), &modern()}) {
        std::mt19937_64 random(seed);
        Score score;
        for_each_command(*dialect, [&](const CommandSpec& command) {
            for (const auto& example : command.right) measure_line(std::string(example.text), random, score);
        });
        fmt::print("{} lines: {} of {} ({:.1f} %)\n", dialect == &classic() ? "classic" : "modern", score.right,
                   score.asked, percent(score));
        for (std::size_t i = 0; i < score.missed.size() && i < 20; ++i) fmt::print("  {}\n", score.missed[i]);
        EXPECT_GT(score.asked, 800);
        EXPECT_GE(percent(score), 95);
    }
}

/// A first word is proposed whose commands know the second one.
TEST(Suggestions, OfTheFirstWordFitTheSecond) {
    EXPECT_EQ(proposal("xmodel new"), "model");
    EXPECT_EQ(proposal("hmodel large-strain off"), "model");
    EXPECT_EQ(proposal("xmodel mohr jkn 1e9"), "jmodel");
    EXPECT_EQ(proposal("xmodel"), "jmodel") << "nothing follows that could tell";
}

TEST(Suggestions, OfShortWordsToo) {
    const std::vector<std::string_view> words = {"generate", "gravity", "group", "history"};
    EXPECT_EQ(did_you_mean("genn", words), "generate");
    EXPECT_EQ(did_you_mean("hsit", words), "history");
    EXPECT_EQ(did_you_mean("gruop", words), "group");
    EXPECT_EQ(did_you_mean("xyzzy", words), "");
    EXPECT_EQ(did_you_mean("", words), "");
    EXPECT_EQ(did_you_mean("group", {}), "");
}

TEST(Suggestions, ALongListShowsItsNearestWordsAndWhereAllAre) {
    const std::vector<std::string_view> words = {"ratio",   "force",   "cycles",     "time",    "clock",  "still",
                                                 "elastic", "bracket", "resolution", "include", "exclude"};
    const auto hint = [&](std::size_t count, const std::string& typed) {
        const std::vector<std::string_view> list(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(count));
        if (typed.empty()) return ShortList(list, "solve", nullptr).expected();
        Lexer lexer(source_from_text("test", typed));
        Statement statement;
        EXPECT_TRUE(lexer.next(statement));
        return ShortList(list, "solve", &statement.words.front()).expected();
    };
    const std::string first = "expected: ratio, force, cycles, time, clock, still, ...; 'kaya help solve' lists all";
    EXPECT_EQ(hint(words.size(), ""), first);
    EXPECT_EQ(hint(words.size(), "17"), first) << "a number is near to no word";
    EXPECT_THAT(hint(words.size(), "TIMEOUT"), testing::StartsWith("expected: time, "));
    EXPECT_THAT(hint(words.size(), "seclude"), testing::StartsWith("expected: include, exclude, "));
    EXPECT_EQ(hint(8, "seclude"), "expected: ratio, force, cycles, time, clock, still, elastic, bracket");
    EXPECT_THAT(hint(words.size(), "?"), testing::EndsWith(", include, exclude"));
}

// Hints must not list all words of a long table; help.cpp tests the complete lists.
TEST(Suggestions, NoHintOfTheLanguageListsMoreThanEightWords) {
    std::vector<std::string> lines{"hide range", "bound xvel 0 range", "poly",
                                   "gen",        "structure",          "insitu stress 0 0 0 0 0 0"};
    for (const Language* dialect : {&classic(), &modern()})
        for_each_command(*dialect, [&](const CommandSpec& command) { lines.push_back(command.name()); });
    for (const auto& line : lines)
        for (const char* end : {"", " zzqqzzqqzz", " 0 0 0 0 0 0 0 0 0 0"}) {
            std::string hint;
            try {
                bound(line + end);
            } catch (const Diagnostic& d) { hint = d.hint; }
            if (hint.starts_with("expected: ")) {
                EXPECT_LE(std::count(hint.begin(), hint.end(), ','), 7) << line << end << hint;
            }
        }
}

} // namespace
} // namespace kaya::lang
