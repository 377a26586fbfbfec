// The names that FISH knows: functions, their hooks, and built-ins.
#pragma once

#include "lang/fish/compiler.hpp"
#include "lang/script/state.hpp"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace kaya::script {

/// A name that FISH knows without a definition.
struct BuiltIn {
    int least = 0; ///< arguments when it is read
    int most = 0;
    bool writable = false;
};

struct DefinedFunction {
    fish::Function function;
    std::string chunk_name;
};

struct FishLibrary {
    bool automatic_create = true; ///< a variable exists from its first mention on
    std::map<std::string, DefinedFunction, std::less<>> functions;
    std::set<std::string, std::less<>> lua_functions; ///< lower case names of global Lua functions
    std::map<std::string, BuiltIn, std::less<>> built_ins;
    std::vector<StoredHook> hooks;    ///< functions that run in cycles, in the order of their registration
    std::vector<StoredSource> stored; ///< FISH functions and Lua chunks in the order of their definition
    /// Translated expressions of commands and histories, by text: number in Lua's registry.
    std::unordered_map<std::string, int> expressions;
};

} // namespace kaya::script
