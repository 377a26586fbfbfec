// Names that mean something to FISH in 3DEC and that this program does not know. They are refused in words: as
// ordinary variables they would silently be 0.
#pragma once

#include "base/diagnostic.hpp"

#include <span>
#include <string_view>

namespace kaya::fish {

struct ReservedName {
    std::string_view name;    ///< lower case; a family of names ends with `*`: cable_*
    bool planned;             ///< it has a meaning here and will come
    std::string_view instead; ///< what to do, or why it is missing
};

/// All of them, families last.
std::span<const ReservedName> reserved_names();

/// The entry of exactly this name, or null. Families are left out: a deck may well have a variable flow_rate.
const ReservedName* find_reserved(std::string_view name);
/// The entry of this name, or of the family that it belongs to.
const ReservedName* find_reserved_family(std::string_view name);

/// What to say when such a name is used.
Diagnostic reserved_message(std::string_view name, const ReservedName& reserved);

} // namespace kaya::fish
