#include "geometry/read/surface_files.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {
namespace {

/// Corners nearer than this share of the size are one; the files have single precision.
constexpr double same_corner = 2e-7;

bool holds(const Box& outer, const Box& inner) {
    return (outer.low.array() < inner.low.array()).all() && (outer.high.array() > inner.high.array()).all();
}

/// Turns the faces alike; false for a surface that is not closed.
bool turned_alike(Surface& shell) {
    try {
        check_faces(shell);
        turn_alike(shell);
    } catch (const Diagnostic& mistake) {
        if (mistake.fault != Fault::deck) throw; // a request to stop
        return false;
    }
    return true;
}

/// Two walls that lie on each other: a closed surface without volume.
bool is_double_wall(Surface shell) {
    if (!turned_alike(shell)) return false;
    const double size = size_of(shell.vertices);
    return std::abs(volume_of(triangles_of(shell))) <= 1e-9 * size * size * size;
}

/// Whether a closed surface winds around all corners of another one; false for one that is not closed.
bool encloses(Surface outer, const Surface& inner) {
    if (!turned_alike(outer)) return false;
    const auto triangles = triangles_of(outer);
    return std::ranges::all_of(inner.vertices, [&](const Vec3& v) { return winding(triangles, v) != 0; });
}

/// Surfaces inside an odd number of others bound hollows of the smallest of those; all others are bodies.
std::vector<NamedSurface> nested(const std::string& name, std::vector<Surface>&& shells) {
    std::vector<Box> boxes;
    for (const Surface& shell : shells) boxes.push_back(box_around(shell.vertices));
    std::vector<std::vector<int>> around(shells.size());
    for (const auto& pair : overlapping_boxes(boxes))
        for (const auto& [outer, inner] : {std::pair(pair[0], pair[1]), std::pair(pair[1], pair[0])})
            if (holds(boxes[outer], boxes[inner]) && encloses(shells[outer], shells[inner]))
                around[inner].push_back(outer);
    std::vector<NamedSurface> bodies;
    std::vector<std::size_t> body_of(shells.size());
    for (std::size_t i = 0; i < shells.size(); ++i) {
        if (around[i].size() % 2 != 0) continue;
        body_of[i] = bodies.size();
        bodies.push_back({name, shells[i], {}});
    }
    for (std::size_t i = 0; i < shells.size(); ++i) {
        if (around[i].size() % 2 == 0) continue;
        // The one around it that is inside most others.
        const int outer = *std::ranges::max_element(around[i], {}, [&](int other) { return around[other].size(); });
        bodies[body_of[outer]].cavities.push_back(std::move(shells[i]));
    }
    return bodies;
}

} // namespace

Surface welded(const FaceSoup& soup, double near) {
    std::vector<Vec3> corners;
    for (const auto& loop : soup.loops) corners.insert(corners.end(), loop.begin(), loop.end());
    Surface all = surface_from_loops(soup.loops, std::max(near, same_corner * size_of(corners)));
    std::erase_if(all.faces, [](const Surface::Face& face) {
        std::vector<int> sorted = face.vertices;
        std::sort(sorted.begin(), sorted.end());
        return std::unique(sorted.begin(), sorted.end()) - sorted.begin() < 3;
    });
    return all;
}

SurfaceFile surfaces_of(const std::vector<FaceSoup>& soups, const Repair& repair) {
    SurfaceFile file;
    for (const FaceSoup& soup : soups) {
        if (soup.loops.empty()) continue;
        stop_point();
        Surface all = welded(soup, repair.near);
        if (repair.near > 0)
            file.repaired.welded += static_cast<int>(welded(soup).vertices.size() - all.vertices.size());
        repair_surface(all, repair, file.repaired);
        std::vector<Surface> shells = separate(all);
        const auto walls =
            std::stable_partition(shells.begin(), shells.end(), [](const Surface& s) { return !is_double_wall(s); });
        if (walls != shells.begin()) { // nothing but walls: the message about it names them
            for (auto wall = walls; wall != shells.end(); ++wall)
                file.repaired.doubled += static_cast<int>(wall->faces.size());
            shells.erase(walls, shells.end());
        }
        for (NamedSurface& body : nested(soup.name, std::move(shells))) file.surfaces.push_back(std::move(body));
    }
    return file;
}

} // namespace kaya
