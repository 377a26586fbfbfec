#include "geometry/surface/joint_set.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/random.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {
namespace {

void check(const JointSet& set) {
    struct Entry {
        const char* name;
        double value, least, greatest;
    };
    constexpr double any = 1e300;
    const std::array entries{
        Entry{"dip", set.dip, -any, any},
        Entry{"dip deviation", set.dip_deviation, 0, any},
        Entry{"dip direction", set.dip_direction, -any, any},
        Entry{"dip direction deviation", set.dip_direction_deviation, 0, any},
        Entry{"spacing", set.spacing, 0, any},
        Entry{"spacing deviation", set.spacing_deviation, 0, any},
        Entry{"number", static_cast<double>(set.number), 1, any},
        Entry{"origin's x", set.origin.x(), -any, any},
        Entry{"origin's y", set.origin.y(), -any, any},
        Entry{"origin's z", set.origin.z(), -any, any},
        Entry{"tolerance", set.tolerance, 0, any},
        Entry{"persistence", set.persistence, 0, 1},
    };
    for (const Entry& entry : entries) {
        if (entry.value >= entry.least && entry.value <= entry.greatest) continue;
        if (!std::isfinite(entry.value))
            throw Diagnostic(fmt::format("the joint set's {} is not a finite number", entry.name));
        const bool low = entry.value < entry.least;
        throw Diagnostic(fmt::format("the joint set's {} is {}, {} than {}", entry.name, entry.value,
                                     low ? "less" : "more", low ? entry.least : entry.greatest));
    }
    if (set.number > 1 && set.spacing == 0)
        throw Diagnostic(fmt::format("{} joints need a spacing, and it is 0", set.number),
                         "give a spacing above 0, or number 1");
}

/// Cuts the one block in `pieces` by all planes and counts the cuts that were refused. `progress` gets the fraction of this
/// block.
void cut_block(std::vector<Polyhedron>& pieces, const std::vector<Plane>& planes, const JointSet& set, double thinnest,
               Random random, CutBlocks& result, const ProgressCallback& progress) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Plane& plane = planes[k];
        const std::size_t count = pieces.size();
        // The more pieces there are, the longer a plane takes.
        const double part = static_cast<double>(k) / static_cast<double>(planes.size());
        if (progress) progress(part * part);
        for (std::size_t i = 0; i < count; ++i) {
            Cut parts = cut(pieces[i], plane, set.id, thinnest, set.tolerance);
            if (parts.outcome == CutOutcome::sliver) ++result.slivers;
            if (parts.outcome == CutOutcome::corner) ++result.corners;
            if (parts.outcome != CutOutcome::cut) continue;
            if (set.persistence < 1 && random.uniform() >= set.persistence) continue;
            pieces[i] = std::move(parts.below);
            pieces.push_back(std::move(parts.above));
        }
    }
}

/// The planes that come near any of the blocks: those that cross the ball around all of them.
std::vector<Plane> planes_through(const std::vector<Polyhedron>& blocks, std::vector<Plane> planes) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Polyhedron& block : blocks)
        for (const Vec3& v : block.vertices) {
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
    const Vec3 centre = 0.5 * (low + high);
    const double reach = 0.5 * (high - low).norm() * (1 + 1e-9);
    std::erase_if(planes, [&](const Plane& plane) { return !(std::abs(plane.distance(centre)) <= reach); });
    return planes;
}

} // namespace

std::vector<Plane> joint_planes(const JointSet& set) {
    check(set);
    const Vec3 mean_normal = normal_from_dip(set.dip, set.dip_direction);
    Random random(set.seed, static_cast<std::uint64_t>(set.id));
    std::vector<Plane> planes;
    planes.reserve(static_cast<std::size_t>(set.number));
    for (int i = 0; i < set.number; ++i) {
        // Always three numbers per joint, so that a deviation of 0 in one quantity does not change
        // the scatter of the others.
        const double dip_scatter = set.dip_deviation * random.symmetric();
        const double direction_scatter = set.dip_direction_deviation * random.symmetric();
        const double place_scatter = set.spacing_deviation * random.symmetric();
        const int step = i % 2 ? (i + 1) / 2 : -(i / 2);
        // The first joint passes through the origin whatever the scatter.
        const double place = step * set.spacing + (i ? place_scatter : 0);
        Plane plane;
        plane.normal = normal_from_dip(set.dip + dip_scatter, set.dip_direction + direction_scatter);
        plane.origin = set.origin + place * mean_normal;
        planes.push_back(plane);
    }
    return planes;
}

CutBlocks cut_blocks(const std::vector<Polyhedron>& blocks, const JointSet& set, double thinnest,
                     const ProgressCallback& progress) {
    // Far more than any present model can run with; larger numbers are typing errors and would fill the memory.
    constexpr std::size_t most_planes = 20000, most_pieces = 5000000;
    const std::vector<Plane> planes = planes_through(blocks, joint_planes(set));
    if (planes.size() > most_planes)
        throw Diagnostic(fmt::format("{} joints of the set cross the blocks, more than {}", planes.size(), most_planes),
                         "give a larger spacing or fewer joints");
    CutBlocks result;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        std::vector<Polyhedron> pieces{blocks[block]};
        // Streams of blocks lie above the one that scatters the planes.
        const std::uint64_t stream = (static_cast<std::uint64_t>(block + 1) << 32) + static_cast<std::uint64_t>(set.id);
        cut_block(pieces, planes, set, thinnest, Random(set.seed, stream), result,
                  [&](double done) { report_progress(progress, block, blocks.size(), done); });
        if (pieces.size() == 1) continue;
        if (result.pieces.size() + pieces.size() > most_pieces)
            throw Diagnostic(fmt::format("the joint set would make more than {} blocks", most_pieces),
                             "give a larger spacing or fewer joints");
        result.parents.push_back(static_cast<int>(block));
        for (Polyhedron& piece : pieces) result.pieces.push_back({std::move(piece), static_cast<int>(block)});
    }
    return result;
}

} // namespace kaya
