// The classic language: all families in the order in which short words resolve.
#pragma once

#include "base/object_kind.hpp"
#include "lang/commands/condition_commands.hpp"
#include "lang/interp/spec.hpp"

namespace kaya::lang {

Family control();
Family geometry();
Family materials();
Family boundary();
Family history();
Family output();
Family solution();
Family slopes();
Family structures();
Family script();
Family not_supported_yet(); ///< known words that are refused

/// Parts of the family geometry.
std::vector<CommandSpec> shape_commands();     ///< poly ...
std::vector<CommandSpec> cut_commands();       ///< jset
std::vector<CommandSpec> selection_commands(); ///< group, mark, excavate, fill
std::vector<CommandSpec> surface_commands();   ///< geometry, cut geometry, cut dfn
std::vector<CommandSpec> fracture_commands();  ///< fracture
std::vector<CommandSpec> network_commands();   ///< fracture template|generate|import|export

/// Parts of the family boundary.
CommandSpec insitu();
CommandSpec initialize();

/// The fields that have their own word in `history`; with `rates`, the fields whose rate it records.
std::vector<std::pair<ObjectKind, std::string_view>> recorded_fields();
/// What a word of `history` records.
HistoryItem::Quantity recorded_quantity(std::string_view word);
/// The names of the properties of structures.
std::vector<std::string_view> structure_property_words();

/// Built once, on first use.
const Language& classic();

} // namespace kaya::lang
