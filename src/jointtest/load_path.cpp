#include "jointtest/load_path.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ranges>

namespace kaya {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const char* what, const char* hint) {
    throw Diagnostic(fmt::format("{}: {}", file.string(), what), hint);
}

} // namespace

bool is_path_column(std::string_view name) {
    return std::ranges::find(path_columns, name) != std::ranges::end(path_columns);
}

LoadPath read_load_path(const std::filesystem::path& file) {
    LoadPath path{{}, read_csv(file)};
    const auto& table = path.table;
    const auto column = [&](const char* name) -> const std::vector<double>* {
        const auto found = table.find(name);
        return found ? &table.columns[*found] : nullptr;
    };
    const auto *x = column("shear_displacement"), *y = column("shear_displacement_y"),
               *opening = column("normal_displacement"), *stress = column("normal_stress"),
               *stiffness = column("boundary_stiffness"), *time = column("time");
    if (opening && stress)
        refuse(file, "it gives normal_displacement and normal_stress",
               "one of them follows from the other: leave one out");
    if (!opening && !stress)
        throw Diagnostic(
            fmt::format("{}: it has neither a column normal_displacement nor normal_stress", file.string()),
            fmt::format("say what happens across the joint; its columns are: {}", fmt::join(table.names, ", ")));
    if (stiffness && !stress)
        refuse(file, "boundary_stiffness needs a column normal_stress", "give the normal stress at the first point");
    if (table.rows() < 2) refuse(file, "a path needs two points at least", "the first is where the test begins");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        PathPoint point;
        if (x) point.shear[0] = (*x)[row];
        if (y) point.shear[1] = (*y)[row];
        if (opening) point.opening = (*opening)[row];
        if (stress) point.stress = (*stress)[row];
        if (stiffness) point.boundary_stiffness = (*stiffness)[row];
        point.time = time ? (*time)[row] : static_cast<double>(row);
        if (row > 0 && point.time < path.points.back().time) refuse(file, "time goes back", "sort the rows by time");
        path.points.push_back(point);
    }
    return path;
}

} // namespace kaya
