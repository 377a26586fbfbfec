#include "commands/review/deck_names.hpp"

#include "lang/commands/commands.hpp"
#include "lang/fish/nearest.hpp"
#include "lang/fish/reserved.hpp"

#include <algorithm>
#include <any>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <span>

namespace kaya {

namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

/// Each word of a text, folded.
template <class Visit> void for_each_word(std::string_view text, Visit visit) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t from = i;
        while (i < text.size() && is_letter(text[i])) ++i;
        if (i > from) visit(lang::fold(text.substr(from, i - from)));
        else ++i;
    }
}

/// "functions that begin with math: math.abs, ..." for a name with points; empty when there are none.
std::string functions_of_kind(std::string_view name, std::vector<std::string_view> known) {
    const std::string_view kind = name.substr(0, name.rfind('.') + 1);
    std::erase_if(known, [&](std::string_view other) { return !other.starts_with(kind); });
    std::ranges::sort(known);
    constexpr std::size_t most = 12;
    const auto shown = std::span(known).first(std::min(known.size(), most));
    return known.empty() ? "docs/fish.md lists the functions"
                         : fmt::format("it may be: {}{}; docs/fish.md lists all", fmt::join(shown, ", "),
                                       known.size() > most ? ", ..." : "");
}

std::string proposal(std::string_view near) { return near.empty() ? "" : fmt::format("did you mean '{}'?", near); }

Diagnostic warning(std::string message, std::string hint, const char* code, const Place& place) {
    Diagnostic d(std::move(message), std::move(hint));
    d.severity = Severity::warning;
    d.code = code;
    return d.at(place);
}

} // namespace

void DeckNames::check(const lang::BoundCommand& command, bool inside) {
    if (const auto* definition = std::any_cast<lang::FishDefinition>(&command.command))
        return learn_function(definition->text, definition->place);
    if (const auto* chunk = std::any_cast<lang::LuaChunk>(&command.command)) return check_lua(chunk->text);
    if (command.command.type() == typeid(lang::Restore)) open_ = true;
    std::vector<std::string> given;
    if (const auto* set = std::any_cast<lang::Set>(&command.command))
        for (const auto& [name, value] : set->fish) {
            given.push_back(lang::fold(name));
            add({given.back(), fish::Use::set, 0, command.place, {}}, true);
        }
    if (const auto* parameter = std::any_cast<lang::Parameter>(&command.command)) {
        given.push_back(lang::fold(parameter->name));
        add({given.back(), fish::Use::set, 0, command.place, {}}, true);
    }
    if (!command.spec->raw)
        for_each_word(command.text(), [&](const std::string& word) {
            const auto as_target = std::ranges::find(given, word);
            if (as_target == given.end()) read_.insert(word);
            else given.erase(as_target);
        });
    if (const auto* history = std::any_cast<lang::HistoryAdd>(&command.command); history != nullptr && !inside)
        for (const auto& item : history->items)
            if (const auto* script = std::get_if<lang::HistoryItem::Script>(&item.what))
                add({lang::fold(script->symbol), fish::Use::read, 0, item.text, {}}, true);
    const bool call = std::any_cast<lang::FishCall>(&command.command) != nullptr;
    if (!inside && (call || !command.spec->raw)) use_words(command);
}

void DeckNames::check_lua(std::string_view text) {
    // fish[name] may be anything.
    if (text.find("fish[") != text.npos || text.find("fish [") != text.npos) open_ = true;
    for_each_word(text, [&](const std::string& word) {
        mentioned_.insert(word);
        made_.insert(word);
        read_.insert(word);
    });
}

void DeckNames::learn_function(const std::string& text, const Place& place) {
    const auto function = fish::read_function(text, place);
    first_places_.try_emplace(function.name, place);
    const int most = static_cast<int>(function.arguments.size());
    const auto [known, is_new] =
        functions_.try_emplace(function.name, fish::Meaning{fish::NameKind::function, function.least, most, false});
    if (!is_new) { // defined twice: a call may be meant for either
        known->second.least = std::min(known->second.least, function.least);
        known->second.most = std::max(known->second.most, most);
    }
    for (auto& use : fish::name_uses(function)) add(std::move(use), false);
}

void DeckNames::learn_expression(const lang::Word& word) {
    try {
        const bool bracket = word.kind == lang::WordKind::expression;
        const auto dialect = bracket ? fish::Dialect::modern : fish::Dialect::classic;
        for (auto& use : fish::name_uses(fish::read_expression(word.text, word.place, dialect))) {
            use.place = word.place;
            add(std::move(use), true);
        }
    } catch (Diagnostic& mistake) {
        if (word.kind == lang::WordKind::expression) broken_.push_back(mistake.at(word.place));
    }
}

void DeckNames::add(fish::NameUse use, bool of_command) {
    using enum fish::Use;
    if (use.use == set) first_places_.try_emplace(use.name, use.place);
    else if (of_command && !is_made(use.name) && !mentioned_.contains(use.name)) early_.push_back(use);
    if ((!of_command && use.use != command) || use.use == set) mentioned_.insert(use.name);
    if (use.use == set || use.use == declare) {
        const bool is_new = made_.insert(use.name).second;
        if (is_new && use.use == set) set_.push_back(std::move(use));
        return;
    }
    read_.insert(use.name);
    used_.push_back({std::move(use), of_command});
}

void DeckNames::use_words(const lang::BoundCommand& command) {
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement statement;
    if (!lexer.next(statement)) return;
    for (const auto& bare : command.bare) lang::read_as_name(statement, bare);
    const auto* set = std::any_cast<lang::Set>(&command.command);
    const auto* parameter = std::any_cast<lang::Parameter>(&command.command);
    for (const auto& word : statement.words) {
        if (parameter != nullptr && lang::fold(parameter->name) == lang::fold(word.text)) continue;
        const bool target = set != nullptr && std::ranges::any_of(set->fish, [&](const auto& given) {
                                return lang::fold(given.first) == lang::fold(word.text);
                            });
        if (word.late() && !word.text.empty() && !target) learn_expression(word);
    }
}

