// Each block is divided by the planes of the triangles in it until none is left in a piece (space_partition.hpp); the side of a piece follows from
// the number of turns that the surface makes around its centre, which jumps by one across the surface. For an open surface the turns are
// fractions (Jacobson, Kavan and Sorkine-Hornung 2013), of either sign on its two sides.
#include "geometry/surface/surface_cuts.hpp"

#include "base/diagnostic.hpp"
#include "base/number_text.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/surface/space_partition.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

/// Of the size of a block: what is nearer to a plane lies in it.
constexpr double rounding = 1e-9;

Vec3 area_of(const std::array<Vec3, 3>& triangle) {
    return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]) / 2;
}

/// Whether the normal points up, or along x or y where it has no part along z.
bool points_up(const Vec3& normal) {
    for (const int axis : {2, 0, 1})
        if (std::abs(normal[axis]) > 1e-9 * normal.norm()) return normal[axis] > 0;
    return true;
}

class SurfaceCutter {
public:
    SurfaceCutter(const CuttingSurface& surface, int id, double thinnest, SidedBlocks& result)
        : surface_(surface), id_(id), thinnest_(thinnest), result_(result) {
        for (const auto& [a, b, c] : surface.triangles) boxes_.push_back(box_around({a, b, c}));
    }

    void cut_block(const Polyhedron& block, int number) {
        Cell whole{block, fragments_in(block)};
        if (whole.fragments.empty()) {
            if (!is_open() && is_inside(mean_of(block.vertices))) result_.swallowed.push_back(number);
            return;
        }
        if (is_open()) check_open(block, whole.fragments);
        const std::vector<Piece> pieces = pieces_of(std::move(whole));
        const bool side = pieces.front().inside;
        if (std::ranges::all_of(pieces, [side](const Piece& piece) { return piece.inside == side; })) {
            if (side && !is_open()) result_.swallowed.push_back(number);
            return;
        }
        constexpr std::size_t most_pieces = 5000000;
        if (result_.inside.size() + pieces.size() > most_pieces)
            throw Diagnostic(fmt::format("the surface would make more than {} blocks", most_pieces),
                             "simplify it, or give a smaller range");
        result_.blocks.parents.push_back(number);
        for (const bool inside : {true, false})
            for (const Piece& piece : pieces) {
                if (piece.inside != inside) continue;
                result_.blocks.pieces.push_back({piece.polyhedron, number});
                result_.inside.push_back(inside);
            }
    }

private:
    struct Piece {
        Polyhedron polyhedron;
        bool inside;
    };

    bool is_open() const { return !surface_.rim.empty(); }

    double turns_around(const Vec3& point) const {
        double turns = 0;
        for (const auto& triangle : surface_.triangles) turns += part_of_turn(triangle, point);
        return turns;
    }
    bool is_inside(const Vec3& point) const { return turns_around(point) > (is_open() ? 0 : 0.5); }

