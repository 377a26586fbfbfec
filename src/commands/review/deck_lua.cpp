#include "commands/review/deck_lua.hpp"

#include "commands/review/deck_finding.hpp"
#include "lang/interp/command_words.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr std::array<std::string_view, 22> keywords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

bool is_command(const std::string& name) { return !lang::commands_called(lang::language(), name).empty(); }

bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_name(char c) { return starts_name(c) || (c >= '0' && c <= '9'); }

/// The length of the opening of a long bracket, [[ or [==[, at that place; 0 when there is none.
std::size_t long_opening(std::string_view text, std::size_t at) {
    std::size_t end = at + 1;
    while (end < text.size() && text[end] == '=') ++end;
    return text[at] == '[' && end < text.size() && text[end] == '[' ? end + 1 - at : 0;
}

/// The end of a comment, a text or a long bracket that begins there; `at` when none does.
std::size_t past_text(std::string_view text, std::size_t at) {
    const bool comment = text.substr(at, 2) == "--";
    const std::size_t from = comment ? at + 2 : at;
    if (from < text.size()) {
        if (const std::size_t opening = long_opening(text, from); opening > 0) {
            const std::string closing = "]" + std::string(opening - 2, '=') + "]";
            const auto end = text.find(closing, from + opening);
            return end == text.npos ? text.size() : end + closing.size();
        }
    }
    if (comment) return std::min(text.find('\n', at), text.size());
    if (text[at] != '"' && text[at] != '\'') return at;
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != text[at] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
}

bool calls(std::string_view text, std::size_t at) {
    const auto next = text.find_first_not_of(" \t", at);
    return next != text.npos && std::string_view("('\"").find(text[next]) != std::string_view::npos;
}

Place place_in(std::string_view text, std::size_t at, std::size_t length, const Place& first) {
    Place place = first;
    place.line += static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
    const auto begin = text.rfind('\n', at);
    place.column = static_cast<int>(begin == text.npos ? at + 1 : at - begin);
    place.length = static_cast<int>(length);
    return place;
}

} // namespace

void DeckLua::check(std::string_view text, const Place& place) {
    std::string_view before; // the word or sign in front
    for (std::size_t i = 0; i < text.size();) {
        if (const auto end = past_text(text, i); end > i) {
            i = end;
            before = "text";
            continue;
        }
        const std::size_t from = i;
        if (!starts_name(text[i])) {
            ++i;
            const bool second = text[from] == '.' && before == "."; // a .. b joins texts
            if (text[from] > ' ') before = second ? std::string_view("..") : text.substr(from, 1);
            while (i < text.size() && text[from] >= '0' && text[from] <= '9' && continues_name(text[i]))
                ++i; // 1e6, 0xff
            continue;
        }
        while (i < text.size() && continues_name(text[i])) ++i;
        const std::string name(text.substr(from, i - from));
        const bool member = before == "." || before == ":";
        if (name == "require" || name == "load" || name == "dofile" || name == "_G" || name == "_ENV") open_ = true;
        if (!member && std::ranges::find(keywords, name) == keywords.end()) {
            if (before != "function" && calls(text, i))
                called_.try_emplace(name, place_in(text, from, i - from, place));
            else mentioned_.insert(name);
        }
        before = text.substr(from, i - from);
    }
}

std::vector<Diagnostic> DeckLua::findings(const std::vector<std::string>& names) const {
    std::vector<Diagnostic> found;
    if (open_) return found;
    std::vector<std::string_view> known(names.begin(), names.end());
    known.insert(known.end(), mentioned_.begin(), mentioned_.end());
    for (const auto& [name, place] : called_) {
        if (mentioned_.contains(name) || std::ranges::find(names, name) != names.end()) continue;
        const auto near = did_you_mean(name, known);
        found.push_back(finding(fmt::format("Lua has no function '{}'", name),
                                !near.empty() ? fmt::format("did you mean '{}'?", near)
                                : is_command(name)
                                    ? fmt::format("a command is given as a text: command('{} ...')", name)
                                    : "define it before: function name(...) ... end",
                                "unknown-word", Severity::warning)
                            .at(place));
    }
    return found;
}

} // namespace kaya
