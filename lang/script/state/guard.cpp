#include "lang/script/state/guard.hpp"

#include "lang/script/base/source_list.hpp"
#include "lang/script/state/lua_messages.hpp"
#include "lang/script/state/lua_state.hpp"

#include <cstring>
#include <fmt/format.h>
#include <memory>

namespace kaya::script {

namespace {

/// Each level costs C++ stack in the command interpreter as well.
constexpr int deepest_call = 50;
constexpr int most_stack_lines = 12;

int release(lua_State* L) {
    std::destroy_at(static_cast<Diagnostic*>(lua_touserdata(L, 1)));
    return 0;
}

int show(lua_State* L) {
    const auto* diagnostic = static_cast<const Diagnostic*>(lua_touserdata(L, 1));
    const char* whose = diagnostic->fault == Fault::own ? "kaya itself failed: " : "";
    lua_pushfstring(L, "%s%s", whose, diagnostic->message.c_str());
    return 1;
}

/// By bisection: Lua walks the whole stack to find one level, and there may be 200,000 of them.
int count_levels(lua_State* L) {
    lua_Debug record;
    int below = 0, above = 1; // level `below` exists or is 0, level `above` does not
    while (lua_getstack(L, above, &record)) {
        below = above;
        above *= 2;
    }
    while (below < above) {
        const int middle = (below + above) / 2;
        if (lua_getstack(L, middle, &record)) below = middle + 1;
        else above = middle;
    }
    return below;
}

std::string describe(const Source& source, const lua_Debug& record) {
    const Place place = line_place(source, record.currentline);
    const std::string where = place ? fmt::format(", {}:{}", place.source->name, place.line) : "";
    if (source.is_fish)
        return source.title.empty() ? "in a FISH expression" + where
                                    : fmt::format("in FISH function '{}'{}", source.title, where);
    if (record.what && std::strcmp(record.what, "main") == 0) return "in a Lua chunk" + where;
    return record.name ? fmt::format("in Lua function '{}'{}", record.name, where) : "in a Lua function" + where;
}

/// Gives the diagnostic the place of the innermost line of a script, and a line for every function.
void add_stack(lua_State* L, Diagnostic& diagnostic) {
    lua_Debug record;
    const int levels = count_levels(L) - state_of(L).levels_before;
    int shown = 0;
    for (int level = 0; level < levels && shown <= most_stack_lines && lua_getstack(L, level, &record); ++level) {
        lua_getinfo(L, "Sln", &record);
        const Source* source = state_of(L).sources.find(record.source);
        if (!source) continue;
        if (!diagnostic.place) diagnostic.at(line_place(*source, record.currentline));
        if (source->is_fish && source->title.empty()) continue;
        diagnostic.add(++shown > most_stack_lines ? "... and more" : describe(*source, record));
    }
}

Diagnostic from_error_value(lua_State* L, int index) {
    if (const Diagnostic* known = diagnostic_at(L, index)) return *known;
    std::size_t size = 0;
    const char* raw = lua_type(L, index) == LUA_TSTRING ? lua_tolstring(L, index, &size) : nullptr;
    if (!raw)
        return Diagnostic(fmt::format("the script stopped with a {} as error value", luaL_typename(L, index)), {},
                          Fault::run);
    const std::string message(raw, size);
    std::string_view chunk, text = message;
    int line = 0;
    const Source* source = nullptr;
    if (split_message(message, chunk, line, text)) source = state_of(L).sources.find(chunk);
    Diagnostic diagnostic = in_plain_words(L, source ? text : std::string_view(message));
    if (source) diagnostic.at(line_place(*source, line));
    return diagnostic;
}

/// Runs at the point of the error, while the stack of functions still exists.
int handle_error(lua_State* L) {
    try {
        Diagnostic diagnostic = from_error_value(L, 1);
        add_stack(L, diagnostic);
        push_diagnostic(L, diagnostic);
    } catch (const std::exception&) { lua_settop(L, 1); }
    return 1;
}

} // namespace

void open_diagnostics(lua_State* L) {
    lua_createtable(L, 0, 3);
    lua_pushcfunction(L, release);
    lua_setfield(L, -2, "__gc");
    lua_pushcfunction(L, show);
    lua_setfield(L, -2, "__tostring");
    lua_pushstring(L, "error");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0); // hides __gc from getmetatable of a script
    lua_setfield(L, -2, "__metatable");
    state_of(L).diagnostic_type = luaL_ref(L, LUA_REGISTRYINDEX);
}

void push_diagnostic(lua_State* L, const Diagnostic& diagnostic) {
    luaL_checkstack(L, 4, "for an error");
    void* memory = lua_newuserdatauv(L, sizeof(Diagnostic), 0);
    new (memory) Diagnostic(diagnostic);
    push_anchor(L, state_of(L).diagnostic_type);
    lua_setmetatable(L, -2);
}

const Diagnostic* diagnostic_at(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return nullptr;
    push_anchor(L, state_of(L).diagnostic_type);
    const bool same = lua_rawequal(L, -1, -2);
    lua_pop(L, 2);
    return same ? static_cast<const Diagnostic*>(lua_touserdata(L, index)) : nullptr;
}

void call_protected(lua_State* L, int arguments, int results) {
    if (state_of(L).depth >= deepest_call)
        throw Diagnostic(fmt::format("commands and functions call each other more than {} levels deep", deepest_call),
                         "a function that runs commands which call it needs a way to end", Fault::run);
    const int outer_levels = state_of(L).levels_before;
    // A stop that was requested while no script ran was not meant for this one.
    if (state_of(L).depth == 0) lua_sethook(L, nullptr, 0, 0), state_of(L).stopping = false;
    if (state_of(L).depth > 0) state_of(L).levels_before = count_levels(L);
    ++state_of(L).depth;

    const int handler = lua_gettop(L) - arguments;
    lua_pushcfunction(L, handle_error);
    lua_insert(L, handler);
    const int status = lua_pcall(L, arguments, results, handler);
    --state_of(L).depth;
    state_of(L).levels_before = outer_levels;
    lua_remove(L, handler);
    if (state_of(L).depth == 0) lua_sethook(L, nullptr, 0, 0);
    if (status == LUA_OK) return;
    const Diagnostic diagnostic = from_error_value(L, -1);
    lua_pop(L, 1);
    throw diagnostic;
}

void load_text(lua_State* L, const std::string& text, const std::string& chunk_name) {
    if (luaL_loadbufferx(L, text.data(), text.size(), chunk_name.c_str(), "t") == LUA_OK) return;
    const Diagnostic diagnostic = from_error_value(L, -1);
    lua_pop(L, 1);
    throw diagnostic;
}

} // namespace kaya::script
