// Values as the user sees them: numbers like C's %g with 6 digits, vectors as (x,y,z).
#pragma once

#include "lang/script/world.hpp"

#include <string>

namespace kaya::script {

/// What `print @x` and `out(x)` show. A handle shows as "sub_contact 12"; `world` names its table.
std::string to_text(const Value& value, World* world = nullptr);

/// "sub_contact 12", by the number that lists and messages call it too; "block (deleted)".
std::string handle_text(World& world, const Handle& handle);
/// The number alone, for string(pointer); 0 of an object that is gone and of the null pointer.
std::int64_t handle_number(World& world, const Handle& handle);

/// "integer", "number", "text", "vector", "pointer", "nothing": for messages.
std::string_view type_name(const Value& value);

} // namespace kaya::script
