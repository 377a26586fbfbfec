// Blocks that touch along lines: their corners are equal, or differ by what rounding makes of them.
#include "running.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace kaya {
namespace {

class Touching : public Running {
protected:
    Touching() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }

    /// Triangular prisms as a held ground around a place. `sums`: their corners are sums of steps, as a loop makes them.
    void ground(double place, bool sums) {
        constexpr int cells = 10;
        constexpr double step = 0.2;
        std::vector<double> at{place};
        for (int i = 1; i <= cells; ++i)
            at.push_back(sums ? at.back() + step : std::round(1e6 * (place + i * step)) / 1e6);
        std::string deck = "new\n";
        const auto prism = [&](std::vector<std::pair<int, int>> corners) {
            deck += "poly prism";
            for (const auto& [word, z] : {std::pair{"a", "-0.2"}, std::pair{"b", "0"}}) {
                deck += fmt::format(" {}", word);
                for (const auto& [i, j] : corners) deck += fmt::format(" {} {} {}", at[i], at[j], z);
            }
            deck += "\n";
        };
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                prism({{i, j}, {i + 1, j}, {i + 1, j + 1}});
                prism({{i, j}, {i + 1, j + 1}, {i, j + 1}});
            }
        deck += "prop mat 1 density 2000\nprop jmat 1 jkn 1e9 jks 1e9 jfric 35\nfix\n";
        run(deck);
    }
};

TEST_F(Touching, RoundingMakesNoOverlapsOfHeldBlocks) {
    for (const double place : {0.0, -1.0, 3.3, 1e4, -1e6})
        for (const bool sums : {false, true}) {
            SCOPED_TRACE(fmt::format("at {}, {}", place, sums ? "sums" : "exact"));
            ground(place, sums);
            run("cycle 5");
            const auto& contacts = model().contacts;
            EXPECT_GE(contacts.size(), 600u);
            for (std::size_t c = 0; c < contacts.size(); ++c) {
                ASSERT_EQ(contacts.depth[c], 0);
                ASSERT_EQ(contacts.offset[c], 0); // seeking it in each cycle costs ten times the contact
            }
        }
}

TEST_F(Touching, BlocksStandOnThemAsOnOneFloor) {
    for (const bool sums : {false, true}) {
        ground(-1, sums);
        run("poly brick -0.55 0.35 -0.45 0.65 0 0.5\ngravity 0 0 -10\ndamp local\nsolve ratio 1e-6");
        const auto& subs = model().sub_contacts;
        const double weight = 2000 * 0.9 * 1.1 * 0.5 * 10;
        EXPECT_NEAR(std::accumulate(subs.normal_force.begin(), subs.normal_force.end(), 0.0), weight, 1e-4 * weight);
    }
}

TEST_F(Touching, DeeperOverlapsCarryNoForceWhereTheyAreFound) {
    run("new\npoly prism a -1 -0.5 0 0 0 0 -1 0.5 0 b -1 -0.5 1 0 0 1 -1 0.5 1\n"
        "poly prism a -1e-6 0 0 1 -0.5 0 1 0.5 0 b -1e-6 0 1 1 -0.5 1 1 0.5 1\nprop mat 1 density 2000\n"
        "prop jmat 1 jkn 1e9 jks 1e9\nfix\ncycle 5");
    ASSERT_EQ(model().contacts.size(), 1u);
    EXPECT_EQ(model().contacts.depth[0], 0);
    EXPECT_LT(model().contacts.offset[0], -1e-7);
}

} // namespace
} // namespace kaya
