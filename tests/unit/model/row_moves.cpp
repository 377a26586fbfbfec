#include "model/tables/row_moves.hpp"

#include "base/vector.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

using namespace kaya;

namespace {

/// The rows of a table after one change of few of its contacts: some go, some come, some are repeated or leave their order.
std::vector<std::int32_t> changed_rows(std::int32_t size, std::mt19937& random) {
    const auto below = [&](std::int32_t n) { return std::uniform_int_distribution<std::int32_t>(0, n - 1)(random); };
    std::vector<std::int32_t> rows(static_cast<std::size_t>(size));
    std::iota(rows.begin(), rows.end(), 0);
    for (int i = below(8); i > 0 && !rows.empty(); --i) {
        const auto at = rows.begin() + below(static_cast<std::int32_t>(rows.size()));
        switch (below(4)) {
        case 0: rows.erase(at); break;
        case 1: rows.insert(at, -1); break;
        case 2: rows.insert(at, below(size)); break;
        default: std::swap(*at, rows[static_cast<std::size_t>(below(static_cast<std::int32_t>(rows.size())))]);
        }
    }
    return rows;
}

template <class T, class Of> void expect_moved(std::int32_t size, const std::vector<std::int32_t>& rows, const Of& of) {
    std::vector<T> column, expected;
    for (std::int32_t i = 0; i < size; ++i) column.push_back(of(i));
    for (const std::int32_t row : rows)
        expected.push_back(row < 0 ? new_value<T>() : column[static_cast<std::size_t>(row)]);
    RowMoves(rows).apply(column);
    EXPECT_EQ(column, expected);
}

} // namespace

TEST(RowMoves, EveryRowComesFromItsSource) {
    for (unsigned seed = 1; seed <= 2000; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const auto size = static_cast<std::int32_t>(1 + seed % 40);
        const auto rows = changed_rows(size, random);
        expect_moved<double>(size, rows, [](std::int32_t i) { return i + 0.5; });
        expect_moved<Vec3>(size, rows, [](std::int32_t i) { return Vec3(i, -i, i + 0.5); });
    }
}

TEST(RowMoves, ATableThatTurnsRoundOrGrowsFromNothing) {
    const auto number = [](std::int32_t i) { return static_cast<double>(i); };
    expect_moved<double>(5, {4, 3, 2, 1, 0}, number);
    expect_moved<double>(5, {}, number);
    expect_moved<double>(0, {-1, -1, -1}, number);
    expect_moved<double>(3, {2, 2, 2, 2, 2, -1, 0, 1, 2}, number);
}
