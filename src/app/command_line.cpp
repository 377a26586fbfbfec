#include "app/command_line.hpp"

#include "commands/session/save_session.hpp"
#include "io/difference.hpp"
#include "lang/interp/source.hpp"
#include "system/door.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <sstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr const char* help_hint = "kaya --help lists commands and options";

std::vector<std::string> commands_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const auto* option : app.get_options())
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::string nearest(const std::string& word, const std::vector<std::string>& names) {
    return std::string(did_you_mean(word, {names.begin(), names.end()}));
}

/// The innermost command of the line, and its words: "kaya plugin".
const CLI::App& innermost(const CLI::App& app, std::string& words) {
    words += (words.empty() ? "" : " ") + app.get_name();
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : innermost(*chosen.front(), words);
}

Diagnostic unexpected(const CLI::App& command, const std::string& words, const std::string& word) {
    const bool option = word.starts_with("-");
    const std::string near =
        nearest(word.substr(0, word.find('=')), option ? options_of(command) : commands_of(command));
    const std::string what = option ? fmt::format("'{}' has no option '{}'", words, word)
                                    : fmt::format("'{}' does not take '{}'", words, word);
    return Diagnostic(what, near.empty() ? fmt::format("{} --help shows what it takes", words)
                                         : fmt::format("did you mean '{}'?", near));
}

Diagnostic missing_command(const CLI::App& command, const std::string& words) {
    const auto names = commands_of(command);
    const auto given = command.remaining();
    const std::string near = given.empty() ? "" : nearest(given.front(), names);
    const std::string what = given.empty() ? fmt::format("'{}' needs another word", words)
                                           : fmt::format("'{}' knows no '{}'", words, given.front());
    return Diagnostic(what, near.empty() ? fmt::format("one of: {}", fmt::join(names, ", "))
                                         : fmt::format("did you mean '{}'?", near));
}

} // namespace

Diagnostic mistake_of(const CLI::App& app, const CLI::ParseError& error) {
    std::string words;
    const CLI::App& command = innermost(app, words);
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error),
               missing = dynamic_cast<const CLI::RequiredError*>(&error);
    std::string text = error.what();
    if (const auto colon = text.find(": "); extra && colon != text.npos) {
        // The parser has forgotten the words, and its sentence lists them.
        std::istringstream listed(text.substr(colon + 2));
        const std::vector<std::string> extras{std::istream_iterator<std::string>(listed), {}};
        const auto option =
            std::find_if(extras.begin(), extras.end(), [](const std::string& word) { return word.starts_with("-"); });
        if (!extras.empty()) return unexpected(command, words, option == extras.end() ? extras.front() : *option);
    }
    if (missing && !commands_of(command).empty() && &command != &app) return missing_command(command, words);
    if (!text.empty() && text.back() == '.') text.pop_back();
    if (missing)
        return Diagnostic(fmt::format("'{}' needs more: {}", words, text),
                          fmt::format("{} --help shows what it takes", words));
    return Diagnostic(text, help_hint);
}

std::optional<Diagnostic> misspelt_command(const CLI::App& app, const std::string& deck) {
    try {
        lang::find_deck(deck, {"."});
        return std::nullopt;
    } catch (const Diagnostic&) { // no deck: perhaps a command
        const bool a_word =
            std::all_of(deck.begin(), deck.end(), [](unsigned char c) { return std::isalpha(c) || c == '-'; });
        const std::string near = a_word ? nearest(deck, commands_of(app)) : "";
        if (near.empty()) return std::nullopt;
        return Diagnostic(fmt::format("'{}' is neither a command of kaya nor a deck", deck),
                          fmt::format("did you mean 'kaya {}'?", near));
    }
}

std::string deck_file(const std::string& name) { return name == "-" ? "/dev/stdin" : name; }

void require_decks(const CLI::App& app, const std::vector<std::string>& decks) {
    if (decks.empty()) return;
    if (const auto misspelt = misspelt_command(app, decks.front())) throw *misspelt;
    for (const auto& deck : decks) lang::find_deck(deck, {"."});
}

void go_into(const std::string& folder, std::vector<std::string>& decks, std::string& journal) {
    std::error_code problem = door::make_folders(folder, Use::write);
    const fs::path from = fs::current_path(), whole = fs::weakly_canonical(folder);
    if (!problem) fs::current_path(whole, problem);
    if (problem)
        throw Diagnostic(fmt::format("the folder '{}' of --into cannot be used: {}", folder, problem.message()),
                         "name a folder that you may write into", Fault::run);
    const auto from_there = [&](std::string& file) {
        if (!file.empty() && !fs::path(file).is_absolute())
            file = fs::proximate(fs::weakly_canonical(from) / file, whole).string();
    };
    for (auto& deck : decks) from_there(deck);
    from_there(journal);
}

std::string find_saved(const std::string& name) {
    std::error_code ignored;
    if (fs::exists(name, ignored) || fs::path(name).has_extension()) return name;
    const std::string with_ending = name + std::string(save_ending);
    return fs::exists(with_ending, ignored) ? with_ending : name;
}

std::string difference_of(const std::vector<std::string>& files) {
    try {
        return save_file_difference(find_saved(files[0]), find_saved(files[1]));
    } catch (Diagnostic& problem) {
        problem.fault = Fault::run;
        throw;
    }
}

} // namespace kaya
