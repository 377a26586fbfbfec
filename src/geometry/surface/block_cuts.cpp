#include "geometry/surface/block_cuts.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

/// The planes of each convex part of the outline: first the sides, then the ends, which cut no more than what is left.
std::vector<std::vector<Plane>> planes_of_parts(const TunnelOutline& outline) {
    constexpr double of_an_end = 0.1; // cosine between the normal and the axis
    std::vector<std::vector<Plane>> parts;
    for (std::size_t k = 1; k < outline.sections.size(); ++k) {
        const auto &from = outline.sections[k - 1], &to = outline.sections[k];
        const Vec3 along = (mean_of(to) - mean_of(from)).normalized();
        for (const Polyhedron& part : make_prism(from, to).parts) {
            parts.push_back(outer_planes(part));
            std::ranges::stable_sort(parts.back(), {},
                                     [&](const Plane& plane) { return std::abs(plane.normal.dot(along)) > of_an_end; });
        }
    }
    return parts;
}

/// Planes through the axis of the outline and each of its corners.
std::vector<Plane> radial_planes(const TunnelOutline& outline) {
    const Vec3 centre = mean_of(outline.sections[0]), axis = mean_of(outline.sections[1]) - centre;
    std::vector<Plane> planes;
    for (const Vec3& corner : outline.sections[0]) {
        const Vec3 normal = axis.cross(corner - centre);
        if (normal.norm() > 1e-12 * axis.norm() * (corner - centre).norm())
            planes.push_back({normal.normalized(), centre});
    }
    return planes;
}

struct Piece {
    Polyhedron polyhedron;
    bool inside = false;
};

/// Parts of one piece of rock in and around a convex part of the tunnel; only the rock itself when they do not intersect.
std::vector<Piece> carve(const Polyhedron& rock, const std::vector<Plane>& planes, int id, double thinnest,
                         int& slivers) {
    std::vector<Piece> pieces;
    Polyhedron left = rock;
    for (const Plane& plane : planes) {
        Cut parts = cut(left, plane, id, thinnest);
        if (parts.outcome == CutOutcome::sliver) {
            // Too thin to cut: the piece belongs where its greater part is.
            ++slivers;
            if (plane.distance(mass_properties(left).centroid) > 0) parts.outcome = CutOutcome::above;
        }
        if (parts.outcome == CutOutcome::above) return {{rock, false}};
        if (parts.outcome != CutOutcome::cut) continue;
        pieces.push_back({std::move(parts.above), false});
        left = std::move(parts.below);
    }
    pieces.push_back({std::move(left), true});
    return pieces;
}

/// Cuts the pieces outside by the planes; those inside stay. `progress` gets the fraction of the planes.
void cut_outside(std::vector<Piece>& pieces, const std::vector<Plane>& planes, int id, double thinnest, int& slivers,
                 const ProgressCallback& progress) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Plane& plane = planes[k];
        report_progress(progress, k, planes.size());
        const std::size_t count = pieces.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (pieces[i].inside) continue;
            Cut parts = cut(pieces[i].polyhedron, plane, id, thinnest);
            if (parts.outcome == CutOutcome::sliver) ++slivers;
            if (parts.outcome != CutOutcome::cut) continue;
            pieces[i].polyhedron = std::move(parts.below);
            pieces.push_back({std::move(parts.above), false});
        }
    }
}

} // namespace

CuttingPolygon cutting_polygon(const std::vector<Vec3>& polygon, std::size_t number) {
    const Vec3 area = area_vector(polygon);
    double size = 0;
    for (const Vec3& corner : polygon) size = std::max(size, (corner - polygon.front()).norm());
    constexpr double rounding = 1e-6;
    if (!(area.norm() > rounding * rounding * size * size))
        throw Diagnostic(fmt::format("polygon {} has no area", number + 1), "leave it out of the set");
    CuttingPolygon result{polygon, {area.normalized(), polygon.front()}};
    for (const Vec3& corner : polygon)
        if (std::abs(result.plane.distance(corner)) > rounding * size)
            throw Diagnostic(fmt::format("the corners of polygon {} do not lie in one plane", number + 1),
                             "divide it into triangles");
    return result;
}

std::vector<std::vector<Vec3>> sections_along(const std::vector<Vec3>& section, const std::vector<Vec3>& path) {
    if (path.size() < 2) throw Diagnostic("the path has less than two points", "give its begin, its turns and its end");
    std::vector<Vec3> directions;
    for (std::size_t k = 1; k < path.size(); ++k) {
        const Vec3 stretch = path[k] - path[k - 1];
        if (!(stretch.norm() > 0))
            throw Diagnostic(fmt::format("points {} and {} of the path are the same", k, k + 1),
                             "give each point once");
        directions.push_back(stretch.normalized());
    }
    std::vector<std::vector<Vec3>> sections{section};
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const Vec3& along = directions[k];
        const Vec3 normal = along + directions[std::min(k + 1, directions.size() - 1)];
        std::vector<Vec3> next;
        for (const Vec3& corner : sections.back()) {
            const double distance = normal.dot(path[k + 1] - corner) / normal.dot(along);
            if (!(distance > 0) || !std::isfinite(distance))
                throw Diagnostic(
                    fmt::format("the section does not get to point {} of the path: the turn is too sharp, or the "
                                "points are too near to each other",
                                k + 2),
                    "make the section smaller, or the turn in several steps");
            next.push_back(corner + distance * along);
        }
        sections.push_back(std::move(next));
    }
    return sections;
}

