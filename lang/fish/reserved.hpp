// Names that FISH has in 3DEC and kaya does not know. They are refused with a message: as ordinary variables they would silently be 0.
#pragma once

#include "base/diagnostic.hpp"

#include <span>
#include <string_view>

namespace kaya::fish {

struct ReservedName {
    std::string_view name;    ///< lower case; a family of names ends with `*`: cable_*
    bool planned;             ///< it will be supported
    std::string_view instead; ///< what to do, or why it is missing
};

/// All reserved names; families are at the end.
std::span<const ReservedName> reserved_names();

/// The entry of exactly this name, or null. Families are left out: a deck may well have a variable flow_rate.
const ReservedName* find_reserved(std::string_view name);
/// The entry of this name, or of the family that it belongs to.
const ReservedName* find_reserved_family(std::string_view name);

/// The message when such a name is used.
Diagnostic reserved_message(std::string_view name, const ReservedName& reserved);

} // namespace kaya::fish
