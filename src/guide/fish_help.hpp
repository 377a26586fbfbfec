// Help texts of FISH: its statements and its functions.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// A page on a statement (loop, case_of) or a function (b_next, in_range); empty when FISH has none of that name.
std::string about_fish(std::string_view name);

} // namespace kaya
