#include "lang/script/libraries/runtime.hpp"

#include "lang/fish/nearest.hpp"
#include "lang/fish/reserved.hpp"
#include "lang/script/base/modules.hpp"
#include "lang/script/base/source_list.hpp"
#include "lang/script/libraries/fish_values.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/arithmetic.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

// --- messages about arrays: called by stdlib/lua/fish_runtime.lua ------------------------------------

/// (value, name)
int fail_not_array(lua_State* L) {
    const std::string name = lua_tostring(L, 2);
    const bool zero = lua_isinteger(L, 1) && lua_tointeger(L, 1) == 0;
    if (!zero) throw Diagnostic(fmt::format("'{}' is not an array but {}", name, describe_value(L, 1)), {}, Fault::run);
    if (const auto* reserved = fish::find_reserved_family(name)) {
        Diagnostic unsupported = fish::reserved_message(name, *reserved);
        unsupported.fault = Fault::run;
        throw unsupported;
    }
    std::vector<std::string_view> candidates;
    for (const auto& [known, built_in] : names_of(L).built_ins) candidates.push_back(known);
    for (const auto& [known, function] : fish_of(L).functions) candidates.push_back(known);
    const auto meant = fish::nearest_name(name, candidates);
    throw Diagnostic(fmt::format("'{}' is neither a function nor an array", name),
                     meant.empty() ? fmt::format("define it, or make the array with: array {}(n)", name)
                                   : fmt::format("did you mean '{}'?", meant),
                     Fault::run);
}

std::string joined(lua_State* L, int table) {
    std::string text;
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, table)); ++i) {
        lua_rawgeti(L, table, i);
        if (i > 1) text += ',';
        text += text_at(L, -1);
        lua_pop(L, 1);
    }
    return text;
}

/// (array, name, indices)
int fail_outside(lua_State* L) {
    const std::string name = lua_tostring(L, 2);
    lua_getfield(L, 1, "dimensions");
    const auto given = lua_rawlen(L, 3), has = lua_rawlen(L, 4);
    if (given != has)
        throw Diagnostic(fmt::format("the array {}({}) has {} {}, here it is given {}", name, joined(L, 4), has,
                                     has == 1 ? "index" : "indices", given),
                         "give one for each dimension", Fault::run);
    throw Diagnostic(fmt::format("{}({}) is outside of the array {}({})", name, joined(L, 3), name, joined(L, 4)),
                     "indices are whole numbers and count from 1", Fault::run);
}

/// (name, size)
int fail_size(lua_State* L) {
    throw Diagnostic(fmt::format("the size of the array '{}' is {}", lua_tostring(L, 1), describe_value(L, 2)),
                     "a size is a whole number above 0", Fault::run);
}

/// (name)
int fail_too_large(lua_State* L) {
    throw Diagnostic(fmt::format("the array '{}' has too many elements", lua_tostring(L, 1)),
                     "at most 134217728 are possible", Fault::run);
}

// --- elements of arrays with one dimension ------------------------------------------------------------

bool is_list(lua_State* L) {
    if (lua_type(L, 1) != LUA_TTABLE || !lua_getmetatable(L, 1)) return false;
    const bool same = lua_topointer(L, -1) == state_of(L).array_address;
    lua_pop(L, 1);
    return same;
}

[[noreturn]] void fail_element(lua_State* L) {
    lua_createtable(L, 1, 0);
    lua_pushvalue(L, 3);
    lua_rawseti(L, -2, 1);
    lua_replace(L, 3);
    lua_settop(L, 3);
    if (is_array(L, 1)) fail_outside(L);
    else fail_not_array(L);
    throw std::logic_error("internal error: inconsistent array type");
}

/// Gives the arguments to a function for values other than arrays; true when that did it, with its result on the stack.
bool done_by(lua_State* L, const char* function) {
    const int arguments = lua_gettop(L);
    push_runtime(L, function);
    for (int i = 1; i <= arguments; ++i) lua_pushvalue(L, i);
    lua_call(L, arguments, 1);
    if (lua_toboolean(L, -1)) return true;
    lua_settop(L, arguments);
    return false;
}

