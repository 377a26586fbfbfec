// Blocks that are written and read again keep their number, groups, regions and volumes: rigid and with zones, mirrored, far away, in
// millimetres, in another order.
#include "geometry/grid/file_formats.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <tuple>

using namespace kaya;

namespace {

struct Body {
    std::string group;
    Polyhedron shape;
    TetMesh mesh;
};

/// Pieces of a brick, cut by eight random planes.
std::vector<Polyhedron> pieces(Random& random) {
    std::vector<Polyhedron> all{make_brick({0, 0, 0}, {4, 3, 2})};
    for (int k = 0; k < 4; ++k) {
        const Plane plane{normal_from_dip(90 * random.uniform(), 360 * random.uniform()),
                          {1 + 2 * random.uniform(), 1 + random.uniform(), 0.5 + random.uniform()}};
        std::vector<Polyhedron> next;
        for (const Polyhedron& one : all) {
            const Cut parts = cut(one, plane, 1);
            if (!parts.below.faces.empty()) next.push_back(parts.below);
            if (!parts.above.faces.empty()) next.push_back(parts.above);
        }
        all = std::move(next);
    }
    return all;
}

using Change = std::function<Vec3(const Vec3&)>;

std::vector<Body> bodies(const std::vector<Polyhedron>& shapes, bool zoned, const Change& change, bool mirrored) {
    std::vector<Body> result;
    constexpr std::array names{"", "left wall", "right", "it's \"so\" # ; here"};
    for (const Polyhedron& shape : shapes) {
        Body body{names[result.size() % names.size()], shape, {}};
        if (zoned && result.size() % 3 != 0) body.mesh = make_mesh(shape, 2);
        for (Vec3& v : body.shape.vertices) v = change(v);
        for (Vec3& v : body.mesh.points) v = change(v);
        if (mirrored) {
            for (auto& face : body.shape.faces) std::ranges::reverse(face.vertices);
            for (auto& t : body.mesh.tetrahedra) std::swap(t[2], t[3]);
        }
        result.push_back(std::move(body));
    }
    return result;
}

struct Measures {
    std::string group;
    int region = 0;
    double volume = 0;
    std::size_t zones = 0;
};

std::vector<Measures> measures_of(const Grid3d& grid) {
    std::vector<Measures> result;
    for (const auto& block : grid.blocks) {
        Measures one{block.group, block.region, 0, block.zones.size()};
        for (const Polyhedron& part : solid_from_surface(surface_of(grid, block), {1e-3, true}).parts)
            one.volume += mass_properties(part).volume;
        result.push_back(one);
    }
    return result;
}

std::vector<Measures> read_again(const FileFormat& format, const std::string& text) {
    if (format.blocks != nullptr) return measures_of(format.blocks(text, "file"));
    std::vector<Measures> result;
    for (const NamedSurface& body : surfaces_of(format.surfaces(text, "file")).surfaces) {
        Measures one{body.name, 0, 0, 0};
        for (const Polyhedron& part : solid_from_surface(body.surface, {1e-3, true}).parts)
            one.volume += mass_properties(part).volume;
        result.push_back(one);
    }
    return result;
}

/// Formats with groups of zones have another order of blocks.
void sort(std::vector<Measures>& all) {
    std::ranges::sort(all, {}, [](const Measures& one) { return std::tuple(one.group, one.volume); });
}

/// Volumes agree to `digits` of a block, and to the last digits of its coordinates.
void expect_round_trip(const std::string& suffix, const std::vector<Body>& given, double volume_error) {
    SCOPED_TRACE(suffix);
    const FileFormat& format = *file_format("a" + suffix);
    std::vector<GridShape> shapes;
    std::vector<Measures> before;
    int number = 0;
    for (const Body& body : given) {
        ++number;
        const bool zoned = !body.mesh.tetrahedra.empty();
        shapes.push_back({number, number % 3, body.group, &body.shape, 1, zoned ? &body.mesh : nullptr});
        before.push_back({body.group, number % 3, mass_properties(body.shape).volume, body.mesh.tetrahedra.size()});
    }
    const bool shared = format.holds == FileFormat::Holds::grid;
    const std::string text = format.write(grid_of(shapes, shared ? Corners::shared : Corners::own));
    std::vector<Measures> after = read_again(format, text);
    ASSERT_EQ(after.size(), before.size());
    for (Measures& one : before) { // both kinds of quotes in one name cannot be written
        if (suffix == ".vtu" || suffix == ".json" || one.group.find('\'') == one.group.npos) continue;
        std::ranges::replace(one.group, '\'', '"');
    }
    sort(before);
    sort(after);
    for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(after[k].group, before[k].group);
        EXPECT_NEAR(after[k].volume, before[k].volume, volume_error * before[k].volume) << k;
        if (shared || suffix == ".vtu") {
            EXPECT_EQ(after[k].region, before[k].region);
            EXPECT_EQ(after[k].zones, before[k].zones);
        }
    }
}

constexpr std::array suffixes{".3dgrid", ".f3grid", ".msh", ".vtu", ".stl", ".obj", ".ply", ".json"};

void expect_round_trips(const Change& change, bool mirrored, double volume_error) {
    Random random(44);
    for (int trial = 0; trial < 3; ++trial) {
        const std::vector<Polyhedron> shapes = pieces(random);
        for (const bool zoned : {false, true})
            for (const char* suffix : suffixes)
                expect_round_trip(suffix, bodies(shapes, zoned, change, mirrored), volume_error);
    }
}

} // namespace

TEST(RoundTrips, EveryFormatThatIsWritten) {
    std::string all;
    for (const char* suffix : suffixes) all += std::string(all.empty() ? "" : ", ") + suffix;
    EXPECT_EQ(suffixes_written(), all);
    expect_round_trips([](const Vec3& v) { return v; }, false, 1e-12);
}

TEST(RoundTrips, Mirrored) {
    expect_round_trips([](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); }, true, 1e-12);
}

TEST(RoundTrips, InMillimetresAndKilometres) {
    expect_round_trips([](const Vec3& v) { return Vec3(1000 * v); }, false, 1e-12);
    expect_round_trips([](const Vec3& v) { return Vec3(1e-3 * v); }, false, 1e-12);
}

// A million metres away a coordinate has ten digits behind the point, so a face of a metre is flat to 1e-10 m: volumes differ by 1.5e-10 at most.
TEST(RoundTrips, AMillionMetresAway) {
    expect_round_trips([](const Vec3& v) { return Vec3(v + Vec3(1e6, -1e6, 1e6)); }, false, 1e-9);
}

TEST(RoundTrips, TwoNeighboursOfOneGroupStayTwo) {
    const std::vector<Polyhedron> shapes{make_brick({0, 0, 0}, {1, 1, 1}), make_brick({1, 0, 0}, {2, 1, 1})};
    std::vector<Body> pair;
    for (const Polyhedron& shape : shapes) pair.push_back({"wall", shape, make_mesh(shape, 1)});
    for (const char* suffix : suffixes) expect_round_trip(suffix, pair, 1e-12);
    for (Body& body : pair) body.mesh = {};
    for (const char* suffix : suffixes) expect_round_trip(suffix, pair, 1e-12);
}
