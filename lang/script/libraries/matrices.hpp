// Linear algebra of FISH matrices and tensors.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// Adds determinant(values, n), inverse(values, n) and principal(tensor) to the table at the top of the stack. `values` are numbers: the rows
/// of a matrix in turn.
void add_matrix_functions(lua_State* L);

} // namespace kaya::script
