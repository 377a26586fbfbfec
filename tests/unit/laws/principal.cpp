#include "stdlib/zones/principal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace kaya::zones {
namespace {

/// Tensors of many magnitudes, some with values that are equal, or zero, or without shear.
std::vector<Tensor> tensors() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1, 1), power(-6, 9);
    std::vector<Tensor> all{{0, 0, 0, 0, 0, 0},    {5, 5, 5, 0, 0, 0}, {3, 1, 2, 0, 0, 0},
                            {1, 1, 0, 1e-9, 0, 0}, {2, 2, 2, 1, 1, 1}, {0, 0, 0, 1, 0, 0}};
    for (int i = 0; i < 500; ++i) {
        const double size = std::pow(10, power(random));
        Tensor t;
        for (double& c : t) c = size * number(random);
        if (i % 5 == 0) t[3] = t[4] = 0;
        if (i % 7 == 0) t[1] = t[0];
        all.push_back(t);
    }
    return all;
}

double size_of(const Tensor& t) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) sum += (k < 3 ? 1 : 2) * t[k] * t[k];
    return std::sqrt(sum);
}

TEST(Principal, ValuesAndAxesMakeTheTensorAgain) {
    for (const Tensor& t : tensors()) {
        const Principal p(t);
        EXPECT_GE(p.value[0], p.value[1]);
        EXPECT_GE(p.value[1], p.value[2]);
        const Tensor again = p.tensor();
        for (int k = 0; k < 6; ++k) EXPECT_NEAR(again[k], t[k], 1e-14 * size_of(t));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                double dot = 0;
                for (int k = 0; k < 3; ++k) dot += p.axis[i][k] * p.axis[j][k];
                EXPECT_NEAR(dot, i == j ? 1 : 0, 1e-14);
            }
    }
}

TEST(Principal, LiesWithinItsBoundsAndNearThem) {
    std::vector<Tensor> all = tensors();
    for (const Tensor t : tensors()) // with a pressure much larger than the deviator
        for (const double pressure : {1e3, 1e6, 1e10, 1e14}) {
            all.push_back(t);
            for (std::size_t k = 0; k < 3; ++k) all.back()[k] -= pressure * size_of(t);
        }
    for (const Tensor& t : all) {
        const Principal p(t);
        const Bounds bounds = Bounds::of(t[0], t[1], t[2], t[3], t[4], t[5]);
        const double apart = 0.04 * (p.value[0] - p.value[2]) + 1e-11 * size_of(t);
        EXPECT_GE(bounds.high, p.value[0]);
        EXPECT_LE(bounds.high, p.value[0] + apart);
        EXPECT_LE(bounds.low, p.value[2]);
        EXPECT_GE(bounds.low, p.value[2] - apart);
    }
}

TEST(Principal, EightAtOnceAreTheSameBitsAsEachByItself) {
    const std::vector<Tensor> all = tensors();
    for (std::size_t first = 0; first + 8 <= all.size(); first += 8) {
        Rotations<8> eight;
        for (int l = 0; l < 8; ++l)
            for (int k = 0; k < 6; ++k)
                eight.a[k][l] = all[first + static_cast<std::size_t>(l)][static_cast<std::size_t>(k)];
        eight.run();
        for (int l = 0; l < 8; ++l) {
            const Principal one(all[first + static_cast<std::size_t>(l)]), of_eight(eight, l);
            EXPECT_EQ(one.value, of_eight.value);
            EXPECT_EQ(one.axis, of_eight.axis);
        }
    }
}

TEST(Principal, RowsBeyondTheirBoundsMayYieldAndBoundsAreBounds) {
    const std::vector<Tensor> all = tensors();
    std::vector<double> columns[6];
    for (int k = 0; k < 6; ++k)
        for (const Tensor& t : all) columns[k].push_back(t[static_cast<std::size_t>(k)]);
    kaya_zbatch batch{};
    batch.n = all.size();
    for (int k = 0; k < 6; ++k) batch.stress[k] = columns[k].data();
    std::vector<int> asked(all.size()), looked(all.size());
    const auto holds = [&](std::size_t i, double high, double low) {
        const Principal p(all[i]);
        EXPECT_GE(high, p.value[0]);
        EXPECT_LE(low, p.value[2]);
        ++asked[i];
        return i % 3 != 0;
    };
    for_rows_that_may_yield(batch, holds, [&](std::size_t i, Principal& p) {
        ++looked[i];
        EXPECT_EQ(p.value, Principal(all[i]).value);
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(asked[i], 2); // of wide bounds and of near ones
        EXPECT_EQ(looked[i], i % 3 == 0 ? 1 : 0);
    }
    const auto all_hold = [&](std::size_t i, double high, double low) { return ++asked[i], high >= low; };
    for_rows_that_may_yield(batch, all_hold, [&](std::size_t i, Principal&) { ++looked[i]; });
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(asked[i], 3); // of wide bounds alone
        EXPECT_EQ(looked[i], i % 3 == 0 ? 1 : 0);
    }
}

} // namespace
} // namespace kaya::zones
