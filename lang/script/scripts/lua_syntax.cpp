// Reads Lua without running it, in a separate state.
#include "base/odd_letters.hpp"
#include "lang/script/base/lua_headers.hpp"
#include "lang/script/base/source_list.hpp"
#include "lang/script/scripts/scripts.hpp"

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
    {"elif", "Lua writes elseif"},
    {"endif", "Lua closes if, for, while and function with end"},
    {"endloop", "Lua closes if, for, while and function with end"},
    {"switch", "Lua has if ... elseif ... end"},
};

/// What Lua's own message asks for.
constexpr Habit messages[] = {
    {"unfinished string", "close the quote on its line; [[ ... ]] may span lines"},
    {"'then' expected near '='", "Lua compares with =="},
    {"'do' expected", "a loop is: for i = 1, 3 do ... end, while a < b do ... end"},
    {"'then' expected", "a test is: if a == b then ... end"},
    {"'end' expected", "Lua closes if, for, while and function with end"},
    {"'<eof>' expected", "there is one `end` more than if, for, while and function"},
    {"'=' expected", "a line is an assignment, a = b, or a call, f(x)"},
    {"syntax error", "a line is an assignment, a = b, or a call, f(x)"},
    {"')' expected", "close the parenthesis"},
    {"'}' expected", "close the brace; commas separate the values in it"},
    {"malformed number", "write 1e6 or 0.5: numbers have no units"},
    {"no visible label", "a label is written ::name::"},
    {"<eof> expected", "there is no if, for, while or function open here"},
    {"unexpected symbol", "a value or a name belongs there"},
};

std::string_view hint_for_message(std::string_view message) {
    for (const auto& [sign, hint] : messages)
        if (message.find(sign) != message.npos) return hint;
    return {};
}

std::string habit_of(std::string_view text, int line, std::string_view message) {
    for (; line > 1 && !text.empty(); --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    const std::string_view at = text.substr(0, text.find('\n'));
    if (message.find("near '<\\") != message.npos) { // a byte beyond ASCII
        const std::string odd = odd_letter_hint(at);
        return odd.empty() ? "names in Lua have letters from a to z, digits and _" : odd;
    }
    if (const auto sign = at.find('#'); sign != at.npos && sign == at.find_first_not_of(" \t"))
        return "a comment in Lua begins with --";
    for (const auto& habit : habits)
        if (at.find(habit.sign) != at.npos) return std::string(habit.hint);
    return std::string(hint_for_message(message));
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
    Diagnostic mistake("Lua cannot read this: " + std::string(words), habit_of(text, line, words));
    mistake.code = "lua-syntax";
    if (found) mistake.at(line_place(*sources.find(name), line));
    throw mistake.at(place);
}

} // namespace kaya::script
