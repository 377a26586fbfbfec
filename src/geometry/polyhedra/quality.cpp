#include "geometry/polyhedra/quality.hpp"

#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/convex_overlap.hpp"
#include "geometry/polyhedra/cut.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace kaya {
namespace {

struct Description {
    Ailment ailment;
    std::string_view name, remedy;
};
constexpr std::array descriptions{
    Description{Ailment::open, "open", "its faces do not close: delete it and make it again from whole faces"},
    Description{Ailment::inverted, "inverted", "its faces look inward: delete it and make it again"},
    Description{Ailment::concave, "concave", "contacts need convex blocks: make it of convex parts and join them"},
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
    // Each use of an edge counts 1 or -1 by its direction; a good edge has one of each.
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
        for (const int v : face.vertices) centre += polyhedron.vertices[v] / static_cast<double>(face.vertices.size());
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const Vec3 &a = polyhedron.vertices[face.vertices[i]],
                       &b = polyhedron.vertices[face.vertices[(i + 1) % face.vertices.size()]];
            twice_area += (a - centre).cross(b - centre);
            quality.shortest_edge = std::min(quality.shortest_edge, (b - a).norm());
            quality.longest_edge = std::max(quality.longest_edge, (b - a).norm());
        }
        quality.smallest_face = std::min(quality.smallest_face, twice_area.norm() / 2);
        const Vec3 normal = face_normal(polyhedron, face);
        for (const int v : face.vertices)
            quality.worst_warp = std::max(quality.worst_warp, std::abs(normal.dot(polyhedron.vertices[v] - centre)));
        for (const Vec3& v : polyhedron.vertices)
            quality.worst_bulge = std::max(quality.worst_bulge, normal.dot(v - centre));
    }
    if (polyhedron.faces.empty()) quality.shortest_edge = quality.smallest_face = 0;
}

Vec3 centre_of(const Polyhedron& polyhedron, const Polyhedron::Face& face) {
    Vec3 sum = Vec3::Zero();
    for (const int v : face.vertices) sum += polyhedron.vertices[v];
    return sum / static_cast<double>(face.vertices.size());
}

std::vector<Vec3> edges_of(const Polyhedron& polyhedron) {
    std::vector<Vec3> edges;
    for (const auto& face : polyhedron.faces)
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const int a = face.vertices[i], b = face.vertices[(i + 1) % face.vertices.size()];
            if (a < b) edges.push_back((polyhedron.vertices[b] - polyhedron.vertices[a]).normalized());
        }
    return edges;
}

/// Overlap of two convex blocks along a unit axis; negative when they are apart.
double depth_along(const Vec3& axis, const Polyhedron& a, const Polyhedron& b) {
    const auto span = [&](const Polyhedron& p) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& v : p.vertices) {
            low = std::min(low, axis.dot(v));
            high = std::max(high, axis.dot(v));
        }
        return std::pair(low, high);
    };
    const auto [a_low, a_high] = span(a);
    const auto [b_low, b_high] = span(b);
    return std::min(a_high - b_low, b_high - a_low);
}

/// The shortest translation that separates two convex blocks: along the normal of a face or across two edges. The search ends as soon as it
/// is below `enough`.
double depth_of_overlap(const Polyhedron& a, const Polyhedron& b, double enough) {
    double depth = std::numeric_limits<double>::infinity();
    for (const auto* p : {&a, &b})
        for (const auto& face : p->faces) {
            depth = std::min(depth, depth_along(face_normal(*p, face), a, b));
            if (depth < enough) return depth;
        }
    const auto others = edges_of(b);
    for (const Vec3& edge : edges_of(a))
        for (const Vec3& other : others) {
            const Vec3 axis = edge.cross(other);
            constexpr double parallel = 1e-6;
            if (axis.norm() < parallel) continue;
            depth = std::min(depth, depth_along(axis.normalized(), a, b));
            if (depth < enough) return depth;
        }
    return depth;
}

/// Volume of the part of `a` inside the convex `b`.
double common_volume(const Polyhedron& a, const Polyhedron& b) {
    ConvexClip part;
    for (const Vec3& v : a.vertices) part.add_vertex(v);
    for (const auto& face : a.faces) {
        part.begin_face();
        for (const int v : face.vertices) part.add_corner(v);
    }
    for (const auto& face : b.faces) {
        const Vec3 normal = face_normal(b, face);
        part.clip({normal, normal.dot(centre_of(b, face))}, FaceOrigin::clipper);
    }
    return moments_of(part).volume;
}

/// The common volume of two blocks over the volume of the smaller one. Where they only touch, rounding of the coordinates makes slivers
/// whose volume has no meaning: the depth bounds it.
double common_share(const Polyhedron& a, const Polyhedron& b, double smaller_volume) {
    constexpr double closed = 1e-6; // of the size of the smaller one
    const double extent = std::min(extent_of(a), extent_of(b));
    const double depth = depth_of_overlap(a, b, closed * extent);
    if (depth < closed * extent || !(smaller_volume > 0)) return 0;
    const double volume = std::min(common_volume(a, b), depth * extent * extent);
    return std::min(volume / smaller_volume, 1.0);
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

std::vector<Ailment> ailments_of(const BlockQuality& quality, double mean_volume, const QualityLimits& limits) {
    // For an open surface the other numbers have no meaning.
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
        boxes.push_back(box_around(block.vertices));
        volumes.push_back(mass_properties(block).volume);
    }
    std::vector<OverlappingBlocks> result;
    for (const auto& [later, earlier] : overlapping_boxes(boxes)) {
        const double part = common_share(blocks[earlier], blocks[later], std::min(volumes[earlier], volumes[later]));
        if (part > share) result.push_back({earlier, later, part});
    }
    std::sort(result.begin(), result.end(), [](const OverlappingBlocks& a, const OverlappingBlocks& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    return result;
}

} // namespace kaya
