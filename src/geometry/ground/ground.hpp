// A ground surface: triangles that have one height at each place of the plan.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

class Ground {
public:
    Ground() = default;
    /// Triangles as given, without vertical ones. Throws Diagnostic when none is left or a number is not finite.
    Ground(std::vector<Vec3> corners, std::vector<std::array<int, 3>> triangles);

    /// The same from a save file: empty when a triangle names a corner that is not there.
    static Ground restored(std::vector<Vec3> corners, std::vector<std::array<int, 3>> triangles);

    /// Delaunay triangles of points in plan; neighbours in `lines` stay neighbours, as needed for contour lines and bench edges. Among
    /// points with equal plan position the highest counts. Throws Diagnostic when they lie on one line.
    static Ground of_points(const std::vector<std::vector<Vec3>>& lines);

    const std::vector<Vec3>& corners() const { return corners_; }
    const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
    /// The edges of one triangle only: of its border and of its holes.
    const std::vector<std::array<int, 2>>& rim() const { return rim_; }
    bool empty() const { return triangles_.empty(); }

    /// The height of the highest triangle; none outside of the plan.
    std::optional<double> height(double x, double y) const;
    /// The same, and outside of the plan the height of the nearest place on its edge.
    double height_beyond(double x, double y) const;

    /// Triangles whose box in the plan meets this one, ascending.
    std::vector<int> near(double x_low, double x_high, double y_low, double y_high) const;

    void move(const Vec3& shift);

private:
    void sort_in();
    std::size_t cell(double value, int axis) const;

    std::vector<Vec3> corners_;
    std::vector<std::array<int, 3>> triangles_;
    // Triangles by the cells of a grid in the plan that their boxes meet.
    std::array<double, 2> low_{0, 0}, width_{1, 1};
    std::array<std::size_t, 2> cells_{1, 1};
    std::vector<std::vector<int>> in_cell_;
    std::vector<std::array<int, 2>> rim_; ///< edges of one triangle only
};

/// Reads .stl, .obj, .ply (their triangles), .asc (a grid of heights with the header of ESRI), or lines of x y z in any other
/// file, commas or blanks between them; a blank line ends a line of points that belong together, as contour lines do.
/// Throws Diagnostic with file and line.
Ground read_ground(const std::string& path);
Ground ground_from_points(std::string_view text, const std::string& file);
Ground ground_from_grid(std::string_view text, const std::string& file);

} // namespace kaya
