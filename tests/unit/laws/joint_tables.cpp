#include "laws/joint_tables.hpp"

#include "base/diagnostic.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

const JointTables::Points points{{0, 1, 1, 3}, {10, 20, 40, 0}};

TEST(JointTable, IsStraightBetweenPointsAndConstantBeyondThem) {
    EXPECT_EQ(table_value(points, -5), 10);
    EXPECT_EQ(table_value(points, 0), 10);
    EXPECT_EQ(table_value(points, 0.25), 12.5);
    EXPECT_EQ(table_value(points, 1), 20); // the first of two at a step, as in all tables of a deck
    EXPECT_EQ(table_value(points, 2), 20);
    EXPECT_EQ(table_value(points, 3), 0);
    EXPECT_EQ(table_value(points, 99), 0);
    EXPECT_EQ(table_value({}, 1), 0);
}

TEST(JointTable, HasASlopeToTheRight) {
    EXPECT_EQ(table_slope(points, -5), 0);
    EXPECT_EQ(table_slope(points, 0), 10);
    EXPECT_EQ(table_slope(points, 0.9), 10);
    EXPECT_EQ(table_slope(points, 1), -20);
    EXPECT_EQ(table_slope(points, 3), 0);
    EXPECT_EQ(table_slope({}, 1), 0);
}

TEST(JointTables, AreReadOnFirstUseAndAgainAfterRefresh) {
    JointTables tables;
    const kaya_jtables* interface = tables.interface();
    EXPECT_EQ(interface->find(interface, "1"), nullptr);
    double height = 5;
    bool there = true;
    tables.set_source([&](const std::string& name) -> std::optional<JointTables::Points> {
        if (name == "1" && there) return JointTables::Points{{0}, {height}};
        return std::nullopt;
    });
    const void* table = interface->find(interface, "1");
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(interface->find(interface, "2"), nullptr);
    height = 7;
    EXPECT_EQ(interface->value(table, 0), 5);
    tables.refresh();
    EXPECT_EQ(interface->value(table, 0), 7);
    EXPECT_EQ(interface->slope(table, 0), 0);
    there = false;
    EXPECT_THROW(tables.refresh(), Diagnostic);
}

} // namespace
} // namespace kaya
