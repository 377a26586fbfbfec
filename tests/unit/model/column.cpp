#include "model/tables/blocks.hpp"

#include <gtest/gtest.h>

using namespace kaya;

TEST(Table, NewRowsAreZeroAlsoInMemoryThatWasUsedBefore) {
    Gridpoints gridpoints;
    gridpoints.resize(50);
    for (auto& position : gridpoints.position) position = Vec3(1, 2, 3);
    for (auto& mass : gridpoints.mass) mass = 4;
    gridpoints.resize(0);
    gridpoints.resize(50);
    for (std::size_t i = 0; i < gridpoints.size(); ++i) {
        EXPECT_EQ(gridpoints.position[i], Vec3(0, 0, 0));
        EXPECT_EQ(gridpoints.mass[i], 0);
    }
}

TEST(Table, GatherKeepsTheRowsListedInThatOrder) {
    Zones zones;
    zones.resize(3);
    for (Row i = 0; i < 3; ++i) {
        zones.block[i] = i;
        zones.stress[i] = Stress::Constant(i);
    }
    zones.gather({2, 0, 2});
    ASSERT_EQ(zones.size(), 3u);
    EXPECT_EQ(zones.block, (Column<Row>{2, 0, 2}));
    EXPECT_EQ(zones.stress[1], Stress::Zero());
    zones.gather({});
    EXPECT_TRUE(zones.empty());
    EXPECT_TRUE(zones.stress.empty());
}
