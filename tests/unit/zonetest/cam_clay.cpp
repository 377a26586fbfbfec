// An external zone model (tests/plugins/zones/cam-clay.cpp) on paths of the bench. Its final critical state does not depend on the path, so
// closed forms hold to the last digits.
#include "base/diagnostic.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "zonetest/zone_bench.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace kaya {
namespace {

constexpr double bulk = 1e9, shear = 2e7, m = 1.2, lambda = 0.08, kappa = 0.016, pc = 4e5;

struct CamClay : testing::Test {
    ZoneModels models;
    const ZoneModel& model = models.get(std::string(KAYA_TEST_PLUGINS) + "/zones/cam-clay.so");
    std::vector<double> values{bulk, shear, m, lambda, kappa, pc};

    ZoneCurve follow(double pressure, const ZonePath& path, int steps = 400) const {
        ZoneCurveSettings settings;
        settings.stress = {-pressure, -pressure, -pressure, 0, 0, 0};
        settings.steps = steps;
        return follow_zone_path(model, values, path, settings);
    }
    static ZonePath strain(const SixNumbers& end) {
        ZonePath path;
        path.points = {{{}, 0}, {end, 1}};
        return path;
    }
    static ZonePath drained(double pressure, double axial_strain) {
        ZonePath path;
        path.is_stress = {true, true, false, false, false, false};
        path.points = {{{-pressure, -pressure, 0, 0, 0, 0}, 0}, {{-pressure, -pressure, axial_strain, 0, 0, 0}, 1}};
        return path;
    }
};

TEST_F(CamClay, IsotropicLoadFollowsTheTwoLinesOfCompression) {
    constexpr double start = 1e5, each = -0.08;
    const ZoneCurve curve = follow(start, strain({each, each, each, 0, 0, 0}));
    const double at_yield = kappa * std::log(pc / start);
    for (const SingleZone& zone : curve.points) {
        const double volume = -zone.volume_strain(), exact = volume < at_yield
                                                                 ? start * std::exp(volume / kappa)
                                                                 : pc * std::exp((volume - at_yield) / lambda);
        ASSERT_NEAR(-zone.mean_stress() / exact, 1, 1e-9) << volume;
        ASSERT_NEAR(zone.deviator() / exact, 0, 1e-9);
        ASSERT_EQ(zone.state, volume > at_yield * (1 + 1e-9) ? 1u : 0u) << volume;
    }
    EXPECT_GT(-curve.points.back().mean_stress(), 2 * pc);
    EXPECT_TRUE(curve.findings.empty());
}

TEST_F(CamClay, UnloadingGoesBackOnTheOtherLine) {
    constexpr double start = 1e5, each = -0.05;
    ZonePath path = strain({each, each, each, 0, 0, 0});
    path.points.push_back({{0.7 * each, 0.7 * each, 0.7 * each, 0, 0, 0}, 2});
    const ZoneCurve curve = follow(start, path);
    const SingleZone &turn = curve.points[400], &end = curve.points.back();
    EXPECT_NEAR(end.mean_stress() / turn.mean_stress(), std::exp(3 * 0.3 * each / kappa), 1e-9);
    EXPECT_NEAR(end.history[0] / -turn.mean_stress(), 1, 1e-9); // its largest pressure
}

// At the same volume p/py = ((M^2 + ny^2)/(M^2 + n^2))^L for each state on the yield surface, n = q/p and L = 1 - kappa/lambda: from
// the surface and the two lines alone. In the critical state p = p0 (R/2)^L.
TEST_F(CamClay, UndrainedTriaxialLoadEndsInTheCriticalState) {
    const double exponent = 1 - kappa / lambda;
    for (const double ratio : {1.0, 1.5, 2.0, 4.0}) {
        const double start = pc / ratio;
        const ZoneCurve curve = follow(start, strain({0.2, 0.2, -0.4, 0, 0, 0}), 2000);
        const double yield = m * std::sqrt(ratio - 1);
        for (const SingleZone& zone : curve.points) {
            const double p = -zone.mean_stress(), n = zone.deviator() / p;
            const double exact =
                zone.state ? start * std::pow((m * m + yield * yield) / (m * m + n * n), exponent) : start;
            ASSERT_NEAR(p / exact, 1, 1e-8) << "ratio " << ratio << ", q/p " << n;
        }
        const SingleZone& end = curve.points.back();
        EXPECT_NEAR(-end.mean_stress() / (start * std::pow(ratio / 2, exponent)), 1, 1e-6) << ratio;
        EXPECT_NEAR(end.deviator() / -end.mean_stress(), m, 1e-6) << ratio;
        EXPECT_TRUE(curve.findings.empty()) << ratio << ": " << curve.findings.front().text;
    }
}

TEST_F(CamClay, DrainedTriaxialLoadEndsInTheCriticalState) {
    for (const double ratio : {1.0, 1.6, 2.4}) {
        const double start = pc / ratio;
        const ZoneCurve curve = follow(start, drained(start, -1.5), 1000);
        const SingleZone& end = curve.points.back();
        const double p = 3 * start / (3 - m),
                     volume = kappa * std::log(p / start) + (lambda - kappa) * std::log(2 * p / pc);
        EXPECT_NEAR(-end.mean_stress() / p, 1, 1e-6) << ratio;
        EXPECT_NEAR(end.deviator() / (m * p), 1, 1e-6) << ratio;
        EXPECT_NEAR(-end.volume_strain() / volume, 1, 1e-5) << ratio;
        EXPECT_TRUE(curve.findings.empty()) << ratio << ": " << curve.findings.front().text;
    }
}

TEST_F(CamClay, WhatItCannotCarryIsToldInItsOwnWords) {
    try {
        follow(0, strain({0, 0, -1e-3, 0, 0, 0}));
        FAIL() << "carried";
    } catch (const Diagnostic& problem) {
        EXPECT_THAT(problem.message,
                    testing::HasSubstr("zone model cam-clay failed: a mean stress of 0; it must be below 0"));
    }
    EXPECT_THAT(model.check({bulk, shear, m, kappa, lambda, pc}), testing::HasSubstr("kappa must be below lambda"));
}

} // namespace
} // namespace kaya
