#include "lang/script/state/lua_messages.hpp"

#include "lang/script/state/lua_state.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace kaya::script {

namespace {

/// Names of Lua that decks do not have.
constexpr std::array<std::string_view, 6> left_out{"coroutine",  "dofile",  "loadfile",
                                                   "loadstring", "setfenv", "getfenv"};

constexpr const char* how_to_walk = "objects are walked in order: for b in blocks() do ... end";

/// Adds the names in the table on top of the stack and, if `inner`, those of the tables in it.
void add_names(lua_State* L, std::vector<std::string>& names, bool inner) {
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
        const bool named = lua_type(L, -2) == LUA_TSTRING;
        if (named && !inner) names.emplace_back(lua_tostring(L, -2));
        if (named && inner && lua_istable(L, -1) && std::string_view(lua_tostring(L, -2)) != "_G")
            add_names(L, names, false);
        lua_pop(L, 1);
    }
}

/// Sorted: the order of a table of Lua is not always the same.
std::vector<std::string> names_in_reach(lua_State* L, bool inner) {
    const int level = lua_gettop(L);
    luaL_checkstack(L, 16, "for a message");
    std::vector<std::string> names;
    push_anchor(L, state_of(L).environment);
    if (lua_istable(L, -1)) add_names(L, names, inner);
    // Read-only names are behind the names of the deck.
    if (lua_getmetatable(L, -1) != 0) {
        lua_pushstring(L, "__index");
        if (lua_rawget(L, -2) == LUA_TTABLE) add_names(L, names, inner);
    }
    lua_settop(L, level);
    std::ranges::sort(names);
    return names;
}

/// The nearest global name, or the nearest name in one of the global tables (string.format).
std::string near_name(lua_State* L, std::string_view word, bool inner) {
    const auto names = names_in_reach(L, inner);
    return std::string(did_you_mean(word, {names.begin(), names.end()}));
}

/// "attempt to call a nil value (global 'prnt')"
struct Attempt {
    std::string_view action, value; ///< "call", "nil"
    std::string_view kind, name;    ///< "global", "prnt"; empty where Lua knows no name
};

std::optional<Attempt> attempt_of(std::string_view text) {
    constexpr std::string_view begins = "attempt to ";
    if (!text.starts_with(begins)) return {};
    text.remove_prefix(begins.size());
    const auto article = text.find(" a ");
    if (article == text.npos) return {};
    Attempt attempt;
    attempt.action = text.substr(0, article);
    text.remove_prefix(article + 3);
    const auto value = text.find(" value");
    if (value == text.npos) return {};
    attempt.value = text.substr(0, value);
    const auto begin = text.find('('), first = text.find('\''), last = text.rfind('\'');
    if (begin == text.npos || first == text.npos || last <= first) return attempt;
    attempt.kind = text.substr(begin + 1, first - begin - 2);
    attempt.name = text.substr(first + 1, last - first - 1);
    if (attempt.name == "?" || attempt.name == "integer index") attempt.name = {};
    return attempt;
}

Diagnostic said(std::string message, std::string hint = {}) {
    return Diagnostic(std::move(message), std::move(hint), Fault::run);
}

/// The call of a command as if it were a function.
std::string hint_of_call(const Attempt& attempt) {
    constexpr std::array<std::string_view, 14> commands{"cycle", "step", "solve", "poly", "prop", "jmodel", "fix",
                                                        "save",  "hist", "plot",  "list", "gen",  "model",  "bound"};
    if (std::ranges::find(commands, attempt.name) == commands.end())
        return "define it before: function name(...) ... end";
    return fmt::format("a command is given as a text: command('{} ...')", attempt.name);
}

Diagnostic of_nil(lua_State* L, const Attempt& attempt) {
    const bool global = attempt.kind == "global", calls = attempt.action == "call";
    if (global && std::ranges::find(left_out, attempt.name) != left_out.end())
        return said(fmt::format("'{}' of Lua is not available in decks", attempt.name));
    std::string near;
    if (global || (calls && attempt.kind == "field")) near = near_name(L, attempt.name, !global);
    const std::string hint = near.empty() ? std::string() : fmt::format("did you mean '{}'?", near);
    const std::string name = attempt.name.empty() ? "this value" : fmt::format("'{}'", attempt.name);
    if (calls)
        return said(fmt::format("there is no function {} here", name), hint.empty() ? hint_of_call(attempt) : hint);
    if (attempt.action == "index")
        return said(fmt::format("{} is nil here: it has no fields", name),
                    attempt.name.empty() || hint.empty() ? "the call or look-up that gave it found nothing" : hint);
    return said(fmt::format("{} is nil here: nothing has set it", name),
                hint.empty() ? "set it before, or test it: if value ~= nil then ... end" : hint);
}

std::optional<Diagnostic> of_attempt(lua_State* L, const Attempt& attempt) {
    if (attempt.value == "nil") return of_nil(L, attempt);
    if (attempt.value == "function" && attempt.action == "index")
        return said("a function has no fields or elements", how_to_walk);
    if (attempt.value == "function" && attempt.action == "get length of")
        return said("a function has no length", fmt::format("{}; count(\"block\") is their number", how_to_walk));
    if (attempt.action == "concatenate")
        return said(fmt::format("{} cannot be joined to a text",
                                attempt.value == "userdata" ? "an object" : "a " + std::string(attempt.value)),
                    "write tostring(value), or a field of it: value.id");
    if (attempt.action == "call" && (attempt.kind == "method" || attempt.kind == "field") && !attempt.name.empty())
        return said(fmt::format("'{}' is a {} and not a function", attempt.name, attempt.value),
                    fmt::format("write it without parentheses: .{}", attempt.name));
    return {};
}

} // namespace

std::vector<std::string> global_names(lua_State* L) { return names_in_reach(L, false); }

Diagnostic in_plain_words(lua_State* L, std::string_view text) {
    if (const auto attempt = attempt_of(text))
        if (auto plain = of_attempt(L, *attempt)) return *plain;
    if (text.find("stack overflow") != text.npos)
        return said("functions call each other too deeply", "a function that calls itself needs a way to end");
    if (text.starts_with("attempt to ") && text.find(" a 'string' with a ") != text.npos)
        return said(fmt::format("a text and a number: {}", text),
                    "tonumber(text) makes a number of a text, .. joins texts");
    if (text == "not enough memory") return said("the script needs more memory than there is");
    return said(std::string(text));
}

} // namespace kaya::script
