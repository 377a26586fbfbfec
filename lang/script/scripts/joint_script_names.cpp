#include "lang/script/scripts/joint_script_names.hpp"

#include "base/diagnostic.hpp"
#include "lang/script/base/lua_headers.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace kaya::script {

namespace {

/// Name of a table in messages.
constexpr int noun_upvalue = lua_upvalueindex(1), names_upvalue = lua_upvalueindex(2);

/// "the row has no 'normal_forse'; did you mean 'normal_force'?"
std::string unknown_name(lua_State* L) {
    std::vector<std::string> known;
    lua_pushnil(L);
    while (lua_next(L, names_upvalue) != 0) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING) known.push_back(lua_tostring(L, -1));
    }
    std::sort(known.begin(), known.end()); // the order of a table of Lua is any
    const char* noun = lua_tostring(L, noun_upvalue);
    if (lua_type(L, 2) != LUA_TSTRING) return fmt::format("{} has names, not numbers", noun);
    const std::string word = lua_tostring(L, 2);
    const std::string meant(did_you_mean(word, {known.begin(), known.end()}));
    if (!meant.empty()) return fmt::format("{} has no '{}'; did you mean '{}'?", noun, word, meant);
    return fmt::format("{} has no '{}'; it has {}", noun, word, fmt::join(known, ", "));
}

int raise(lua_State* L, const std::string& sentence) {
    luaL_where(L, 1);
    lua_pushlstring(L, sentence.data(), sentence.size());
    lua_concat(L, 2);
    return 1;
}

int refuse_unknown(lua_State* L) {
    raise(L, unknown_name(L)); // the texts are destroyed before Lua jumps
    return lua_error(L);
}

int refuse_writing(lua_State* L) {
    lua_getfield(L, names_upvalue, lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "");
    if (lua_isnil(L, -1)) raise(L, unknown_name(L));
    else raise(L, fmt::format("{} can only be read", lua_tostring(L, noun_upvalue)));
    return lua_error(L);
}

/// It gets the chunk, the globals, the model and `debug`. Upvalues of functions of the file, and the globals, become read-only: a number
/// that is kept from call to call would make a row depend on the rows before it, and on the thread. It returns a function that restores a
/// variable which was changed nevertheless, and returns its name.
constexpr const char* freezer = R"(
local chunk, globals, model, debug = ...
local getupvalue, setupvalue = debug.getupvalue, debug.setupvalue
local getmetatable, setmetatable, next, type, rawget, rawset, rawequal, error, string, pairs =
    getmetatable, setmetatable, next, type, rawget, rawset, rawequal, error, string, pairs
local views, seen, watched, set, fields = {}, {}, {}, {}, {}
local freeze
local function look(f)
    if seen[f] then return end
    seen[f] = true
    for i = 1, 255 do
        local name, value = getupvalue(f, i)
        if not name or name == "" then break end
        if type(value) == "table" and value ~= globals then
            setupvalue(f, i, freeze(value))
        elseif type(value) == "function" then
            look(value)
        end
        local _, frozen = getupvalue(f, i)
        watched[#watched + 1] = {f, i, name, frozen}
    end
end
local function kept(key, what)
    error(string.format("'%s' is %s: a joint model keeps nothing but its history", key, what), 3)
end
freeze = function(t)
    if views[t] then return views[t] end
    local old, meta = getmetatable(t), {}
    if type(old) == "table" then
        for event, f in next, old do
            meta[event] = f
            if type(f) == "function" then look(f) end
        end
    end
    meta.__index = t
    meta.__len = meta.__len or function() return #t end
    meta.__pairs = meta.__pairs or function() return pairs(t) end
    meta.__newindex = function(_, key) kept(key, "set in a table that is kept from call to call") end
    meta.__metatable = false
    local view = setmetatable({}, meta)
    views[t], views[view] = view, view
    for key, value in next, t do
        if type(value) == "table" then
            set[#set + 1] = {t, key, value}
        elseif type(value) == "function" then
            look(value)
        end
    end
    while #set > 0 do
        local entry = set[#set]
        set[#set] = nil
        rawset(entry[1], entry[2], freeze(entry[3]))
    end
    return view
end
-- Globals and libraries are read in every row, and stay what they are: a new name raises, and an old one that was changed is seen
-- after the call.
globals.rawset = nil
local libraries = {[globals] = "not local", [globals.math] = "set in a library", [globals.string] = "set in a library",
    [globals.table] = "set in a library"}
for t in next, libraries do views[t] = t end
for t, what in next, libraries do
    local own = {}
    for key, value in next, t do if type(value) == "table" and not libraries[value] then own[key] = value end end
    for key, value in next, own do t[key] = freeze(value) end
    for key, value in next, t do
        if type(value) == "function" then look(value) end
        fields[#fields + 1] = {t, key, value}
    end
    setmetatable(t, {__newindex = function(_, key) kept(key, what) end, __metatable = false})
end
for _, value in next, model do if type(value) == "function" then look(value) end end
freeze(model)
for _, entry in next, watched do
    local _, value = getupvalue(entry[1], entry[2])
    entry[4] = value
end
return function()
    local changed
    for k = 1, #watched do
        local f, i, name, value = watched[k][1], watched[k][2], watched[k][3], watched[k][4]
        local _, now = getupvalue(f, i)
        if not rawequal(now, value) and not (now ~= now and value ~= value) then
            setupvalue(f, i, value)
            changed = name
        end
    end
    for k = 1, #fields do
        local t, key, value = fields[k][1], fields[k][2], fields[k][3]
        local now = rawget(t, key)
        if not rawequal(now, value) and not (now ~= now and value ~= value) then
            rawset(t, key, value)
            changed = key
        end
    end
    return changed
end
)";

} // namespace

void close_names(lua_State* L, const char* noun) {
    lua_newtable(L);
    for (const char* event : {"__index", "__newindex"}) {
        lua_pushstring(L, noun);
        lua_pushvalue(L, -3);
        lua_pushcclosure(L, refuse_unknown, 2);
        lua_setfield(L, -2, event);
    }
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void push_view(lua_State* L, const char* noun) {
    lua_newtable(L);
    lua_newtable(L);
    lua_pushvalue(L, -3);
    lua_setfield(L, -2, "__index");
    lua_pushstring(L, noun);
    lua_pushvalue(L, -4);
    lua_pushcclosure(L, refuse_writing, 2);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void refuse_other_names(lua_State* L, std::string_view of, std::initializer_list<std::string_view> known) {
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING) continue;
        const std::string word = lua_tostring(L, -1);
        if (std::find(known.begin(), known.end(), word) != known.end()) continue;
        const std::string meant(did_you_mean(word, {known.begin(), known.end()}));
        throw std::runtime_error(meant.empty()
                                     ? fmt::format("{} has no '{}'; it has {}", of, word, fmt::join(known, ", "))
                                     : fmt::format("{} has no '{}'; did you mean '{}'?", of, word, meant));
    }
}

void push_freezer(lua_State* L) {
    if (luaL_loadbufferx(L, freezer, std::strlen(freezer), "=kaya", "t") != LUA_OK)
        throw std::runtime_error(lua_tostring(L, -1));
}

} // namespace kaya::script
