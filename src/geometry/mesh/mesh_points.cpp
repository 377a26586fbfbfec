#include "geometry/mesh/mesh_points.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/cut.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {

std::vector<int> common_faces(const MeshPoints& points, const std::vector<int>& numbers) {
    std::vector<int> common = points.faces[numbers.front()];
    for (const int number : numbers) {
        const auto& faces = points.faces[number];
        std::erase_if(common, [&](int f) { return !std::binary_search(faces.begin(), faces.end(), f); });
    }
    return common;
}

double lattice_cell(double edge) {
    // Edges of the lattice's tetrahedra are 1 and sqrt(3)/2 cells long, in the ratio 3 to 4. Between the lattice and the faces they are
    // longer; with these cells the mean of all is the requested length.
    return 0.93 * edge / ((3 + 4 * std::sqrt(0.75)) / 7);
}

void add_inner_points(const Polyhedron& polyhedron, double edge, double clearance, bool centre, MeshPoints& points) {
    const double cell = lattice_cell(edge), gap = clearance * edge;
    const Vec3 centroid = mass_properties(polyhedron).centroid;
    const std::size_t on_surface = points.points.size();
    const std::vector<Plane> walls = outer_planes(polyhedron);
    const auto [least, greatest] = box_around(polyhedron.vertices);
    const Vec3 first = ((least - centroid) / cell).array().floor(),
               last = ((greatest - centroid) / cell).array().ceil();
    constexpr double most_places = 1e9; // some ten seconds
    if (!((last - first).cwiseMax(1).prod() <= most_places))
        throw Diagnostic(
            fmt::format(
                "edges of {:.3g} are too short for a block that is {:.3g} long: the box around it has more than {:.0e} places for points",
                edge, (last - first).maxCoeff() * cell, most_places),
            "use longer edges, or cut the block");
    const Eigen::Vector3i low = first.cast<int>(), high = last.cast<int>();
    for (int k = low[2]; k <= high[2]; ++k, stop_point())
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                for (const double half : {0.0, 0.5}) {
                    const Vec3 point = centroid + cell * Vec3(i + half, j + half, k + half);
                    const bool fits = std::all_of(walls.begin(), walls.end(),
                                                  [&](const Plane& wall) { return wall.distance(point) <= -gap; });
                    if (fits) points.add(point, {});
                }
    if (centre && points.points.size() == on_surface) points.add(centroid, {});
}

void add_graded_points(const Polyhedron& polyhedron, const Spacing& spacing, double clearance, bool centre,
                       MeshPoints& points) {
    const std::vector<Plane> walls = outer_planes(polyhedron);
    const auto [low, high] = box_around(polyhedron.vertices);
    const std::size_t on_surface = points.points.size();
    const auto depth = [&](const Vec3& x) {
        double least = std::numeric_limits<double>::infinity();
        for (const Plane& wall : walls) least = std::min(least, -wall.distance(x));
        return least;
    };
    for (const Vec3& x : graded_points(low, high, spacing, {depth, clearance})) points.add(x, {});
    if (centre && points.points.size() == on_surface) points.add(mass_properties(polyhedron).centroid, {});
}

Spacing spacing_in(const Polyhedron& polyhedron, const BlockSurface& surface, const EdgeField& field, Shorter shorter) {
    /// Edges shorter than that part of the field's length are fine ones, imposed by a neighbour.
    const double fine = shorter == Shorter::at_all ? 0.85 : 0.55;
    Spacing spacing{[field](const Vec3& x) { return field.at(x); }, field.change(), {}};
    const auto& points = surface.points.points;
    std::vector<double> sum(points.size());
    std::vector<int> count(points.size());
    for (const auto& t : surface.triangles)
        for (int k = 0; k < 3; ++k) {
            const int a = t.points[k], b = t.points[(k + 1) % 3];
            const double length = (points[a] - points[b]).norm();
            for (const int p : {a, b}) sum[p] += length, ++count[p];
        }
    // Edges at the block's own corners are as short as the block says.
    for (std::size_t p = shorter == Shorter::at_all ? 0 : polyhedron.vertices.size(); p < points.size(); ++p)
        if (sum[p] < fine * count[p] * field.at(points[p])) spacing.finer.push_back({points[p], sum[p] / count[p]});
    return spacing;
}

} // namespace kaya
