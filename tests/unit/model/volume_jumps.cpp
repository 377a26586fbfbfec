#include "model/measure/volume_jumps.hpp"

#include "geometry/surface/shapes.hpp"
#include "model/edit/build.hpp"

#include <gtest/gtest.h>

using namespace kaya;

namespace {

Row zoned(Model& model, const Vec3& low, const Vec3& high, const std::array<int, 3>& parts, double ratio) {
    const Row block = add_block(model, make_brick(low, high), {});
    generate_zones(model, {block}, parts, {ratio, 1, 1});
    return block;
}

} // namespace

TEST(VolumeJumps, CellsThatGrowInABlock) {
    Model model;
    const Row even = zoned(model, {0, 0, 0}, {4, 1, 1}, {4, 2, 2}, 3);
    const Row steep = zoned(model, {10, 0, 0}, {14, 1, 1}, {4, 1, 1}, 5);
    EXPECT_EQ(volume_jumps(model, {even}).count, 0u);
    const VolumeJumps jumps = volume_jumps(model, {even, steep});
    EXPECT_EQ(jumps.count, 6u); // three walls of two triangles
    EXPECT_NEAR(jumps.worst, 5, 1e-9);
    EXPECT_EQ(jumps.blocks, (std::array<Row, 2>{steep, steep}));
    EXPECT_GT(jumps.place.x(), 10);
}

TEST(VolumeJumps, AcrossAFaceWhereverItIs) {
    for (const double far : {0.0, 1e6}) {
        Model model;
        const Vec3 at(far, -far, far);
        const Row small = zoned(model, at, at + Vec3(1, 1, 1), {1, 1, 1}, 1);
        const Row large = zoned(model, at + Vec3(1, 0, 0), at + Vec3(7, 1, 1), {1, 1, 1}, 1);
        zoned(model, at + Vec3(0, 3, 0), at + Vec3(1, 4, 1), {1, 1, 1}, 1); // adjacent to neither
        for (const Row one : {small, large}) {
            const VolumeJumps jumps = volume_jumps(model, {one});
            EXPECT_EQ(jumps.count, 2u);
            EXPECT_NEAR(jumps.worst, 6, 1e-6);
            EXPECT_EQ(jumps.blocks, (std::array<Row, 2>{large, small}));
            EXPECT_NEAR((jumps.place - at).x(), 1, 1e-6);
        }
    }
}

TEST(VolumeJumps, NothingWithoutZones) {
    Model model;
    const Row block = add_block(model, make_brick({0, 0, 0}, {1, 1, 1}), {});
    EXPECT_EQ(volume_jumps(model, {block}).count, 0u);
    EXPECT_EQ(volume_jumps(model, {}).count, 0u);
}
