#include "geometry/surface/shapes.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {
namespace {

/// Corners closer than this share of the size are one corner; decks have 7 digits or more.
constexpr double same_corner = 1e-7;

void need_positive(double value, const char* what) {
    if (!(value > 0) || !std::isfinite(value))
        throw Diagnostic(fmt::format("the {} is {}, and must be above 0", what, value));
}

void need_at_least(int value, int least, const char* what) {
    if (value < least) throw Diagnostic(fmt::format("the number of {} is {}, less than {}", what, value, least));
}

double size_of_loops(const std::vector<std::vector<Vec3>>& loops) {
    std::vector<Vec3> all;
    for (const auto& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    return size_of(all);
}

/// One convex polyhedron from valid faces.
Polyhedron single(const std::vector<std::vector<Vec3>>& loops) { return make_from_faces(loops).parts.front(); }

/// Place around a square of half width 1, from its right side anticlockwise; `step` counts `count` steps per
/// eighth of a turn, equal lengths along the sides.
Eigen::Vector2d on_square(int step, int count) {
    const int side = ((step + count) / (2 * count)) % 4;
    const double along = static_cast<double>((step + count) % (2 * count)) / count - 1;
    switch (side) {
    case 0: return {1, along};
    case 1: return {-along, 1};
    case 2: return {-1, -along};
    default: return {along, -1};
    }
}

/// Fractions of the distance from the wall to the outline at which rings begin: 0, ..., 1.
std::vector<double> ring_shares(int rings, double ratio) {
    std::vector<double> shares{0};
    double thickness = 1;
    for (int i = 0; i < rings; ++i, thickness *= ratio) shares.push_back(shares.back() + thickness);
    const double sum = shares.back();
    for (double& share : shares) share /= sum;
    return shares;
}

} // namespace

Solid make_prism(const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
    if (first.size() != second.size())
        throw Diagnostic(
            fmt::format("the prism's first polygon has {} corners and the second {}", first.size(), second.size()),
            "give the same number of corners, each opposite its partner");
    if (first.size() < 3)
        throw Diagnostic(fmt::format("the prism's polygons have {} corners", first.size()), "at least three");
    std::vector<std::vector<Vec3>> loops{first, second};
    const std::size_t count = first.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        loops.push_back({first[i], first[next], second[next], second[i]});
    }
    const double size = size_of_loops(loops);
    Surface surface = surface_from_loops(loops, same_corner * size);
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        surface.faces[f].name = f == 0   ? "the prism's first polygon"
                                : f == 1 ? "the prism's second polygon"
                                         : fmt::format("the prism's side {}", f - 1);
    for (std::size_t f = 0; f < 2; ++f)
        if (const double off = warp(surface, surface.faces[f]); off > Flatness{}.mended * size)
            throw Diagnostic(fmt::format("{} is not flat: its corners lie up to {:.3g} off its mean plane",
                                         surface.faces[f].name, off),
                             "correct the corners, or make two prisms");
    // Where both polygons share an edge the side between them has no area.
    std::erase_if(surface.faces, [](const Surface::Face& face) {
        std::vector<int> corners = face.vertices;
        std::sort(corners.begin(), corners.end());
        return std::unique(corners.begin(), corners.end()) - corners.begin() < 3;
    });
    return solid_from_surface(surface, {Flatness{}.mended, true});
}

Solid make_from_faces(const std::vector<std::vector<Vec3>>& loops, const std::vector<int>& joint_sets,
                      const Flatness& flatness) {
    Surface surface = surface_from_loops(loops, same_corner * size_of_loops(loops));
    for (std::size_t f = 0; f < std::min(joint_sets.size(), surface.faces.size()); ++f)
        surface.faces[f].joint_set = joint_sets[f];
    return solid_from_surface(surface, flatness);
}

Polyhedron make_tetrahedron(const std::array<Vec3, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const double size = size_of({a, b, c, d});
    if (!std::isfinite(size)) throw Diagnostic("the tetrahedron has a coordinate that is not a finite number");
    if (std::abs((b - a).cross(c - a).dot(d - a)) <= 1e-12 * size * size * size)
        throw Diagnostic("the four corners of the tetrahedron lie in one plane",
                         "move one of them out of the plane of the others");
    return single({{a, b, c}, {a, b, d}, {b, c, d}, {c, a, d}});
}

Polyhedron make_cube(const Vec3& centre, double edge) {
    need_positive(edge, "cube's edge");
    return make_brick(centre - Vec3::Constant(edge / 2), centre + Vec3::Constant(edge / 2));
}

