// The whole state of the scripts of a model as plain data: `save` writes it and `restore` reads it.
#pragma once

#include "lang/script/values/tables.hpp"
#include "lang/script/values/world.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace kaya::script {

/// Index into ScriptState::objects. Two variables may hold the same array.
struct ObjectReference {
    std::size_t index = 0;
    bool operator==(const ObjectReference&) const = default;
};

using StoredValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3, Handle, ObjectReference>;

/// A Lua table or map (keys and values side by side), a FISH array (dimensions and elements row by row), a list or tensor (values), a
/// structure (the names of its members as keys, and their values).
struct StoredObject {
    std::vector<std::int64_t> dimensions;
    std::vector<StoredValue> keys;
    std::vector<StoredValue> values;
    enum class Kind : std::uint8_t { table, array, list, map, tensor, structure, matrix } kind = Kind::table;
    std::string name = {}; ///< of the kind of structure
};

struct StoredSource {
    enum class Kind : std::uint8_t { fish, lua } kind = Kind::fish;
    std::string title; ///< name of the FISH function
    std::string name;  ///< of the deck
    std::int64_t line = 1;
    std::string text;
};

/// A FISH function that runs in cycles.
struct StoredHook {
    std::string function;
    std::uint8_t moment = 2;    ///< a script::Moment
    std::int64_t interval = 1;  ///< runs in each cycle whose number is a multiple
    bool whilestepping = false; ///< registered in the function itself: removed when the function is redefined
    double location = 0;        ///< orders the hooks of one moment
};

struct ScriptState {
    std::vector<std::pair<std::string, StoredValue>> fish_globals; ///< sorted by name
    std::vector<std::pair<std::string, StoredValue>> lua_globals;  ///< sorted by name; no functions
    std::vector<std::pair<std::string, StoredValue>> extras;       ///< "b_extra" -> object handle -> value
    std::vector<StoredObject> objects;
    std::vector<StoredSource> sources; ///< FISH functions and Lua chunks that define something, in order
    std::vector<StoredHook> hooks;     ///< of FISH functions; those of one moment in the order of their calls
    Tables tables;
    std::array<std::uint64_t, 4> random{};
    bool automatic_create = true; ///< of FISH variables
};

/// One block of bytes, the same for the same state on every machine; and back.
/// from_bytes throws Diagnostic when the bytes are cut off or of another version.
std::string to_bytes(const ScriptState& state);
ScriptState from_bytes(const std::string& bytes);

} // namespace kaya::script
