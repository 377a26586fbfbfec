#include "lang/script/values/tables.hpp"

#include "base/diagnostic.hpp"
#include "lang/script/base/random.hpp"
#include "lang/script/values/value_text.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya::script {
namespace {

TEST(Table, IsLinearBetweenPointsAndConstantOutside) {
    Table table;
    EXPECT_THROW(table.at(1), Diagnostic);
    table.set(2, 20);
    table.set(0, 0);
    table.set(1, 5);
    table.set(1, 10);
    ASSERT_EQ(table.points().size(), 3);
    EXPECT_EQ(table.at(-1), 0);
    EXPECT_EQ(table.at(0.5), 5);
    EXPECT_EQ(table.at(1), 10);
    EXPECT_EQ(table.at(1.75), 17.5);
    EXPECT_EQ(table.at(9), 20);
}

TEST(Table, AStepIsTwoPointsAtOnePlace) {
    Table table;
    table.insert(0, 1);
    table.insert(1, 1);
    table.insert(1, 3);
    table.insert(2, 3);
    EXPECT_EQ(table.at(0.999), 1);
    EXPECT_EQ(table.at(1), 1);
    EXPECT_EQ(table.at(1.5), 3);
}

TEST(Table, InterpolatesWhereSortedOnly) {
    Table table;
    table.put(0, {2, 0});
    table.put(1, {1, 10});
    table.put(2, {0, 20});
    const auto refused = [](auto action) {
        try {
            action();
        } catch (const Diagnostic& problem) { return problem.message; }
        return std::string();
    };
    const std::string goes_back = "the table is not sorted: x goes back from 2 to 1 at point 2";
    EXPECT_EQ(refused([&] { table.at(0.5); }), goes_back);
    EXPECT_EQ(refused([&] { table.set(0.5, 1); }), goes_back);
    EXPECT_EQ(refused([&] { table.insert(0.5, 1); }), goes_back);
    ASSERT_EQ(table.points().size(), 3);
    table.put(0, {0, 20});
    EXPECT_EQ(refused([&] { table.at(0.5); }), "the table is not sorted: x goes back from 1 to 0 at point 3");
    table.put(2, {2, 0});
    EXPECT_EQ(table.at(0.5), 15);
    table.replace({{0, 0}, {-1, 0}});
    EXPECT_THROW(table.at(0), Diagnostic);
    table.replace({{0, 0}, {1, 4}});
    EXPECT_EQ(table.at(0.25), 1);
    table.put(1, {std::nan(""), 4});
    EXPECT_THROW(table.at(0.25), Diagnostic);
}

TEST(Random, FirstNumbersOfASeedNeverChange) {
    Random random(1);
    EXPECT_EQ(random.bits(), 12966619160104079557u);
    EXPECT_EQ(random.bits(), 9600361134598540522u);
}

TEST(Random, MeansAndSpreads) {
    Random random(7);
    double sum = 0, squares = 0, uniform = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double g = random.gaussian();
        sum += g;
        squares += g * g;
        uniform += random.uniform();
    }
    EXPECT_NEAR(sum / n, 0, 0.01);
    EXPECT_NEAR(squares / n, 1, 0.015);
    EXPECT_NEAR(uniform / n, 0.5, 0.005);
}

TEST(ValueText, ShowsValuesAsFishPrintsThem) {
    EXPECT_EQ(to_text(9.940991e-06), "9.94099e-06");
    EXPECT_EQ(to_text(322.0771), "322.077");
    EXPECT_EQ(to_text(-202837.2), "-202837");
    EXPECT_EQ(to_text(1e20), "1e+20");
    EXPECT_EQ(to_text(std::int64_t{12345678}), "12345678");
    EXPECT_EQ(to_text(Vec3(0.5, -1, 1e-9)), "(0.5,-1,1e-09)");
    EXPECT_EQ(to_text(Handle{}), "null");
    EXPECT_EQ(type_name(Value(1.0)), "number");
}

} // namespace
} // namespace kaya::script
