// The decks of tests/wrong: every error with its exact position, message and hint.
#include "commands/review/deck_review.hpp"
#include "commands/session/session.hpp"
#include "lang/modern/language.hpp"
#include "tests/unit/commands/running.hpp"
#include "tests/unit/scratch_folder.hpp"

#include "base/pattern.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace kaya::lang {
namespace {

namespace fs = std::filesystem;

const fs::path folder = KAYA_WRONG_DECKS;

using Lines = std::vector<std::string>;

/// Carets and the text after them: an expectation about the line above.
bool is_expectation(const std::string& line) {
    const auto caret = line.find_first_not_of(" \t");
    return caret != std::string::npos && line[caret] == '^';
}

/// Replaces the words in a hint that shows a few of a long list, so that a new word of the language changes no file here.
/// interp/suggestions.cpp tests the words shown, interp/help.cpp the complete list in the help.
std::string without_words(const std::string& hint) {
    constexpr std::string_view before = "expected: ", after = ", ...; 'kaya help ";
    const auto end = hint.find(after);
    if (!hint.starts_with(before) || end == std::string::npos) return hint;
    return std::string(before) + hint.substr(end + 2);
}

/// The carets below a line, at the column of the error, with tabs preserved.
std::string carets(const Diagnostic& d, const std::string& line) {
    std::string text;
    for (int i = 0; i < d.place.column - 1; ++i) {
        const char c = i < static_cast<int>(line.size()) ? line[static_cast<std::size_t>(i)] : ' ';
        text += c == '\t' ? '\t' : ' ';
    }
    text.append(static_cast<std::size_t>(d.place.length), '^').append(" ");
    if (d.severity == Severity::warning) text += "warning: ";
    if (d.severity == Severity::note && d.code != "choices") text += "note: ";
    text += d.message;
    if (!d.hint.empty()) text.append(" | ").append(without_words(d.hint));
    return text;
}

/// An empty working folder, with the files of tests/wrong that a deck names.
class WorkingFolder {
public:
    explicit WorkingFolder(const std::string& deck) {
        for (const auto& entry : fs::directory_iterator(folder))
            if (deck.find(entry.path().filename()) != deck.npos) fs::copy(entry.path(), scratch_.path());
        fs::current_path(scratch_.path());
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
    ~WorkingFolder() { fs::current_path(before_); }

private:
    fs::path before_ = fs::current_path();
    test::ScratchFolder scratch_;
};

/// Messages before the first command: mistakes of lines, or else findings of the whole.
std::vector<Diagnostic> told_before(const std::string& text) {
    const Checks checks = deck_checks();
    BareNames names;
    try {
        const auto file = bind_text(language(), source_from_text("deck", text), {}, &checks, &names);
        const Session session{Options{}};
        DeckReview review(names, *session.engine.scripts, {fs::current_path()}, {KAYA_TEST_JOINTS});
        review.file(*file);
        return review.findings();
    } catch (const DeckErrors& errors) { return errors.all; } catch (const Diagnostic& problem) {
        return {problem};
    }
}

/// What a run tells: "deck:8:1: warning: text", the line, and under it carets and the hint.
class RunTalk : public Running {
public:
    explicit RunTalk(const std::string& text) {
        std::string said_last;
        session().engine.joints.set_path({KAYA_TEST_JOINTS});
        try {
            session().deck.interpreter.run_text(text, "deck");
        } catch (const Diagnostic& mistake) { said_last = render(mistake); }
        std::istringstream lines(said() + said_last);
        for (std::string line; std::getline(lines, line);) take(line);
    }
    std::vector<Diagnostic> told;

private:
    void TestBody() override {}

