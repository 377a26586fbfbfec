#include "commands/review/deck_words.hpp"

#include "base/lower_case.hpp"
#include "lang/interp/source.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_files = 1000;

/// The file that a run would read; none when there is none.
std::optional<fs::path> file_of_deck(const std::string& name, const std::vector<fs::path>& folders) {
    try {
        if (auto file = lang::find_deck(name, folders); fs::is_regular_file(file)) return file;
    } catch (const Diagnostic&) {} // the run says it
    return std::nullopt;
}

bool shortens(std::string_view word, std::string_view whole, std::size_t least) {
    return word.size() >= least && whole.starts_with(word);
}

} // namespace

bool DeckWords::take(const fs::path& file) {
    if (files_.size() > most_files || !files_.insert(file.lexically_normal()).second) return true;
    std::string text;
    try {
        text = read_whole_file(file.string());
    } catch (const Diagnostic&) { return false; }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!take_line(line, file.parent_path())) return false;
    return true;
}

bool DeckWords::take_line(const std::string& line, const fs::path& folder) {
    std::istringstream rest(line);
    std::string command, name;
    rest >> command >> name;
    const auto in_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    for (auto at = line.begin(); at != line.end();) {
        const auto begin = std::find_if(at, line.end(), in_word);
        at = std::find_if_not(begin, line.end(), in_word);
        if (begin != at) words_.insert(lower_case(std::string(begin, at)));
    }
    command = lower_case(command);
    if (shortens(command, "program", 4) && shortens(lower_case(name), "call", 3)) {
        command = "call";
        name.clear();
        rest >> name;
    }
    if (shortens(command, "parameter", 5)) {
        std::erase_if(name, [](char c) { return c == '@' || c == '\''; });
        declared_.insert(lower_case(name.substr(0, name.find('='))));
    }
    const bool reads = shortens(command, "call", 3) || command == "lua";
    if (!reads || name.empty()) return true;
    std::erase_if(name, [](char c) { return c == '\'' || c == '"'; });
    const auto file = file_of_deck(name, {folder, "."});
    return file && take(*file);
}

void DeckWords::require(const std::string& name, const Place& place) const {
    const bool is_property = name.find(' ') != std::string::npos;
    if (is_property || words_.contains(lower_case(name))) return;
    const auto near = did_you_mean(lower_case(name), std::vector<std::string_view>(words_.begin(), words_.end()));
    throw Diagnostic(fmt::format("the deck does not mention '{}'", name),
                     near.empty() ? fmt::format("write param {} = 30 in the deck, and use @{}", name, name)
                                  : fmt::format("did you mean '{}'?", near))
        .at(place);
}

std::optional<DeckWords> words_of_decks(const std::vector<std::string>& decks) {
    DeckWords words;
    for (const auto& deck : decks) {
        const auto file = file_of_deck(deck, {"."});
        if (!file || !words.take(*file)) return std::nullopt;
    }
    return words;
}

} // namespace kaya