SidedBlocks cut_tunnel(const std::vector<Polyhedron>& blocks, const TunnelOutline& outline, double thinnest,
                       const ProgressCallback& progress) {
    const std::vector<std::vector<Plane>> parts = planes_of_parts(outline);
    const std::vector<Plane> radial = outline.radial ? radial_planes(outline) : std::vector<Plane>{};

    SidedBlocks result;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        std::vector<Piece> pieces{{blocks[block], false}};
        for (const auto& planes : parts) {
            report_progress(progress, block, blocks.size());
            std::vector<Piece> next;
            for (Piece& piece : pieces) {
                if (piece.inside) {
                    next.push_back(std::move(piece));
                    continue;
                }
                for (Piece& part : carve(piece.polyhedron, planes, outline.id, thinnest, result.blocks.slivers))
                    next.push_back(std::move(part));
            }
            pieces = std::move(next);
        }
        // Cuts between parts of the tunnel are removed where nothing else is cut.
        if (std::ranges::all_of(pieces, &Piece::inside)) pieces = {{blocks[block], true}};
        const bool is_cut = pieces.size() > 1;
        // Radial joints are for the rock around the hole only.
        const ProgressCallback of_block = [&](double done) { report_progress(progress, block, blocks.size(), done); };
        if (is_cut) cut_outside(pieces, radial, outline.id, thinnest, result.blocks.slivers, of_block);
        if (!is_cut) {
            if (pieces.front().inside) result.swallowed.push_back(static_cast<int>(block));
            continue;
        }
        result.blocks.parents.push_back(static_cast<int>(block));
        for (Piece& piece : pieces) {
            result.blocks.pieces.push_back({std::move(piece.polyhedron), static_cast<int>(block)});
            result.inside.push_back(piece.inside);
        }
    }
    return result;
}

CutBlocks densify(const std::vector<Polyhedron>& blocks, const std::array<int, 3>& parts, int id, double thinnest,
                  const ProgressCallback& progress) {
    for (const int n : parts)
        if (n < 1) throw Diagnostic(fmt::format("a block cannot be cut into {} parts", n), "give 1 or more");
    CutBlocks result;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        const auto [low, high] = box_around(blocks[block].vertices);
        std::vector<Piece> pieces{{blocks[block], false}};
        std::vector<Plane> planes;
        for (int k = 0; k < 3; ++k)
            for (int i = 1; i < parts[k]; ++i) {
                Plane plane{Vec3::Unit(k), low};
                plane.origin[k] += (high[k] - low[k]) * i / parts[k];
                planes.push_back(plane);
            }
        const ProgressCallback of_block = [&](double done) { report_progress(progress, block, blocks.size(), done); };
        cut_outside(pieces, planes, id, thinnest, result.slivers, of_block);
        if (pieces.size() == 1) continue;
        result.parents.push_back(static_cast<int>(block));
        for (Piece& piece : pieces) result.pieces.push_back({std::move(piece.polyhedron), static_cast<int>(block)});
    }
    return result;
}

CutBlocks cut_by_polygons(const std::vector<Polyhedron>& blocks, const std::vector<CuttingPolygon>& polygons, int id,
                          double thinnest, const ProgressCallback& progress) {
    constexpr std::size_t most_pieces = 5000000;
    constexpr double least = 1e-9; // of an area
    std::vector<double> areas;
    for (const CuttingPolygon& polygon : polygons) areas.push_back(area_vector(polygon.corners).norm());
    CutBlocks result;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        std::vector<Polyhedron> pieces{blocks[block]};
        for (std::size_t k = 0; k < polygons.size(); ++k) {
            report_progress(progress, block, blocks.size(),
                            static_cast<double>(k) / static_cast<double>(polygons.size()));
            const std::size_t count = pieces.size();
            for (std::size_t i = 0; i < count; ++i) {
                Cut parts = cut(pieces[i], polygons[k].plane, id, thinnest);
                if (parts.outcome == CutOutcome::sliver) ++result.slivers;
                if (parts.outcome != CutOutcome::cut) continue;
                const std::vector<Vec3> section = section_of(parts.below);
                const Vec3 area = area_vector(section);
                const std::vector<Vec3> common = common_part(polygons[k].corners, section, area);
                if (!(area_vector(common).norm() > least * std::min(areas[k], area.norm()))) continue;
                pieces[i] = std::move(parts.below);
                pieces.push_back(std::move(parts.above));
            }
        }
        if (pieces.size() == 1) continue;
        if (result.pieces.size() + pieces.size() > most_pieces)
            throw Diagnostic(fmt::format("the polygons would make more than {} blocks", most_pieces),
                             "give fewer polygons or a smaller range");
        result.parents.push_back(static_cast<int>(block));
        for (Polyhedron& piece : pieces) result.pieces.push_back({std::move(piece), static_cast<int>(block)});
    }
    return result;
}

} // namespace kaya
