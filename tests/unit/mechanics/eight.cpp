#include "mechanics/lanes/eight.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace kaya {
namespace {

/// 0, 1, 2, ...
struct Numbers {
    std::array<double, 64> value;
    Numbers() { std::iota(value.begin(), value.end(), 0.0); }
};

TEST(Eight, RowsOfThreeBecomeColumns) {
    const Numbers n;
    const Eight3 c = columns_of(load_three(n.value.data()));
    for (int l = 0; l < 8; ++l) {
        EXPECT_EQ(c.x[l], 3 * l);
        EXPECT_EQ(c.y[l], 3 * l + 1);
        EXPECT_EQ(c.z[l], 3 * l + 2);
    }
}

TEST(Eight, RowsOfFourBecomeColumns) {
    std::array<Four, 8> rows;
    for (int l = 0; l < 8; ++l) rows[l] = Four{4.0 * l, 4.0 * l + 1, 4.0 * l + 2, 4.0 * l + 3};
    const std::array<Eight, 4> columns = columns_of_rows(rows);
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 8; ++l) EXPECT_EQ(columns[k][l], 4 * l + k);
}

TEST(Eight, RowsOfSixBecomeColumnsAndRowsAgain) {
    const Numbers n;
    const std::array<Eight, 6> columns = six_columns(n.value.data(), 6);
    for (int k = 0; k < 6; ++k)
        for (int l = 0; l < 8; ++l) EXPECT_EQ(columns[k][l], 6 * l + k);
    std::array<double, 50> rows;
    rows.fill(-1);
    put_six_columns(&rows[1], 6, columns);
    EXPECT_EQ(rows.front(), -1);
    EXPECT_EQ(rows.back(), -1);
    for (int i = 0; i < 48; ++i) EXPECT_EQ(rows[i + 1], i);
}

TEST(Eight, RowsOfSixMayBeScatteredAndRepeated) {
    const Numbers n;
    std::array<double, 8 * 14> rows;
    rows.fill(-1);
    put_six_columns(rows.data(), 14, six_columns(n.value.data(), 6), 2);
    const std::array<Eight, 6> second = six_columns(&rows[6], 14);
    for (int l = 0; l < 8; ++l) {
        for (int k = 0; k < 6; ++k) EXPECT_EQ(rows[14 * l + k], 6 * l + k);
        for (int k = 0; k < 6; ++k) EXPECT_EQ(second[k][l], 6 * l + k);
        for (int k = 12; k < 14; ++k) EXPECT_EQ(rows[14 * l + k], -1);
    }
}

TEST(Eight, ANumberOfEachRowIsCopiedToItsThree) {
    const Numbers n;
    const ThreeEights spread = for_each_of_three(load_as<Eight>(n.value.data())), same = for_each_row(Vec3(5, 6, 7));
    for (int i = 0; i < 24; ++i) {
        EXPECT_EQ(spread[i / 8][i % 8], i / 3);
        EXPECT_EQ(same[i / 8][i % 8], 5 + i % 3);
    }
}

TEST(Eight, MissingRowsAreNeitherReadNorWritten) {
    const Numbers n;
    const Eight some = load_rows(&n.value[1], 3);
    for (int l = 0; l < 8; ++l) EXPECT_EQ(some[l], l < 3 ? l + 1 : 0);
    std::array<double, 8> rows{};
    store_rows(rows.data(), 3, eights(2));
    for (int l = 0; l < 8; ++l) EXPECT_EQ(rows[l], l < 3 ? 2 : 0);
}

TEST(Eight, NaNIsNotAboveZero) {
    EXPECT_TRUE(all_above_zero(eights(1e-300)));
    for (const double other : {0.0, -1.0, std::nan("")}) {
        Eight e = eights(1);
        e[5] = other;
        EXPECT_FALSE(all_above_zero(e));
    }
}

TEST(Eight, SumsOfFourTakeTheFirstHalfFirst) {
    Lanes sum = Lanes{};
    Eight e = eights(1);
    e[0] = 1e16; // 1 is below its precision
    e[4] = -1e16;
    add_to(sum, e);
    EXPECT_EQ(sum[0], 0);
    EXPECT_EQ(sum[1], 2);
    EXPECT_EQ(kaya::sum(eights(0.5)), 4);
}

} // namespace
} // namespace kaya
