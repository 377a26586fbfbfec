// The dialect of 3DEC 6, 7 and 9: `model new`, `block create brick`. Its commands are leaves of a tree of words; the structs that they fill,
// and the handlers that run them, are those of the classic dialect.
#pragma once

#include "lang/interp/spec.hpp"

namespace kaya::lang {

/// Both dialects: classic(), with modern() for the lines that begin with its words. Built once, on first use.
const Language& language();
/// The modern dialect alone.
const Language& modern();

/// Parts of families.
std::vector<CommandSpec> model_commands();
std::vector<CommandSpec> model_history_commands();
std::vector<CommandSpec> block_commands();
std::vector<CommandSpec> ground_commands(); ///< block mechanical, insitu, water, ...
CommandSpec apply_remove(std::string_view words, std::string_view example, std::string_view classic);
std::vector<CommandSpec> block_history_commands();
std::vector<CommandSpec> history_commands(); ///< history export, ...

/// Its families, in the order in which short words resolve.
Family model_family();
Family program_family();
Family create_family();
Family block_family();
Family contact_family();
Family gridpoint_family();
Family zone_family();
Family structure_family();
Family surface_family(); ///< geometry
Family fracture_family();
Family other_family();
Family unsupported_family(); ///< known words that are refused

} // namespace kaya::lang
