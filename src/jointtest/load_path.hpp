// The path of a joint on the bench.
#pragma once

#include "jointtest/csv_table.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace kaya {

/// A point of the path. Segments between points are straight.
struct PathPoint {
    std::array<double, 2> shear{};
    double time = 0;
    std::optional<double> opening; ///< normal displacement, opening positive; or
    std::optional<double> stress;  ///< normal stress, compression positive,
    double boundary_stiffness = 0; ///< which rises by this per opening since the first point
};

/// Columns of the file: shear_displacement and/or shear_displacement_y; normal_displacement or normal_stress, the latter optionally with
/// boundary_stiffness; optionally time (otherwise each segment takes a unit of time). The first point is the state of the joint before the
/// test.
struct LoadPath {
    std::vector<PathPoint> points;
    CsvTable table; ///< the whole file, other columns included
};

inline constexpr std::string_view path_columns[] = {"shear_displacement", "shear_displacement_y", "normal_displacement",
                                                    "normal_stress",      "boundary_stiffness",   "time"};
bool is_path_column(std::string_view name);

/// Throws Diagnostic that names the missing column, or the two that exclude each other.
LoadPath read_load_path(const std::filesystem::path& file);

} // namespace kaya
