// Explanations of message codes: `kaya explain unknown-word`.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// All codes, one line each.
std::string code_list();

/// The explanation of one code. Throws Diagnostic with the nearest one when there is none of that name.
std::string explanation(std::string_view words);

} // namespace kaya
