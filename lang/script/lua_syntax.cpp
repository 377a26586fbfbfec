// Reads Lua without running it, in a separate state.
#include "lang/script/lua_headers.hpp"
#include "lang/script/scripts.hpp"
#include "lang/script/source_list.hpp"

#include <algorithm>
#include <memory>
#include <new>

namespace kaya::script {

namespace {

struct Habit {
    std::string_view sign, hint;
};

/// Signs of other languages.
constexpr Habit habits[] = {
    {"!=", "Lua writes ~= for unequal"},
    {"&&", "Lua writes and, or, not"},
    {"||", "Lua writes and, or, not"},
    {"!", "Lua writes and, or, not"},
    {"+=", "Lua writes a = a + b"},
    {"-=", "Lua writes a = a - b"},
    {"*=", "Lua writes a = a * b"},
    {"++", "Lua writes a = a + 1"},
    {"//", "a comment in Lua begins with --"},
    {"else if", "Lua writes elseif in one word"},
};

std::string habit_of(std::string_view text, int line) {
    for (; line > 1 && !text.empty(); --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    const std::string_view at = text.substr(0, text.find('\n'));
    for (const auto& habit : habits)
        if (at.find(habit.sign) != at.npos) return std::string(habit.hint);
    return {};
}

} // namespace

void check_lua_text(const std::string& text, const Place& place) {
    const std::unique_ptr<lua_State, decltype(&lua_close)> state(luaL_newstate(), lua_close);
    if (!state) throw std::bad_alloc();
    lua_State* L = state.get();
    SourceList sources;
    const std::string name = sources.add({"", place, false});
    if (luaL_loadbufferx(L, text.data(), text.size(), name.c_str(), "t") == LUA_OK) return;
    const std::string message = lua_tostring(L, -1);
    std::string_view chunk, words = message;
    int line = 0;
    const bool found = split_message(message, chunk, line, words);
    Diagnostic mistake("Lua cannot read this: " + std::string(words), habit_of(text, line));
    mistake.code = "lua-syntax";
    if (found) mistake.at(line_place(*sources.find(name), line));
    throw mistake.at(place);
}

} // namespace kaya::script
