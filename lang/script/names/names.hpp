// The names that scripts know without a definition: built-ins of FISH, and the fields of objects.
#pragma once

#include "lang/script/names/traversal.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/field_index.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace kaya::script {

/// A name that FISH knows without a definition.
struct BuiltIn {
    int least = 0; ///< arguments when it is read
    int most = 0;
    bool writable = false;
};

struct Names {
    std::map<std::string, BuiltIn, std::less<>> built_ins;
    FieldIndex fields;
    std::vector<std::size_t> next_relations; ///< by table number: from an object to the next one of its list
    std::vector<Traversal> traversals;

    // References to tables in Lua's registry.
    int readers = LUA_NOREF; ///< A: built-ins that read
    int writers = LUA_NOREF; ///< W: built-ins that write
    int extras = LUA_NOREF;  ///< "b_extra" -> handle -> value
    int methods = LUA_NOREF; ///< contact -> sub_contacts -> function
    int kept = LUA_NOREF;    ///< keeps the field names alive, whose addresses are compared
};

inline Names& names_of(lua_State* L) { return *owners_of(L).names; }

} // namespace kaya::script
