// Values as the user sees them: numbers like C's %g with 6 digits, vectors as (x,y,z).
#pragma once

#include "lang/script/world.hpp"

#include <string>

namespace kaya::script {

/// What `print @x` and `out(string(x))` show. A handle shows as "sub_contact #12"; `world` names its table.
std::string to_text(const Value& value, const World* world = nullptr);

/// "integer", "number", "text", "vector", "pointer", "nothing": for messages.
std::string_view type_name(const Value& value);

} // namespace kaya::script
