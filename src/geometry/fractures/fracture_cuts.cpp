#include "geometry/fractures/fracture_cuts.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>

namespace kaya {
namespace {

/// Smaller common areas, in parts of the smaller of the two, are touches.
constexpr double least_area = 1e-9;

bool overlap(const Box& a, const Box& b) {
    return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

struct CuttingFracture {
    Fracture exact, shape; ///< the shape of a limited disc is the polygon that stands for it
    Plane plane;
    Box box;
    double area;
    std::vector<Plane> sides; ///< through the sides of a limited fracture, outward
};

CuttingFracture cutting(const Fracture& fracture, const FractureCutting& how) {
    CuttingFracture result{fracture, fracture, plane_of(fracture), box_of(fracture), area_of(fracture), {}};
    if (!how.limited) return result;
    result.shape.corners = outline_of(fracture, how.sides);
    const Box around = box_of(result.shape);
    result.box = {result.box.low.cwiseMin(around.low), result.box.high.cwiseMax(around.high)};
    const auto& corners = result.shape.corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 side = corners[(i + 1) % corners.size()] - corners[i];
        result.sides.push_back({side.cross(result.plane.normal).normalized(), corners[i]});
    }
    return result;
}

/// The pieces of one block.
class FracturedBlock {
public:
    FracturedBlock(const Polyhedron& block, const FractureCutting& how, Random random, FractureCuts& result)
        : how_(how), random_(random), result_(result) {
        add(block);
    }

    void cut_by(const CuttingFracture& cutter) {
        const std::size_t count = pieces_.size();
        for (std::size_t i = 0; i < count; ++i)
            if (overlap(boxes_[i], cutter.box)) cut_piece(i, cutter);
    }

    const std::vector<Polyhedron>& all() const { return pieces_; }

private:
    Cut attempt(const Polyhedron& piece, const Plane& plane, int joint_set) {
        Cut parts = cut(piece, plane, joint_set, how_.thinnest, how_.nearest);
        if (parts.outcome == CutOutcome::sliver) ++result_.blocks.slivers;
        if (parts.outcome == CutOutcome::corner) ++result_.blocks.corners;
        return parts;
    }

    void cut_piece(std::size_t i, const CuttingFracture& cutter) {
        // Without limits first: what is refused counts where the fracture reaches the piece only.
        Cut parts = cut(pieces_[i], cutter.plane, cutter.shape.joint_set);
        if (parts.outcome != CutOutcome::cut) return;
        const std::vector<Vec3> section = section_of(parts.below);
        const double area = area_vector(section).norm();
        if (!(area_within(cutter.shape, section) > least_area * std::min(cutter.area, area))) return;
        if (how_.persistence < 1 && random_.uniform() >= how_.persistence) return;
        std::vector<Polyhedron> beyond;
        Polyhedron inner = pieces_[i];
        if (how_.limited && !cut_beyond(inner, cutter, section, beyond)) return;
        parts = attempt(inner, cutter.plane, cutter.shape.joint_set);
        if (parts.outcome != CutOutcome::cut) return;
        parts.above.faces.back().open = parts.below.faces.back().open = how_.limited;
        result_.of_joints += area_vector(section_of(parts.below)).norm();
        replace(i, std::move(parts.below));
        add(std::move(parts.above));
        for (Polyhedron& piece : beyond) add(std::move(piece));
    }

    /// Cuts off what lies beyond the sides of the fracture. False: nothing is left between them.
    bool cut_beyond(Polyhedron& inner, const CuttingFracture& cutter, std::vector<Vec3> section,
                    std::vector<Polyhedron>& beyond) {
        constexpr double nothing = 1e-12; // of the area
        for (const Plane& side : cutter.sides) {
            std::vector<Vec3> rest = part_below(section, side);
            if (rest.size() < 3) return false;
            if (area_vector(rest).norm() >= (1 - nothing) * area_vector(section).norm()) continue;
            Cut around = attempt(inner, side, 0);
            if (around.outcome != CutOutcome::cut) continue;
            beyond.push_back(std::move(around.above));
            inner = std::move(around.below);
            section = std::move(rest);
        }
        return true;
    }

    void add(Polyhedron piece) {
        boxes_.push_back(box_around(piece.vertices));
        pieces_.push_back(std::move(piece));
    }
    void replace(std::size_t i, Polyhedron piece) {
        boxes_[i] = box_around(piece.vertices);
        pieces_[i] = std::move(piece);
    }

    const FractureCutting& how_;
    Random random_;
    FractureCuts& result_;
    std::vector<Polyhedron> pieces_;
    std::vector<Box> boxes_;
};

/// Area of a fracture inside of a block.
double area_in_block(const Polyhedron& block, const CuttingFracture& cutter) {
    const Cut parts = cut(block, cutter.plane, 0);
    return parts.outcome == CutOutcome::cut ? area_within(cutter.exact, section_of(parts.below)) : 0;
}

} // namespace

FractureCuts cut_by_fractures(const std::vector<Polyhedron>& blocks, const std::vector<Fracture>& fractures,
                              const FractureCutting& how, const ProgressCallback& progress) {
    constexpr std::size_t most_pieces = 5'000'000;
    std::vector<CuttingFracture> cutters;
    for (const Fracture& fracture : fractures) cutters.push_back(cutting(fracture, how));
    FractureCuts result;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        const Box around = box_around(blocks[block].vertices);
        FracturedBlock pieces(blocks[block], how, Random(how.seed, block + 1), result);
        for (std::size_t k = 0; k < cutters.size(); ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(cutters.size());
            report_progress(progress, block, blocks.size(), part * part);
            if (!overlap(around, cutters[k].box)) continue;
            result.of_fractures += area_in_block(blocks[block], cutters[k]);
            pieces.cut_by(cutters[k]);
            if (result.blocks.pieces.size() + pieces.all().size() > most_pieces)
                throw Diagnostic(fmt::format("the fractures would make more than {} blocks", most_pieces),
                                 "give fewer or larger fractures, or a smaller range");
        }
        if (pieces.all().size() == 1) continue;
        result.blocks.parents.push_back(static_cast<int>(block));
        for (const Polyhedron& piece : pieces.all()) result.blocks.pieces.push_back({piece, static_cast<int>(block)});
    }
    return result;
}

} // namespace kaya
