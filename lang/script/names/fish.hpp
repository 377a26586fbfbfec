// Definitions of FISH: functions, and its data other than variables.
#pragma once

#include "lang/fish/compiler.hpp"
#include "lang/script/base/open_file.hpp"
#include "lang/script/base/random.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/tables.hpp"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <unordered_map>

namespace kaya::script {

struct DefinedFunction {
    fish::Function function;
    std::string chunk_name;
};

struct Fish {
    bool automatic_create = true; ///< a variable exists from its first mention on
    std::map<std::string, DefinedFunction, std::less<>> functions;
    std::set<std::string, std::less<>> lua_functions; ///< lower case names of global Lua functions
    /// Translated expressions of commands and histories, by text: number in Lua's registry.
    std::unordered_map<std::string, int> expressions;
    Tables tables;
    Random random; ///< of Lua as well
    OpenFile file;

    // References to tables in Lua's registry.
    int globals = LUA_NOREF; ///< G: values of FISH variables
    int called = LUA_NOREF;  ///< F: FISH functions and, wrapped, Lua functions
};

inline Fish& fish_of(lua_State* L) { return *owners_of(L).fish; }

} // namespace kaya::script
