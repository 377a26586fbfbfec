// The known name that is nearest to an unknown one.
#pragma once

#include <string_view>
#include <vector>

namespace kaya::fish {

/// As did_you_mean of base/diagnostic, but names of the same kind of object come first: for b_xdsf rather b_dsf than
/// gp_dsf.
std::string_view nearest_name(std::string_view word, const std::vector<std::string_view>& candidates);

/// True when the names differ by one missing, surplus or wrong letter, or by two exchanged letters. Numbered names (x1, x2; xmin, ymin) are
/// not slips of each other.
bool is_one_slip(std::string_view one, std::string_view other);

} // namespace kaya::fish
