// Reads Lua without running it, in a separate state.
#include "lang/script/lua_headers.hpp"
#include "lang/script/scripts.hpp"
#include "lang/script/source_list.hpp"

#include <memory>
#include <new>

namespace kaya::script {

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
    Diagnostic mistake("Lua cannot read this: " + std::string(words));
    mistake.code = "lua-syntax";
    if (found) mistake.at(line_place(*sources.find(name), line));
    throw mistake.at(place);
}

} // namespace kaya::script