    void take(const std::string& line) {
        static const Pattern head("deck:\\d+:\\d+: (error|warning|note): .*");
        const auto bar = line.find("| ");
        if (head.matches(line)) {
            std::istringstream parts(line.substr(5));
            Diagnostic d("");
            char colon = 0;
            std::string severity;
            parts >> d.place.line >> colon >> d.place.column >> colon >> severity;
            std::getline(parts >> std::ws, d.message);
            d.severity = severity == "error:"  ? Severity::error
                         : severity == "note:" ? Severity::note
                                               : Severity::warning;
            told.push_back(d);
        } else if (!told.empty() && told.back().hint.empty() && bar != line.npos && line.find('^') != line.npos) {
            const auto from = line.find('^'), to = line.find_first_not_of('^', from);
            told.back().place.length = static_cast<int>(std::min(to, line.size()) - from);
            if (to != line.npos) told.back().hint = line.substr(to + 1);
        }
    }
};

/// The deck with the messages of kaya: those before the run, or else those of the run.
Lines annotated(const Lines& deck, const Lines& before) {
    std::string text;
    for (const auto& line : before) text += line + "\n";
    for (const auto& line : deck) text += line + "\n";
    const WorkingFolder here(text);
    std::vector<Diagnostic> mistakes = told_before(text);
    if (mistakes.empty()) mistakes = RunTalk(text).told;
    const auto first = static_cast<int>(before.size());
    Lines result;
    for (std::size_t i = 0; i < deck.size(); ++i) {
        result.push_back(deck[i]);
        for (const auto& d : mistakes)
            if (d.place.line == first + static_cast<int>(i) + 1) result.push_back(carets(d, deck[i]));
    }
    return result;
}

/// Paragraphs of a file.
std::vector<Lines> decks_of(const fs::path& file) {
    std::vector<Lines> decks(1);
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.empty()) decks.back().push_back(line);
        else if (!decks.back().empty()) decks.emplace_back();
    }
    if (decks.back().empty()) decks.pop_back();
    return decks;
}

std::string joined(const Lines& lines) {
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    return text;
}

/// Lines above the first mark `;each` are put before each deck of the file.
Lines take_common_lines(std::vector<Lines>& decks) {
    if (decks.empty() || decks.front().back() != ";each") return {};
    Lines common = std::move(decks.front());
    common.pop_back();
    decks.erase(decks.begin());
    return common;
}

/// Of the decks of a file: how many there are, and for how many a message points at a line and says what to do.
struct Count {
    std::size_t decks = 0, helped = 0;
};

Count expect_messages(const fs::path& file, bool bless) {
    Count count;
    auto decks = decks_of(file);
    const Lines common = take_common_lines(decks);
    std::string blessed = common.empty() ? "" : joined(common) + ";each\n";
    for (const auto& expected : decks) {
        Lines deck;
        std::copy_if(expected.begin(), expected.end(), std::back_inserter(deck),
                     [](const std::string& line) { return !is_expectation(line); });
        const Lines actual = annotated(deck, common);
        EXPECT_GT(actual.size(), deck.size()) << "no mistake was found in\n" << joined(deck);
        if (!bless) { EXPECT_EQ(joined(actual), joined(expected)) << file.filename(); }
        if (!blessed.empty()) blessed += '\n';
        blessed += joined(actual);
        ++count.decks;
        // A hint says what to do, and so does a limit: "cycle must be at least 0, not -5".
        count.helped += std::ranges::any_of(actual, [](const std::string& line) {
            return is_expectation(line) && (line.find(" | ") != line.npos || line.find(" must be ") != line.npos);
        });
    }
    if (bless) std::ofstream(file) << blessed;
    return count;
}

std::vector<fs::path> files_of_decks() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".txt") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

TEST(WrongDecks, GiveTheirMessages) {
    const bool bless = std::getenv("KAYA_BLESS") != nullptr;
    Count all, odd;
    for (const auto& file : files_of_decks()) {
        const Count count = expect_messages(file, bless);
        all.decks += count.decks;
        if (!file.filename().string().starts_with("odd-")) continue;
        odd.decks += count.decks;
        odd.helped += count.helped;
    }
    EXPECT_GE(all.decks, 300u);
    // Odd inputs of new users: all are answered, nearly all with what to do.
    EXPECT_GE(odd.decks, 900u);
    EXPECT_GE(static_cast<double>(odd.helped), 0.95 * static_cast<double>(odd.decks));
}

} // namespace
} // namespace kaya::lang