Polyhedron make_drum(const Drum& drum) {
    need_at_least(drum.sides, 3, "sides of the drum");
    if (!(drum.radius1 >= 0) || !(drum.radius2 >= 0) || !std::isfinite(drum.radius1 + drum.radius2))
        throw Diagnostic(
            fmt::format("the drum's radii are {} and {}, and must not be below 0", drum.radius1, drum.radius2));
    need_positive(std::max(drum.radius1, drum.radius2), "larger radius of the drum");
    const Vec3 axis = drum.end2 - drum.end1;
    need_positive(axis.norm(), "length of the drum");
    // The first corner points sideways, so that a lying drum has one level corner; an upright one to the
    // east.
    const Vec3 level = axis.cross(Vec3::UnitZ());
    const Vec3 across = level.norm() > 1e-9 * axis.norm() ? Vec3(level.normalized()) : Vec3(Vec3::UnitX());
    const Vec3 up = axis.normalized().cross(across);
    std::vector<Vec3> ring1, ring2;
    for (int i = 0; i < drum.sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / drum.sides;
        const Vec3 arm = std::cos(angle) * across + std::sin(angle) * up;
        ring1.push_back(drum.end1 + drum.radius1 * arm);
        ring2.push_back(drum.end2 + drum.radius2 * arm);
    }
    std::vector<std::vector<Vec3>> loops;
    if (drum.radius1 > 0) loops.push_back(ring1);
    if (drum.radius2 > 0) loops.push_back(ring2);
    for (int i = 0; i < drum.sides; ++i) {
        const int next = (i + 1) % drum.sides;
        if (drum.radius1 == 0) loops.push_back({drum.end1, ring2[next], ring2[i]});
        else if (drum.radius2 == 0) loops.push_back({ring1[i], ring1[next], drum.end2});
        else loops.push_back({ring1[i], ring1[next], ring2[next], ring2[i]});
    }
    return single(loops);
}

namespace {

/// Corners of a tunnel's blocks, in rings from the wall (0) to the outline, steps around the axis and slices along it.
class TunnelGrid {
public:
    explicit TunnelGrid(const TunnelBlocks& tunnel) : tunnel_(tunnel), steps_(8 * tunnel.tangential) {
        need_positive(tunnel.radius, "tunnel's radius");
        need_positive(tunnel.boundary, "distance from the tunnel's wall to the outline");
        need_positive(tunnel.ratio, "ratio of ring thicknesses");
        need_positive(std::abs(tunnel.end - tunnel.begin), "tunnel's length");
        need_at_least(tunnel.radial, 1, "blocks along the radius");
        need_at_least(tunnel.tangential, 1, "blocks around 45 degrees");
        need_at_least(tunnel.axial, 1, "blocks along the axis");
        constexpr double most_blocks = 5e6;
        if (const double count = 8.0 * tunnel.tangential * tunnel.radial * tunnel.axial; count > most_blocks)
            throw Diagnostic(fmt::format("this would make {:g} blocks, more than {:g}", count, most_blocks),
                             "there are 8 times tangential in each ring, and radial times axial rings");
        const double degree = std::numbers::pi / 180;
        const Vec3 level(std::sin(tunnel.dip_direction * degree), std::cos(tunnel.dip_direction * degree), 0);
        axis_ = std::cos(tunnel.dip * degree) * level - std::sin(tunnel.dip * degree) * Vec3::UnitZ();
        across_ = level.cross(Vec3::UnitZ());
        up_ = across_.cross(axis_);
        shares_ = ring_shares(tunnel.radial, tunnel.ratio);
    }

    int steps() const { return steps_; }
    Vec3 corner(int ring, int step, int slice) const {
        step %= steps_;
        const double angle = 2 * std::numbers::pi * step / steps_;
        const double outline = tunnel_.radius * (1 + tunnel_.boundary);
        const Eigen::Vector2d inner = tunnel_.radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        const Eigen::Vector2d outer = outline * on_square(step, tunnel_.tangential);
        const Eigen::Vector2d p = inner + shares_[ring] * (outer - inner);
        const double along = tunnel_.begin + (tunnel_.end - tunnel_.begin) * slice / tunnel_.axial;
        return tunnel_.origin + p.x() * across_ + p.y() * up_ + along * axis_;
    }

private:
    const TunnelBlocks& tunnel_;
    int steps_;
    Vec3 axis_, across_, up_;
    std::vector<double> shares_;
};

void append_prism(std::vector<Polyhedron>& blocks, const std::array<std::vector<Vec3>, 2>& ends) {
    const Solid solid = make_prism(ends[0], ends[1]);
    blocks.insert(blocks.end(), solid.parts.begin(), solid.parts.end());
}

} // namespace

std::vector<Polyhedron> make_tunnel(const TunnelBlocks& tunnel) {
    const TunnelGrid grid(tunnel);
    std::vector<Polyhedron> blocks;
    for (int slice = 0; slice < tunnel.axial; ++slice)
        for (int step = 0; step < grid.steps(); ++step, stop_point())
            for (int ring = 0; ring < tunnel.radial; ++ring) {
                std::array<std::vector<Vec3>, 2> ends;
                for (int end = 0; end < 2; ++end)
                    ends[end] = {grid.corner(ring, step, slice + end), grid.corner(ring + 1, step, slice + end),
                                 grid.corner(ring + 1, step + 1, slice + end),
                                 grid.corner(ring, step + 1, slice + end)};
                append_prism(blocks, ends);
            }
    return blocks;
}

std::vector<Polyhedron> make_tunnel_core(const TunnelBlocks& tunnel) {
    const TunnelGrid grid(tunnel);
    std::vector<Polyhedron> blocks;
    for (int slice = 0; slice < tunnel.axial; ++slice, stop_point()) {
        std::array<std::vector<Vec3>, 2> ends;
        for (int end = 0; end < 2; ++end)
            for (int step = 0; step < grid.steps(); ++step) ends[end].push_back(grid.corner(0, step, slice + end));
        append_prism(blocks, ends);
    }
    return blocks;
}

} // namespace kaya
