// Chains of any kind: residuals of solve(), and limits.
#include "mechanics/structures/cable_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using kaya::CableChain;

namespace {

CableChain even_chain(std::size_t nodes, double bar, double grout, double strength) {
    CableChain chain;
    chain.bars.assign(nodes - 1, {.stiffness = bar, .yield_tension = 1e300, .yield_compression = 1e300});
    chain.grout.assign(nodes, {.stiffness = grout, .strength = strength});
    chain.slip.assign(nodes, 0);
    return chain;
}

/// Residual force at a node that may slip, by equation (4) of docs/theory/cables.md.
double left_over(const CableChain& chain, std::size_t i) {
    double force = chain.grout_force(i);
    if (i < chain.bars.size()) force += chain.bars[i].first_cosine * chain.bar_force(i);
    if (i > 0) force -= chain.bars[i - 1].second_cosine * chain.bar_force(i - 1);
    return force;
}

} // namespace

TEST(CableChain, OfTwoNodesIsThreeSpringsInARow) {
    CableChain chain = even_chain(2, 300, 200, 1e9);
    chain.bars[0].gap = 0.01;
    chain.solve();
    EXPECT_NEAR(chain.bar_force(0), 0.01 / (1.0 / 300 + 2.0 / 200), 1e-12);
    EXPECT_NEAR(chain.slip[0], -chain.slip[1], 1e-15);
}

TEST(CableChain, PulledAtAnAnchorHasTheStiffnessOfTheLadder) {
    // A long ladder of bars and grout: K^2 + K k h - EA k = 0 seen from behind the first bar, with h = 1, EA = 1000, k = 10.
    CableChain chain = even_chain(400, 1000, 10, 1e9);
    chain.grout[0].anchored = true;
    chain.bars[0].gap = 1e-3;
    chain.solve();
    const double rest = 0.5 * (10 + std::sqrt(10.0 * 10 + 4 * 10.0 * 1000)); // the ladder from its first grout on
    EXPECT_NEAR(chain.bar_force(0), 1e-3 / (1.0 / 1000 + 1 / rest), 1e-9);
}

TEST(CableChain, SlipsAsAWholeAtTheSumOfItsGrout) {
    CableChain chain = even_chain(11, 1e6, 100, 2);
    chain.grout[0].anchored = true;
    chain.bars[0].gap = 1;
    chain.solve();
    EXPECT_NEAR(chain.bar_force(0), 20, 1e-9);
}

TEST(CableChain, RandomOnesComeToRestWithinTheirLimits) {
    std::mt19937_64 random(5);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto size = [&] { return std::pow(10, any(-4, 4)); }; // stiffnesses of bars and grout differ by up to 1e8
    for (int k = 0; k < 5000; ++k) {
        SCOPED_TRACE(k);
        const auto nodes = static_cast<std::size_t>(2 + random() % 40);
        CableChain chain = even_chain(nodes, 1, 0, 0);
        const double bar = size(), grout = size(), force = size(), way = size() * 1e-3;
        for (auto& b : chain.bars) {
            b.stiffness = bar * any(0.5, 2);
            b.gap = any(-1, 1) * way;
            b.first_cosine = any(0.5, 1), b.second_cosine = any(0.5, 1);
            if (random() % 3 == 0)
                b.yield_tension = force * any(0.1, 2), b.yield_compression = random() % 2 ? 0 : force;
            b.broken = random() % 20 == 0;
        }
        for (auto& g : chain.grout) {
            if (random() % 4 != 0)
                g.stiffness = grout * any(0.1, 3), g.strength = random() % 5 == 0 ? 0 : force * any(0.01, 1);
            g.lost = any(-1, 1) * way;
            g.anchored = random() % 10 == 0;
        }
        for (auto& s : chain.slip) s = any(-1, 1) * way;
        const auto before = chain.slip;
        chain.solve();
        double largest = 0;
        for (std::size_t i = 0; i < chain.bars.size(); ++i) {
            const double n = chain.bar_force(i);
            EXPECT_TRUE(std::isfinite(n));
            EXPECT_LE(n, chain.bars[i].yield_tension);
            EXPECT_GE(n, -chain.bars[i].yield_compression);
            largest = std::max(largest, std::abs(n));
        }
        for (std::size_t i = 0; i < nodes; ++i) largest = std::max(largest, std::abs(chain.grout_force(i)));
        // Precision of differences of slips.
        double rounding = 0;
        for (const double slip : chain.slip) rounding = std::max(rounding, 1e-13 * (bar + grout) * std::abs(slip));
        for (std::size_t i = 0; i < nodes; ++i) {
            if (chain.grout[i].anchored) EXPECT_EQ(chain.slip[i], before[i]);
            else EXPECT_NEAR(left_over(chain, i), 0, 1e-6 * largest + rounding) << "node " << i << " of " << nodes;
        }
        // A second solution changes nothing.
        std::vector<double> forces;
        for (std::size_t i = 0; i + 1 < nodes; ++i) forces.push_back(chain.bar_force(i));
        chain.solve();
        for (std::size_t i = 0; i + 1 < nodes; ++i)
            EXPECT_NEAR(chain.bar_force(i), forces[i], 1e-6 * largest + rounding);
    }
}