bool DeckNames::is_made(const std::string& name) const {
    return made_.contains(name) || functions_.contains(name) || scripts_.knows(name);
}

fish::Meaning DeckNames::meaning_of(const std::string& name) const {
    const auto own = functions_.find(name);
    return own == functions_.end() ? scripts_.meaning_of(name) : own->second;
}

std::vector<std::string_view> DeckNames::candidates() const {
    std::vector<std::string_view> names(made_.begin(), made_.end());
    for (const auto& [name, meaning] : functions_) names.push_back(name);
    return names;
}

std::vector<Diagnostic> DeckNames::findings() const {
    std::vector<Diagnostic> found = broken_;
    if (open_) return found;
    find_unknown(found);
    find_early(found);
    find_unread(found);
    return found;
}

void DeckNames::find_unknown(std::vector<Diagnostic>& found) const {
    using enum fish::Use;
    std::vector<std::string> built_in;
    for (const auto& [name, writable] : scripts_.built_in_names()) built_in.push_back(name);
    for (const auto& name : scripts_.symbols()) built_in.push_back(name);
    std::vector<std::string_view> names = candidates();
    names.insert(names.end(), built_in.begin(), built_in.end());

    std::set<std::string> said;
    Place last_error;
    for (const auto& [use, of_command] : used_) {
        if (fish::is_constant(use.name)) continue;
        const fish::Meaning meaning = meaning_of(use.name);
        if (meaning.kind != fish::NameKind::variable) {
            if (use.use != read && use.use != call && use.use != line) continue;
            try {
                fish::check_arguments(use.name, use.arguments, meaning, use.place);
            } catch (Diagnostic& mistake) {
                mistake.hint = functions_.contains(use.name) ? "its arguments stand in its first line"
                                                             : fmt::format("'kaya help {}' names them", use.name);
                found.push_back(mistake);
            }
            continue;
        }
        if (is_made(use.name) || fish::find_reserved(use.name)) continue;
        const auto near = fish::nearest_name(use.name, names);
        const std::string hint = proposal(near);
        const bool by_command = of_command || use.use == command;
        if (by_command && !mentioned_.contains(use.name)) {
            if (last_error.source == use.place.source && last_error.line == use.place.line) continue;
            last_error = use.place;
            Diagnostic d(
                fmt::format("there is no FISH variable or function '{}'", use.name),
                near.empty()
                    ? fmt::format("give it a value before, set @{0} = 1, or define it: def {0} ... end", use.name)
                    : fmt::format("did you mean '@{}'?", near));
            d.code = "unknown-fish-name";
            found.push_back(d.at(use.place));
            continue;
        }
        if (!said.insert(use.name).second) continue;
        if (use.dialect == fish::Dialect::modern && use.name.find('.') != use.name.npos) {
            const auto* family = fish::find_reserved_family(use.name);
            Diagnostic d = family != nullptr ? fish::reserved_message(use.name, *family)
                                             : Diagnostic(fmt::format("there is no FISH function '{}'", use.name),
                                                          hint.empty() ? functions_of_kind(use.name, names) : hint);
            if (family == nullptr) d.code = "unknown-fish-name";
            found.push_back(d.at(use.place));
            continue;
        }
        const auto* reserved = fish::find_reserved_family(use.name);
        if (reserved && use.use != read) {
            const Diagnostic d = fish::reserved_message(use.name, *reserved);
            found.push_back(warning(d.message, d.hint, "unsupported-fish-name", use.place));
        } else if (use.use == call || use.use == element) {
            found.push_back(warning(fmt::format("'{}' is neither a function nor an array", use.name), hint,
                                    "unknown-fish-name", use.place));
        } else if (use.use == line) {
            found.push_back(warning(fmt::format("'{}' is not a function: this line does nothing", use.name), hint,
                                    "never-set", use.place));
        } else {
            found.push_back(warning(fmt::format("nothing in this deck sets '{}': it is 0", use.name), hint, "never-set",
                                    use.place));
        }
    }
}

/// `print @height` above the line that gives it its value.
void DeckNames::find_early(std::vector<Diagnostic>& found) const {
    for (const auto& use : early_) {
        const auto later = first_places_.find(use.name);
        if (later == first_places_.end() || fish::is_constant(use.name)) continue;
        if (later->second.source != use.place.source || later->second.line <= use.place.line) continue;
        Diagnostic d(fmt::format("there is no FISH variable or function '{}' here", use.name),
                     fmt::format("line {} makes it: it must come first", later->second.line));
        d.code = "unknown-fish-name";
        found.push_back(d.at(use.place));
    }
}

/// Only likely misspellings: many decks assign an unwanted result to a variable.
void DeckNames::find_unread(std::vector<Diagnostic>& found) const {
    constexpr std::size_t shortest = 6; // shorter names are too near to each other
    for (const auto& use : set_) {
        if (read_.contains(use.name) || use.name.size() < shortest || scripts_.knows(use.name)) continue;
        const auto meant = std::ranges::find_if(read_, [&](const std::string& name) {
            return fish::is_one_slip(use.name, name) && (made_.contains(name) || mentioned_.contains(name));
        });
        if (meant == read_.end()) continue;
        found.push_back(warning(fmt::format("nothing in this deck reads '{}', which is set here", use.name),
                                proposal(*meant), "never-read", use.place));
    }
}

} // namespace kaya
