// The decks of tests/wrong: every error with its exact position, message and hint.
#include "commands/session.hpp"
#include "lang/modern/language.hpp"

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
    text.append(static_cast<std::size_t>(d.place.length), '^').append(" ").append(d.message);
    if (!d.hint.empty()) text.append(" | ").append(without_words(d.hint));
    return text;
}

/// The deck with the messages of kaya.
Lines annotated(const Lines& deck) {
    std::string text;
    for (const auto& line : deck) text += line + "\n";
    const Checks checks = deck_checks();
    std::vector<Diagnostic> mistakes;
    try {
        bind_text(language(), source_from_text("deck", text), {folder}, &checks);
    } catch (const DeckErrors& errors) { mistakes = errors.all; }
    Lines result;
    for (std::size_t i = 0; i < deck.size(); ++i) {
        result.push_back(deck[i]);
        for (const auto& d : mistakes)
            if (d.place.line == static_cast<int>(i) + 1) result.push_back(carets(d, deck[i]));
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

TEST(WrongDecks, GiveTheirMessages) {
    const bool bless = std::getenv("KAYA_BLESS") != nullptr;
    std::size_t count = 0;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".txt") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        std::string blessed;
        for (const auto& expected : decks_of(file)) {
            Lines deck;
            std::copy_if(expected.begin(), expected.end(), std::back_inserter(deck),
                         [](const std::string& line) { return !is_expectation(line); });
            const Lines actual = annotated(deck);
            EXPECT_GT(actual.size(), deck.size()) << "no mistake was found in\n" << joined(deck);
            if (!bless) { EXPECT_EQ(joined(actual), joined(expected)) << file.filename(); }
            if (!blessed.empty()) blessed += '\n';
            blessed += joined(actual);
            ++count;
        }
        if (bless) std::ofstream(file) << blessed;
    }
    EXPECT_GE(count, 300u);
}

} // namespace
} // namespace kaya::lang
