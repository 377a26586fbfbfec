#include "commands/review/deck_review.hpp"

#include "commands/review/deck_finding.hpp"
#include "commands/review/plot_views.hpp"
#include "commands/review/save_name.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/named_word.hpp"
#include "base/odd_letters.hpp"
#include "commands/review/text_doubts.hpp"
#include "lang/fish/doubts.hpp"
#include "lang/fish/inner_commands.hpp"
#include "lang/interp/script_files.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <any>
#include <fmt/format.h>
#include <optional>
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

/// A file that a command cannot read or write.
Diagnostic no_file(std::string message, std::string hint, const Place& command) {
    Diagnostic d(std::move(message), std::move(hint));
    d.code = "no-file";
    lang::place_problem(d, lang::language(), command);
    return d;
}

/// A file that a command writes; empty when it writes none.
std::string file_written_by(const lang::BoundCommand& command) {
    using namespace lang;
    FileRead written;
    reads(command, &Save::file, "save", written) || reads(command, &HistoryWrite::file, "CSV", written) ||
        reads(command, &VtkWrite::file, "ParaView", written) || reads(command, &Export::file, "geometry", written) ||
        reads(command, &Solve::file, "save", written) || reads(command, &LimitEquilibrium::file, "picture", written);
    const auto* plot = std::any_cast<Plot>(&command.command);
    if (plot != nullptr && std::ranges::none_of(plot->words, &Plot::Item::script))
        written.name = read_plot_line(plot->words, plot->range, PlotView()).file;
    if (const auto* movie = std::any_cast<lang::Movie>(&command.command);
        movie != nullptr && std::ranges::none_of(movie->words, &Plot::Item::script))
        for (std::size_t i = 0; i + 1 < movie->words.size(); ++i)
            if (movie->words[i].folded == "file") written.name = movie->words[i + 1].text;
    return written.name;
}

/// The place of the comment behind the words of a line; none when a blank is in front of it.
std::optional<std::size_t> close_comment(const lang::Lexer& lexer, int line) {
    const auto words = lexer.words_of_line(line);
    if (words.empty()) return std::nullopt;
    const Place& last = words.back().place;
    const auto end = static_cast<std::size_t>(last.column - 1 + last.length);
    const std::string& text = last.source->lines[static_cast<std::size_t>(line - 1)];
    return end < text.size() && text[end] == ';' ? std::optional(end) : std::nullopt;
}

bool holds_numbers_only(const std::string& text) {
    auto values = text;
    std::ranges::replace(values, ';', ' ');
    const auto words = lang::Lexer(lang::source_from_text("", values)).words_of_line(1);
    return !words.empty() &&
           std::ranges::all_of(words, [](const auto& word) { return word.kind == lang::WordKind::number; });
}

FileRead file_read_by(const lang::BoundCommand& command) {
    using namespace lang;
    FileRead read;
    reads(command, &TableCommand::file, "table", read) || reads(command, &LuaFile::file, "Lua", read) ||
        reads(command, &Restore::file, "save", read) || reads(command, &Import::file, "geometry", read) ||
        reads(command, &CutGround::file, "surface", read) || reads(command, &CutSurface::file, "surface", read) ||
        reads(command, &WaterCommand::file, "surface", read) || reads(command, &JointModelTest::path, "CSV", read);
    return read;
}

Diagnostic doubt(std::string message, std::string hint, const Place& place) {
    return finding(std::move(message), std::move(hint), "implausible", Severity::warning).at(place);
}

} // namespace

void DeckReview::file(const lang::BoundFile& file) {
    if (!seen_.insert(&file).second) return;
    if (on_file) on_file(file);
    if (file.steps.empty() && seen_.size() == 1)
        other_.push_back(doubt("this deck has no command", "is it the right file?", {file.source, 1, 1, 1}));
    for (const auto& step : file.steps) {
        statement(step.command, false);
        if (step.called) this->file(*step.called);
        else if (step.command.spec->flow == lang::Flow::call) anything_may_be_made();
    }
    doubt_last_line(*file.source);
}

void DeckReview::statement(const lang::BoundCommand& command, bool inside) {
    names_.check(command, inside);
    if (command.command.type() == typeid(lang::New)) defined_.clear();
    if (command.command.type() != typeid(lang::FishDefinition)) unused_.clear(); // it may have run
    materials_.check(command);
    properties_.check(command, inside);
    objects_.check(command, inside);
    needs_.check(command, inside);
    if (on_statement) on_statement(command);
    if (!inside) {
        find_file(command);
        find_folder(command);
        doubt_comment(command);
        doubt_letters(command);
        if (!command.late) doubt_text(command);
    }
    if (const auto* set = std::any_cast<lang::Set>(&command.command)) doubt_values(*set, command);
    if (inside && command.spec->flow == lang::Flow::call) anything_may_be_made();
    if (const auto* chunk = std::any_cast<lang::LuaChunk>(&command.command)) check_lua(chunk->text, chunk->place);
    if (const auto* function = std::any_cast<lang::FishDefinition>(&command.command)) this->inside(*function);
}

/// The function was compiled when the deck was bound; its command blocks are checked here.
void DeckReview::inside(const lang::FishDefinition& definition) {
    const auto function = fish::read_function(definition.text, definition.place);
    const auto doubts = fish::doubts(function);
    doubt_second_definition(definition, function.name);
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
    objects_.anything_may_be_made();
    needs_.anything_may_be_given();
}

void DeckReview::check_lua(std::string_view text, const Place& place) {
    check_script(text);
    lua_.check(text, place);
}

