#include "geometry/quality.hpp"

#include "geometry/box_pairs.hpp"
#include "geometry/cut.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace kaya {
namespace {

struct Description {
    Ailment ailment;
    std::string_view name, remedy;
};
constexpr std::array descriptions{
    Description{Ailment::open, "open",
                "its faces do not close: delete it and make it again from whole faces"},
    Description{Ailment::inverted, "inverted", "its faces look inward: delete it and make it again"},
    Description{Ailment::concave, "concave",
                "contacts need convex blocks: make it of convex parts and join them"},
    Description{Ailment::warped, "warped", "a face is not flat: correct its corners or make triangles of it"},
    Description{Ailment::tiny, "tiny",
                "its small mass shortens the time step: delete it or leave out the joint "
                "that cut it off"},
    Description{Ailment::needle, "needle",
                "long and slender blocks spin and shorten the time step: delete it or "
                "join it to a neighbour"},
    Description{Ailment::thin, "thin",
                "a plate is easily overlapped through its whole thickness: delete it, join it to "
                "a neighbour, or leave out one of two joints that lie close together"},
    Description{Ailment::short_edge, "short edge",
                "zones along it will be small and shorten the time step: move a joint "
                "so that corners meet or keep apart"},
};

const Description& description_of(Ailment ailment) {
    return *std::find_if(descriptions.begin(), descriptions.end(),
                         [ailment](const Description& d) { return d.ailment == ailment; });
}

int open_edges(const Polyhedron& polyhedron) {
    // Each use of an edge counts 1 or -1 by its way; a good edge has one of each.
    std::map<std::array<int, 2>, std::array<int, 2>> uses;
    for (const auto& face : polyhedron.faces)
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const int a = face.vertices[i], b = face.vertices[(i + 1) % face.vertices.size()];
            ++uses[{std::min(a, b), std::max(a, b)}][a < b];
        }
    return static_cast<int>(std::count_if(uses.begin(), uses.end(), [](const auto& use) {
        return use.second != std::array{1, 1};
    }));
}

double extent_of(const Polyhedron& polyhedron) {
    double extent = 0;
    for (const Vec3& a : polyhedron.vertices)
        for (const Vec3& b : polyhedron.vertices) extent = std::max(extent, (b - a).norm());
    return extent;
}

/// The middle edge of the brick that has the same second moments.
double middle_edge(const MassProperties& mass) {
    if (mass.volume == 0) return 0;
    const Mat3 spread = (0.5 * mass.inertia.trace() * Mat3::Identity() - mass.inertia) / mass.volume;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread, Eigen::EigenvaluesOnly);
    return std::sqrt(12 * std::max(0.0, solver.eigenvalues()[1]));
}

void measure_faces(const Polyhedron& polyhedron, BlockQuality& quality) {
    quality.shortest_edge = quality.smallest_face = std::numeric_limits<double>::infinity();
    for (const auto& face : polyhedron.faces) {
        Vec3 centre = Vec3::Zero(), twice_area = Vec3::Zero();
        for (const int v : face.vertices)
            centre += polyhedron.vertices[v] / static_cast<double>(face.vertices.size());
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const Vec3 &a = polyhedron.vertices[face.vertices[i]],
                       &b = polyhedron.vertices[face.vertices[(i + 1) % face.vertices.size()]];
            twice_area += (a - centre).cross(b - centre);
            quality.shortest_edge = std::min(quality.shortest_edge, (b - a).norm());
        }
        quality.smallest_face = std::min(quality.smallest_face, twice_area.norm() / 2);
        const Vec3 normal = face_normal(polyhedron, face);
        for (const int v : face.vertices)
            quality.worst_warp =
                std::max(quality.worst_warp, std::abs(normal.dot(polyhedron.vertices[v] - centre)));
        for (const Vec3& v : polyhedron.vertices)
            quality.worst_bulge = std::max(quality.worst_bulge, normal.dot(v - centre));
    }
    if (polyhedron.faces.empty()) quality.shortest_edge = quality.smallest_face = 0;
}

/// The part of `a` inside `b`; nothing when they only touch.
std::optional<Polyhedron> common_part(const Polyhedron& a, const Polyhedron& b) {
    Polyhedron left = a;
    for (const auto& face : b.faces) {
        Cut parts = cut(left, {face_normal(b, face), b.vertices[face.vertices[0]]}, 0);
        if (parts.outcome == CutOutcome::above) return std::nullopt;
        if (parts.outcome == CutOutcome::cut) left = std::move(parts.below);
    }
    return left;
}

} // namespace

BlockQuality block_quality(const Polyhedron& polyhedron) {
    BlockQuality quality;
    const MassProperties mass = mass_properties(polyhedron);
    quality.volume = mass.volume;
    quality.extent = extent_of(polyhedron);
    quality.width = middle_edge(mass);
    quality.thickness = thickness(polyhedron);
    quality.open_edges = open_edges(polyhedron);
    measure_faces(polyhedron, quality);
    return quality;
}

std::string_view name_of(Ailment ailment) { return description_of(ailment).name; }

std::string_view remedy_for(Ailment ailment) { return description_of(ailment).remedy; }

std::vector<Ailment> ailments_of(const BlockQuality& quality, double mean_volume,
                                 const QualityLimits& limits) {
    // The other numbers of a surface without an inside mean nothing.
    if (quality.open_edges > 0) return {Ailment::open};
    if (quality.volume <= 0) return {Ailment::inverted};
    std::vector<Ailment> found;
    const auto note = [&found](Ailment ailment, bool present) {
        if (present) found.push_back(ailment);
    };
    const bool needle = quality.width < limits.needle * quality.extent;
    note(Ailment::concave, quality.worst_bulge > limits.bulge * quality.extent);
    note(Ailment::warped, quality.worst_warp > limits.warp * quality.extent);
    note(Ailment::tiny, quality.volume < limits.tiny * mean_volume);
    note(Ailment::needle, needle);
    note(Ailment::thin, !needle && quality.thickness < limits.thin * quality.extent);
    note(Ailment::short_edge, quality.shortest_edge < limits.edge * quality.extent);
    return found;
}

std::vector<OverlappingBlocks> overlapping_blocks(const std::vector<Polyhedron>& blocks, double share) {
    std::vector<Box> boxes;
    std::vector<double> volumes;
    for (const Polyhedron& block : blocks) {
        Box box{block.vertices.front(), block.vertices.front()};
        for (const Vec3& v : block.vertices) {
            box.low = box.low.cwiseMin(v);
            box.high = box.high.cwiseMax(v);
        }
        boxes.push_back(box);
        volumes.push_back(mass_properties(block).volume);
    }
    std::vector<OverlappingBlocks> result;
    for (const auto& [later, earlier] : overlapping_boxes(boxes)) {
        const auto common = common_part(blocks[earlier], blocks[later]);
        if (!common) continue;
        const double part = mass_properties(*common).volume / std::min(volumes[earlier], volumes[later]);
        if (part > share) result.push_back({earlier, later, part});
    }
    std::sort(result.begin(), result.end(), [](const OverlappingBlocks& a, const OverlappingBlocks& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    return result;
}

} // namespace kaya
