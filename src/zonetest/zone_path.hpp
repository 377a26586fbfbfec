// A path of strains and stresses for one zone, from a CSV file.
#pragma once

#include "jointtest/csv_table.hpp"
#include "zonetest/single_zone.hpp"

#include <vector>

namespace kaya {

/// Total strains, or stresses, at a point of the path.
struct ZonePoint {
    SixNumbers value{};
    double time = 0;
};

struct ZonePath {
    std::array<bool, 6> is_stress{};
    std::vector<ZonePoint> points; ///< the path is straight between two of them
};

/// Columns `xx_strain` to `yz_strain` or `xx_stress` to `yz_stress`, one of the two for a component at most, and `time`. A
/// component with neither does not strain. Throws Diagnostic with the file for anything else.
ZonePath read_zone_path(const std::filesystem::path& file);

} // namespace kaya
