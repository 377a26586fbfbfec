#include "commands/deck_review.hpp"

#include "base/door.hpp"
#include "commands/save_session.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/named_word.hpp"
#include "lang/fish/doubts.hpp"
#include "lang/fish/inner_commands.hpp"
#include "lang/interp/script_files.hpp"

#include <algorithm>
#include <any>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// A file of data that a command reads, and what a message calls it.
struct FileRead {
    std::string name;
    const char* kind = "";
    Place place;
};

template <class Command>
bool reads(const lang::BoundCommand& command, std::string Command::*file, const char* kind, FileRead& read) {
    const auto* found = std::any_cast<Command>(&command.command);
    if (found != nullptr) read = {found->*file, kind, command.place};
    return found != nullptr;
}

FileRead file_read_by(const lang::BoundCommand& command) {
    using namespace lang;
    FileRead read;
    reads(command, &TableCommand::file, "table", read) || reads(command, &LuaFile::file, "Lua", read) ||
        reads(command, &Restore::file, "save", read) || reads(command, &Import::file, "geometry", read) ||
        reads(command, &CutGround::file, "surface", read) || reads(command, &WaterCommand::file, "surface", read) ||
        reads(command, &JointModelTest::path, "CSV", read);
    return read;
}

Diagnostic doubt(std::string message, std::string hint, const Place& place) {
    Diagnostic d(std::move(message), std::move(hint));
    d.severity = Severity::warning;
    d.code = "implausible";
    return d.at(place);
}

} // namespace

void DeckReview::file(const lang::BoundFile& file) {
    if (!seen_.insert(&file).second) return;
    if (on_file) on_file(file);
    for (const auto& step : file.steps) {
        statement(step.command, false);
        if (step.called) this->file(*step.called);
        else if (step.command.spec->flow == lang::Flow::call) anything_may_be_made();
    }
    doubt_last_line(*file.source);
}

void DeckReview::statement(const lang::BoundCommand& command, bool inside) {
    names_.check(command, inside);
    materials_.check(command);
    properties_.check(command, inside);
    if (on_statement) on_statement(command);
    if (!inside) find_file(command);
    if (const auto* set = std::any_cast<lang::Set>(&command.command)) doubt_values(*set, command);
    if (inside && command.spec->flow == lang::Flow::call) anything_may_be_made();
    if (const auto* chunk = std::any_cast<lang::LuaChunk>(&command.command)) check_script(chunk->text);
    if (const auto* function = std::any_cast<lang::FishDefinition>(&command.command)) this->inside(*function);
}

/// The function was compiled when the deck was bound; its command blocks are checked here.
void DeckReview::inside(const lang::FishDefinition& definition) {
    const auto function = fish::read_function(definition.text, definition.place);
    const auto doubts = fish::doubts(function);
    materials_.check_script(definition.text);
    other_.insert(other_.end(), doubts.begin(), doubts.end());
    for (const auto& inner : fish::inner_commands(function)) {
        if (inner.joined) {
            if (on_inner) on_inner(nullptr);
            continue;
        }
        lang::Lexer lexer(definition.place.source, inner.line);
        lang::Statement words;
        if (!lexer.next(words)) continue;
        try {
            statement(lang::bind_with_names(lang::language(), words, bare_), true);
        } catch (const Diagnostic& mistake) {
            anything_may_be_made();
            if (on_inner) on_inner(&mistake);
        }
    }
}

void DeckReview::anything_may_be_made() {
    names_.anything_may_be_made();
    materials_.anything_may_be_given();
    properties_.anything_may_be_loaded();
}

void DeckReview::check_script(std::string_view text) {
    materials_.check_script(text);
    properties_.check_script(text);
}

/// A continuation mark without a following line.
void DeckReview::doubt_last_line(const SourceText& source) {
    const auto text = std::make_shared<SourceText>(source);
    const lang::Lexer lexer(text);
    for (auto line = static_cast<int>(source.lines.size()); line > 0; --line) {
        const std::string& words = source.lines[static_cast<std::size_t>(line - 1)];
        const auto start = words.find_first_not_of(" \t\r");
        if (start == std::string::npos || words[start] == ';') continue; // a comment does not end a statement
        if (!lexer.continued(line)) return;
        const auto column = static_cast<int>(words.find_last_not_of(" \t\r")) + 1;
        other_.push_back(doubt("the last line ends with a mark that continues it, and nothing follows",
                               "is a line lost?", {text, line, column, 1}));
        return;
    }
}

