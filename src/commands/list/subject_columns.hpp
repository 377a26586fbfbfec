// The columns of `list blocks show velocity`.
#pragma once

#include "commands/list/row_table.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// The columns of a list: the usual ones, or those of its subjects after the numbers of the objects. `others` are computed for subjects only.
std::vector<ListColumn> subject_columns(const lang::List& command, const std::vector<ListColumn>& usual,
                                        const std::vector<ListColumn>& others = {});

} // namespace kaya