/// (array, name, index)
int element(lua_State* L) {
    if (!is_list(L)) {
        if (!done_by(L, "other_element")) fail_element(L);
        return 1;
    }
    int whole = 0;
    const lua_Integer index = lua_type(L, 3) == LUA_TNUMBER ? lua_tointegerx(L, 3, &whole) : 0;
    if (!whole || lua_rawgeti(L, 1, index) == LUA_TNIL) fail_element(L);
    return 1;
}

/// (array, name, index, value)
int set_element(lua_State* L) {
    if (!is_list(L)) {
        if (!done_by(L, "set_other_element")) fail_element(L);
        return 0;
    }
    int whole = 0;
    const lua_Integer index = lua_type(L, 3) == LUA_TNUMBER ? lua_tointegerx(L, 3, &whole) : 0;
    if (!whole || lua_rawgeti(L, 1, index) == LUA_TNIL) fail_element(L);
    lua_pushvalue(L, 4);
    lua_rawseti(L, 1, index);
    return 0;
}

/// name(), where the name is that of a variable
int not_function(lua_State* L) {
    throw Diagnostic(fmt::format("'{}' is not a function but {}", lua_tostring(L, 2), describe_value(L, 1)), {},
                     Fault::run);
}

// --- commands -------------------------------------------------------------------------------------------

bool is_bare_word(const std::string& text) {
    return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                   "0123456789_.-/+") == std::string::npos;
}

/// A value as it must be written in a command, so that it is read back the same.
int word(lua_State* L) {
    const Value value = value_at(L, 1, "this part of the command");
    std::string text;
    if (const auto* number = std::get_if<double>(&value)) {
        text = fmt::format("{}", *number);
    } else if (const auto* vector = std::get_if<Vec3>(&value)) {
        text = fmt::format("({},{},{})", (*vector)[0], (*vector)[1], (*vector)[2]);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
        text = *words;
        if (!is_bare_word(text)) {
            text.assign(1, '\'');
            for (const char c : *words) text.append(c == '\'' ? 2 : 1, c);
            text += '\'';
        }
    } else if (std::holds_alternative<Handle>(value)) {
        throw Diagnostic("a pointer cannot stand in a command", "use its number, as in [b_id(p)]", Fault::run);
    } else {
        text = text_at(L, 1);
    }
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

/// (text, line)
int command(lua_State* L) {
    lua_Debug record;
    const Source* source = nullptr;
    if (lua_getstack(L, 1, &record)) {
        lua_getinfo(L, "S", &record);
        source = state_of(L).sources.find(record.source);
    }
    const std::string chunk = source && source->first ? source->first.source->name : "";
    const std::string text = text_argument(L, 1, "command");
    if (!is_restoring(L)) world_of(L).command(text, chunk, static_cast<int>(lua_tointeger(L, 2)), false);
    return 0;
}

constexpr std::array<luaL_Reg, 5> failures{{{"not_array", guarded<fail_not_array>},
                                            {"outside", guarded<fail_outside>},
                                            {"size", guarded<fail_size>},
                                            {"too_large", guarded<fail_too_large>},
                                            {nullptr, nullptr}}};

constexpr std::array<luaL_Reg, 6> functions{{{"element", guarded<element>},
                                             {"set_element", guarded<set_element>},
                                             {"not_function", guarded<not_function>},
                                             {"word", guarded<word>},
                                             {"command", guarded<command>},
                                             {nullptr, nullptr}}};

/// Arithmetic with whole arrays is refused with a message. Returns the address of the type.
const void* finish_array_type(lua_State* L, const char* name) {
    lua_getfield(L, -1, name);
    add_refusing_arithmetic(L);
    const void* address = lua_topointer(L, -1);
    lua_pop(L, 1);
    return address;
}

} // namespace

void open_runtime(lua_State* L) {
    load_text(L, std::string(built_in_module("fish_runtime")), "=fish_runtime");
    lua_newtable(L);
    luaL_setfuncs(L, failures.data(), 0);
    lua_newtable(L);
    add_runtime_arithmetic(L);
    lua_getfield(L, -1, "whole");
    lua_remove(L, -2);
    call_protected(L, 2, 1);
    add_runtime_arithmetic(L);
    luaL_setfuncs(L, functions.data(), 0);
    state_of(L).array_address = finish_array_type(L, "list_kind");
    state_of(L).grid_address = finish_array_type(L, "grid_kind");
    open_values(L);
    state_of(L).runtime = luaL_ref(L, LUA_REGISTRYINDEX);
}

} // namespace kaya::script
