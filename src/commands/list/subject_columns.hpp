// The columns of `list blocks show velocity`.
#pragma once

#include "commands/list/row_table.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// The columns of a list: the usual ones, or those of its subjects after the numbers of the objects.
std::vector<ListColumn> subject_columns(const Model& model, const lang::List& command,
                                        const std::vector<ListColumn>& usual);

/// The kinds of parts that touch: "face-edge".
const char* contact_type_text(ContactType type);
/// Directions in which a body is held: "x y rz"; "-" for none.
std::string fixity_text(const Model& model, std::uint8_t fixed, std::int32_t roller);
/// The same of a block; "-" for one with zones, whose gridpoints are held.
std::string block_fixity_text(const Model& model, Row block);

} // namespace kaya