void DeckReview::check_script(std::string_view text) {
    materials_.check_script(text);
    properties_.check_script(text);
    objects_.check_script(text);
    needs_.check_script(text);
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

/// `poly brick 0,1;0,1;0,1` and `poly brick 0 1;cycle 10`: what is meant to be read is a comment.
void DeckReview::doubt_comment(const lang::BoundCommand& command) {
    if (command.spec->raw || !command.spec->body_end.empty()) return;
    const lang::Lexer lexer(command.place.source);
    for (int line = command.place.line; line <= command.last_line; ++line) {
        const auto at = close_comment(lexer, line);
        if (!at) continue;
        const std::string text = command.place.source->lines[static_cast<std::size_t>(line - 1)].substr(*at + 1);
        const Place place{command.place.source, line, static_cast<int>(*at) + 1, static_cast<int>(text.size()) + 1};
        if (holds_numbers_only(text))
            other_.push_back(
                doubt("these numbers are not read: ; begins a comment", "blanks and commas separate numbers", place));
        else if (reads_as_command(text))
            other_.push_back(
                doubt("this command is not read: ; begins a comment", "each command has its own line", place));
    }
}

/// `group block ‘cap’`: the quotes of a word processor become letters of the name.
void DeckReview::doubt_letters(const lang::BoundCommand& command) {
    if (command.spec->raw || !command.spec->body_end.empty()) return;
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement statement;
    if (!lexer.next(statement)) return;
    for (const auto& word : statement.words) {
        const std::string hint = word.kind == lang::WordKind::word ? odd_letter_hint(word.text) : std::string();
        if (!hint.empty()) other_.push_back(doubt(fmt::format("'{}' is taken as a name", word.text), hint, word.place));
    }
}

/// The run says it again when it reaches the line.
void DeckReview::doubt_text(const lang::BoundCommand& command) {
    for (auto& found : text_doubts(command.command)) {
        found.severity = Severity::warning;
        found.code = said_by_the_run;
        other_.push_back(found.at(command.place));
    }
}

bool DeckReview::reads_as_command(const std::string& text) const {
    lang::Lexer lexer(lang::source_from_text("", text));
    lang::Statement statement;
    if (!lexer.next(statement) || statement.words.size() < 2) return false;
    try {
        const auto command = lang::bind_with_names(lang::language(), statement, bare_);
        return !command.spec->raw && command.spec->body_end.empty();
    } catch (const Diagnostic&) { return false; }
}

void DeckReview::doubt_second_definition(const lang::FishDefinition& definition, const std::string& name) {
    const auto [first, is_new] = defined_.try_emplace(name, definition.place);
    if (is_new) unused_.insert(name);
    if (is_new || !unused_.contains(name)) return;
    other_.push_back(doubt(fmt::format("'{}' is defined a second time", name),
                           fmt::format("from here on this one counts; the first is in line {}", first->second.line),
                           definition.place));
    first->second = definition.place;
}

/// A folder that is not there when a file is written is not made: the run would end hours later.
void DeckReview::find_folder(const lang::BoundCommand& command) {
    const std::string file = command.late ? std::string() : file_written_by(command);
    const fs::path folder = fs::path(file).parent_path();
    std::error_code failed;
    // A name without a suffix gets one, beside a folder of that name.
    const bool is_save = command.command.type() == typeid(lang::Save);
    const fs::path given(file), written(is_save ? save_name(file) : file);
    const bool names_a_folder = written.filename().empty() || given.filename() == "." || given.filename() == "..";
    if (!file.empty() && (names_a_folder || (written.has_extension() && fs::is_directory(written, failed)))) {
        other_.push_back(no_file(fmt::format("'{}' is a folder", file), "give the name of a file", command.place));
        return;
    }
    if (folder.empty() || folder.is_absolute() || may_have_written_ || fs::exists(folder, failed)) return;
    other_.push_back(no_file(fmt::format("there is no folder '{}' for '{}'", folder.string(), file),
                             "make the folder first", command.place));
}

/// Functions of the deck are known, and those of FISH write where their names say so.
bool DeckReview::may_write_when_called(const std::string& expression) const {
    const std::string name = lang::fold(expression.substr(0, expression.find('(')));
    if (defined_.contains(name)) return false;
    const auto is_it = [&](const auto& known) { return known.first == name; };
    const bool built_in =
        std::ranges::any_of(scripts_.built_in_names(), is_it) || std::ranges::any_of(scripts_.newer_names(), is_it);
    return !built_in || lang::may_write_files(expression);
}

void DeckReview::find_file(const lang::BoundCommand& command) {
    if (lang::may_write_files(command)) may_have_written_ = true;
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
            if (word.late() && may_write && may_write_when_called(word.text)) may_have_written_ = true;
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
    other_.push_back(no_file(fmt::format("there is no {} file '{}'", read.kind, read.name),
                             "it is searched next to the deck and in the current folder", read.place));
}

void DeckReview::check_lua_file(const fs::path& path, const std::string& name, const Place& place) {
    std::error_code failed;
    const Descriptor file = door::peek(path);
    std::string text;
    if (!fs::is_regular_file(path, failed) || !file || !read_all(file.number(), text))
        return anything_may_be_made(); // the run says why
    names_.check_lua(text);
    check_lua(text, {lang::source_from_text(name, text), 1, 1, 1});
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
    const auto of_properties = properties_.findings(laws_, model_folders_);
    all.insert(all.end(), of_properties.begin(), of_properties.end());
    const auto of_lua = lua_.findings(scripts_.lua_names());
    all.insert(all.end(), of_lua.begin(), of_lua.end());
    const auto of_objects = objects_.findings();
    all.insert(all.end(), of_objects.begin(), of_objects.end());
    const auto needs = needs_.findings();
    all.insert(all.end(), needs.begin(), needs.end());
    return all;
}

} // namespace kaya