/// `set @w = 1+2`, `set @w = stone`: a word without quotes.
void DeckReview::doubt_values(const lang::Set& set, const lang::BoundCommand& command) {
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement statement;
    if (set.fish.empty() || !lexer.next(statement)) return;
    for (std::size_t i = 1; i < statement.words.size(); ++i) {
        const auto& word = statement.words[i];
        if (word.kind != lang::WordKind::word || statement.words[i - 1].kind != lang::WordKind::symbol) continue;
        const bool begins =
            !word.text.empty() && std::string_view("0123456789.+-").find(word.text.front()) != std::string_view::npos;
        const bool arithmetic = begins && word.text.find_first_of("+-*/^", 1) != std::string::npos;
        other_.push_back(doubt(
            fmt::format("'{}' is taken as a text", word.text),
            arithmetic ? fmt::format("brackets make it an expression: [{}]; quotes say that it is a text", word.text)
                       : fmt::format("@{} is the value of that name; quotes say that it is a text", word.text),
            word.place));
    }
}

void DeckReview::find_file(const lang::BoundCommand& command) {
    if (lang::may_write_files(command)) may_have_written_ = true;
    if (const auto* function = std::any_cast<lang::FishDefinition>(&command.command))
        defined_.insert(fish::read_function(function->text, function->place).name);
    const FileRead read = command.late ? FileRead{} : file_read_by(command);
    const bool is_save = command.command.type() == typeid(lang::Restore);
    const std::string in_full = is_save ? save_name(read.name) : read.name;
    const bool may_be_written = may_have_written_ || std::ranges::any_of(earlier_words_, [&](const std::string& word) {
                                    return word == read.name || (is_save && save_name(word) == in_full);
                                });
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement words;
    if (command.spec->body_end.empty() && lexer.next(words)) {
        const bool may_write =
            words.words.front().late() ||
            lang::may_write_files(command.text()); // hist write @name; @f may be one of an earlier deck
        for (const auto& word : words.words) {
            earlier_words_.insert(word.text);
            if (word.late() && may_write && !defined_.contains(lang::fold(word.text.substr(0, word.text.find('(')))))
                may_have_written_ = true;
        }
    }
    if (read.name.empty()) return;
    for (const auto& folder : folders_) {
        std::error_code failed;
        const fs::path path = folder / read.name;
        if (!fs::exists(path, failed) && !fs::exists(folder / in_full, failed)) continue;
        if (command.command.type() == typeid(lang::LuaFile)) check_lua_file(path, read.name, read.place);
        return;
    }
    if (command.command.type() == typeid(lang::LuaFile)) {
        anything_may_be_made();
        may_have_written_ = true;
    }
    if (may_be_written) return;
    Diagnostic d(fmt::format("there is no {} file '{}'", read.kind, read.name),
                 "it is searched next to the deck and in the current folder");
    d.code = "no-file";
    lang::place_problem(d, lang::language(), read.place);
    other_.push_back(std::move(d));
}

void DeckReview::check_lua_file(const fs::path& path, const std::string& name, const Place& place) {
    std::error_code failed;
    const Descriptor file = door::peek(path);
    std::string text;
    if (!fs::is_regular_file(path, failed) || !file || !read_all(file.number(), text))
        return anything_may_be_made(); // the run says why
    names_.check_lua(text);
    check_script(text);
    if (lang::may_write_files(text)) may_have_written_ = true;
    try {
        script::check_lua_text(text, {lang::source_from_text(name, text), 1, 1, 1});
    } catch (Diagnostic& mistake) {
        mistake.at(place);
        other_.push_back(mistake);
    }
}

std::vector<Diagnostic> DeckReview::findings() {
    std::vector<Diagnostic> all = other_;
    const auto of_names = names_.findings();
    all.insert(all.end(), of_names.begin(), of_names.end());
    const auto of_materials = materials_.findings();
    all.insert(all.end(), of_materials.begin(), of_materials.end());
    const auto of_properties = properties_.findings(laws_);
    all.insert(all.end(), of_properties.begin(), of_properties.end());
    return all;
}

} // namespace kaya
