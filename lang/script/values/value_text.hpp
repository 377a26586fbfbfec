// Values as the user sees them: numbers like C's %g with 6 digits, vectors as (x,y,z).
#pragma once

#include "lang/script/values/world.hpp"

#include <string>

namespace kaya::script {

/// The text of a value for `print @x` and `out(x)`. A handle is printed as "sub_contact 12"; `world` names its table.
std::string to_text(const Value& value, World* world = nullptr);

/// "sub_contact 12", by the number that lists and messages call it too; "block (deleted)".
std::string handle_text(World& world, const Handle& handle);
/// The number alone, for string(pointer); 0 for a deleted object and for the null pointer.
std::int64_t handle_number(World& world, const Handle& handle);

/// "integer", "number", "text", "vector", "pointer", "nothing": for messages.
std::string_view type_name(const Value& value);

} // namespace kaya::script