    /// The parts of the triangles inside of the block; what lies in its faces does not count.
    std::vector<Fragment> fragments_in(const Polyhedron& block) const {
        const Box box = box_around(block.vertices);
        const double near = rounding * (box.high - box.low).norm();
        const std::vector<Plane> planes = outer_planes(block);
        std::vector<Fragment> fragments;
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            if ((boxes_[i].low.array() > box.high.array()).any() || (boxes_[i].high.array() < box.low.array()).any())
                continue;
            const auto& triangle = surface_.triangles[i];
            std::vector<Vec3> part(triangle.begin(), triangle.end());
            const bool within = std::ranges::all_of(planes, [&](const Plane& plane) {
                part = clip(part, plane, -1);
                return std::ranges::any_of(part, [&](const Vec3& v) { return plane.distance(v) < -near; });
            });
            if (within && area_vector(part).norm() > near * near)
                fragments.push_back({std::move(part), {area_of(triangle).normalized(), triangle[0]}, i});
        }
        return fragments;
    }

    void check_open(const Polyhedron& block, const std::vector<Fragment>& fragments) const {
        const std::vector<Plane> planes = outer_planes(block);
        const double near = 1e3 * rounding * size_of(block.vertices);
        for (const auto& [a, b] : surface_.rim) {
            double from = 0, to = 1; // of the edge: where it is inside of the block
            for (const Plane& plane : planes) {
                const double at_a = plane.distance(a) + near, at_b = plane.distance(b) + near;
                if (at_a >= 0 && at_b >= 0) to = -1;
                else if (at_a > 0) from = std::max(from, at_a / (at_a - at_b));
                else if (at_b > 0) to = std::min(to, at_a / (at_a - at_b));
            }
            if (from >= to) continue;
            const Vec3 place = a + (from + to) / 2 * (b - a);
            throw Diagnostic(
                "the surface ends inside of a block, at " + place_text(place),
                "continue it beyond the blocks, give a range, or use a network of fractures: cut dfn ... limited");
        }
        for (const Fragment& fragment : fragments) {
            const Vec3 place = mean_of(fragment.corners);
            double turns = 0; // of the others; the triangle itself adds a half on one side, and takes it on the other
            for (std::size_t i = 0; i < surface_.triangles.size(); ++i)
                if (i != fragment.face) turns += part_of_turn(surface_.triangles[i], place);
            if (std::abs(turns) < 0.5) continue;
            throw Diagnostic("the surface winds about itself at " + place_text(place) +
                                 ": its two sides are not distinct",
                             "give it in parts, in several files");
        }
    }

    std::vector<Piece> pieces_of(Cell&& whole) {
        const double near = rounding * size_of(whole.space.vertices);
        std::vector<Piece> pieces;
        std::vector<Cell> waiting;
        waiting.push_back(std::move(whole));
        while (!waiting.empty()) {
            Cell cell = std::move(waiting.back());
            waiting.pop_back();
            if (cell.fragments.empty()) {
                const bool inside = is_inside(mass_properties(cell.space).centroid);
                pieces.push_back({std::move(cell.space), inside});
                continue;
            }
            const Plane plane = best_planes(cell.fragments, near).front();
            Sides sides = sort_sides(cell.fragments, plane, near);
            Cut parts = cut(cell.space, plane, id_, thinnest_);
            if (parts.outcome == CutOutcome::cut) {
                waiting.push_back({std::move(parts.below), std::move(sides.back)});
                waiting.push_back({std::move(parts.above), std::move(sides.front)});
                continue;
            }
            if (parts.outcome == CutOutcome::sliver) ++result_.blocks.slivers;
            // Whole: what the plane has not used up still divides it.
            std::ranges::move(sides.back, std::back_inserter(sides.front));
            waiting.push_back({std::move(cell.space), std::move(sides.front)});
        }
        return pieces;
    }

    const CuttingSurface& surface_;
    std::vector<Box> boxes_;
    int id_;
    double thinnest_;
    SidedBlocks& result_;
};

} // namespace

CuttingSurface cutting_surface(std::vector<Surface> bodies, std::vector<Surface> cavities) {
    CuttingSurface result;
    const auto add = [&](const Surface& surface, bool backwards) {
        for (auto [a, b, c] : triangles_of(surface)) {
            if (backwards) std::swap(b, c);
            if (area_of({a, b, c}).norm() > 0) result.triangles.push_back({a, b, c});
        }
    };
    const auto open = std::ranges::count_if(bodies, [](const Surface& surface) { return !is_closed(surface); });
    if (open == 1 && bodies.size() == 1 && cavities.empty()) {
        result.rim = turn_open_alike(bodies.front());
        Vec3 area = Vec3::Zero();
        for (const auto& triangle : triangles_of(bodies.front())) area += area_of(triangle);
        add(bodies.front(), !points_up(area));
    } else if (open > 0) {
        throw Diagnostic(fmt::format("{} of {} surfaces of the file are open", open, bodies.size() + cavities.size()),
                         "give one open surface, or closed ones only: one file for each cut");
    } else {
        for (Surface& body : bodies) {
            turn_alike(body);
            turn_outward(body);
            add(body, false);
        }
        for (Surface& cavity : cavities) {
            turn_alike(cavity);
            turn_outward(cavity);
            add(cavity, true);
        }
    }
    if (result.triangles.empty()) throw Diagnostic("the surface has no area");
    return result;
}

SidedBlocks cut_by_surface(const std::vector<Polyhedron>& blocks, const CuttingSurface& surface, int id,
                           double thinnest, const ProgressCallback& progress) {
    SidedBlocks result;
    SurfaceCutter cutter(surface, id, thinnest, result);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        report_progress(progress, block, blocks.size());
        cutter.cut_block(blocks[block], static_cast<int>(block));
    }
    return result;
}

} // namespace kaya
