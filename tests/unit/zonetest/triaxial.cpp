#include "zonetest/zone_bench.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace kaya {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Bench : testing::Test {
    ZoneModels models;
    Bench() { models.set_path({KAYA_TEST_JOINTS}); }

    static ZonePath triaxial(double confining, double axial_strain) {
        ZonePath path;
        path.is_stress = {true, true, false, false, false, false};
        path.points = {{{confining, confining, 0, 0, 0, 0}, 0}, {{confining, confining, axial_strain, 0, 0, 0}, 1}};
        return path;
    }
    static ZoneCurveSettings start(double stress, int steps = 200) {
        ZoneCurveSettings settings;
        settings.stress = {stress, stress, stress, 0, 0, 0};
        settings.steps = steps;
        return settings;
    }
};

TEST_F(Bench, MohrCoulombYieldsAtItsTriaxialStrengthAndDilatesAsAsked) {
    const double c = 2e6, phi = 30, psi = 10, confining = -3e6, bulk = 4e9, shear = 3e9;
    const ZoneCurve curve = follow_zone_path(models.get("mohr-coulomb"), {bulk, shear, c, phi, psi, 1e9},
                                             triaxial(confining, -0.02), start(confining));
    const double n = (1 + std::sin(phi * degree)) / (1 - std::sin(phi * degree));
    const SingleZone& last = curve.points.back();
    EXPECT_NEAR(last.stress[2], n * confining - 2 * c * std::sqrt(n), 1e-6 * std::abs(last.stress[2]));
    EXPECT_NEAR(last.stress[0], confining, 1e-6 * std::abs(confining));
    EXPECT_NEAR(last.stress[1], confining, 1e-6 * std::abs(confining));
    // In flow the volume increases by 2 sin psi / (1 - sin psi) of the axial shortening.
    const SingleZone& before = curve.points[curve.points.size() - 2];
    const double axial = last.strain[2] - before.strain[2],
                 m = (1 + std::sin(psi * degree)) / (1 - std::sin(psi * degree));
    EXPECT_NEAR(last.volume_strain() - before.volume_strain(), -axial * (m - 1), 1e-9 * std::abs(axial));
    EXPECT_NEAR(last.strain[0], last.strain[1], 1e-9); // on the edge of the surface both directions are admissible
    EXPECT_TRUE(curve.findings.empty());
    const double young = 9 * bulk * shear / (3 * bulk + shear);
    EXPECT_NEAR((curve.points[1].stress[2] - confining) / curve.points[1].strain[2], young, 1e-6 * young);
}

TEST_F(Bench, HoekBrownYieldsOnItsCurve) {
    const double sci = 30e6, mb = 1.7, s = 0.0039, confining = -5e6;
    const ZoneCurve curve = follow_zone_path(models.get("hoek-brown"), {3.667e9, 2.2e9, sci, mb, s, 0.5, 0, 1},
                                             triaxial(confining, -0.04), start(confining));
    const double s3 = -confining, s1 = s3 + sci * std::sqrt(mb * s3 / sci + s);
    EXPECT_NEAR(curve.points.back().stress[2], -s1, 1e-6 * s1);
    EXPECT_TRUE(curve.findings.empty());
}

/// The envelope of shear stresses as the upper edge of many Mohr circles: independent of the model.
double envelope(double normal, double sci, double mb, double s, double a) {
    double highest = 0;
    for (double s3 = -s * sci / mb; s3 < normal; s3 += 2e-4 * sci) {
        const double s1 = s3 + sci * std::pow(mb * s3 / sci + s, a), centre = 0.5 * (s1 + s3), radius = 0.5 * (s1 - s3);
        highest = std::max(highest, radius * radius - (normal - centre) * (normal - centre));
    }
    return std::sqrt(highest);
}

TEST_F(Bench, HoekBrownWithAFactorYieldsWhereItsCircleTouchesTheLowerEnvelope) {
    const double sci = 30e6, mb = 0.9, s = 0.0039, a = 0.52;
    for (const double factor : {1.0, 1.5, 0.8})
        for (const double confining : {-0.5e6, -5e6}) {
            const ZoneCurve curve =
                follow_zone_path(models.get("hoek-brown"), {3.667e9, 2.2e9, sci, mb, s, a, 0, factor},
                                 triaxial(confining, -0.04), start(confining));
            const double s3 = -confining, s1 = -curve.points.back().stress[2], centre = 0.5 * (s1 + s3),
                         radius = 0.5 * (s1 - s3);
            double nearest = INFINITY;
            for (int k = 1; k < 180; ++k) {
                const double normal = centre + radius * std::cos(k * degree);
                nearest = std::min(nearest,
                                   (envelope(normal, sci, mb, s, a) / factor - radius * std::sin(k * degree)) / radius);
            }
            EXPECT_NEAR(nearest, 0, 1e-3) << "factor " << factor << ", confined by " << confining;
            EXPECT_TRUE(curve.findings.empty());
        }
}

TEST_F(Bench, AnisotropicRockIsAsSoftAsItsPlanesAreTurned) {
    // Lekhnitskii 1963: 1/E = cos^4 b/En + sin^4 b/E + sin^2 b cos^2 b (1/G - 2 nun/En), b between load and normal.
    const double plane = 30e9, normal = 10e9, nu = 0.25, nun = 0.2, shear = 5e9, load = -1e6;
    ZonePath path;
    path.is_stress = {true, true, true, true, true, true};
    path.points = {{{}, 0}, {{0, 0, load, 0, 0, 0}, 1}};
    for (const double dip : {0.0, 20.0, 45.0, 70.0, 90.0})
        for (const double dip_direction : {0.0, 90.0, 217.0}) {
            const ZoneCurve curve =
                follow_zone_path(models.get("anisotropic-elastic"), {plane, normal, nu, nun, shear, dip, dip_direction},
                                 path, start(0, 10));
            const double c = std::cos(dip * degree), s = std::sin(dip * degree), c2 = c * c, s2 = s * s;
            const double softness = c2 * c2 / normal + s2 * s2 / plane + s2 * c2 * (1 / shear - 2 * nun / normal);
            const auto& strain = curve.points.back().strain;
            EXPECT_NEAR(strain[2] / load / softness, 1, 1e-6) << dip << " " << dip_direction;
            // Perpendicular to the load, along strike and perpendicular to it; and the shear caused by the planes.
            const double along_strike = -(c2 * nun / normal + s2 * nu / plane);
            const double down_dip = s2 * c2 * (1 / normal + 1 / plane - 1 / shear) - (c2 * c2 + s2 * s2) * nun / normal;
            EXPECT_NEAR((strain[0] + strain[1]) / load / (along_strike + down_dip), 1, 1e-6)
                << dip << " " << dip_direction;
            const double east = std::sin(dip_direction * degree), north = std::cos(dip_direction * degree);
            const double found = strain[0] * north * north - 2 * strain[3] * north * east + strain[1] * east * east;
            EXPECT_NEAR(found / load / along_strike, 1, 1e-6) << dip << " " << dip_direction;
            EXPECT_TRUE(curve.findings.empty());
        }
}

TEST_F(Bench, AnElasticZoneThatIsUnloadedIsAsItWas) {
    ZonePath path;
    path.is_stress = {true, true, true, true, true, true};
    path.points = {{{}, 0}, {{1e6, -2e6, 3e6, 4e5, -5e5, 6e5}, 1}, {{}, 2}};
    const ZoneCurve curve = follow_zone_path(models.get("elastic"), {4e9, 3e9}, path, start(0, 10));
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(curve.points[10].stress[k], path.points[1].value[k], 1e-5);
        EXPECT_NEAR(curve.points.back().strain[k], 0, 1e-15);
    }
    EXPECT_NEAR(curve.points.back().put_in, 0, 1e-9);
}

TEST_F(Bench, AStressBeyondTheStrengthIsSaid) {
    ZonePath path;
    path.is_stress = {true, true, true, false, false, false};
    path.points = {{{}, 0}, {{0, 0, -1e8, 0, 0, 0}, 1}};
    try {
        follow_zone_path(models.get("mohr-coulomb"), {4e9, 3e9, 1e6, 30, 0, 1e9}, path, start(0));
        FAIL() << "carried";
    } catch (const Diagnostic& problem) {
        EXPECT_NE(problem.message.find("cannot carry the stress"), std::string::npos);
        EXPECT_NE(problem.context.back().find("on the way to point 2"), std::string::npos);
    }
}

TEST_F(Bench, WrongPathsAreRefusedWithTheirFile) {
    const test::ScratchFolder folder;
    const auto file = folder / "kaya-zone-path.csv";
    const std::pair<const char*, const char*> wrong[] = {{"zz_strain\n0\n", "two points"},
                                                         {"zz_strain,zz_stress\n0,0\n1,1\n", "zz_strain and zz_stress"},
                                                         {"zz_strian\n0\n1\n", "zz_strian"},
                                                         {"time\n0\n1\n", "no strain and no stress"},
                                                         {"zz_strain,time\n0,1\n1,0\n", "time goes back"}};
    for (const auto& [text, what] : wrong) {
        test::put(file, text);
        try {
            read_zone_path(file);
            ADD_FAILURE() << text;
        } catch (const Diagnostic& problem) {
            EXPECT_NE(problem.message.find(what), std::string::npos) << problem.message;
            EXPECT_NE(problem.message.find("kaya-zone-path.csv"), std::string::npos);
        }
    }
}

/// A model whose rows influence each other, that is stiffer than it reports and creates energy.
ptrdiff_t run_badly(kaya_zbatch* batch) {
    double sum = 0;
    for (std::size_t i = 0; i < batch->n; ++i) sum += batch->strain_inc[2][i];
    for (std::size_t i = 0; i < batch->n; ++i) {
        batch->stress[2][i] += 1e10 * sum;
        batch->dissipation[i] = -1;
    }
    return -1;
}

TEST_F(Bench, WhatNoZoneModelShouldDoIsFound) {
    static const kaya_zproperty properties[] = {{"bulk", "", "stress", "bulk modulus", 1e9, 0, INFINITY, 0, 0},
                                                {"shear", "", "stress", "shear modulus", 1e9, 0, INFINITY, 0, 0}};
    static const kaya_zmodel bad{KAYA_ZMODEL_INTERFACE,
                                 sizeof(kaya_zmodel),
                                 "bad",
                                 "bad",
                                 "1",
                                 properties,
                                 2,
                                 nullptr,
                                 0,
                                 "",
                                 0,
                                 run_badly,
                                 nullptr,
                                 [](const double* p, double* bulk, double* shear) { *bulk = p[0], *shear = p[1]; }};
    const ZoneModel model(&bad, "bad.so", nullptr);
    ZonePath path;
    path.points = {{{}, 0}, {{0, 0, -1e-3, 0, 0, 0}, 1}};
    const ZoneCurve curve = follow_zone_path(model, {1e9, 1e9}, path, start(0));
    ASSERT_EQ(curve.findings.size(), 3u);
    EXPECT_NE(curve.findings[0].text.find("gives out work"), std::string::npos);
    EXPECT_NE(curve.findings[1].text.find("as stiff as moduli() says"), std::string::npos);
    EXPECT_NE(curve.findings[2].text.find("rows next to it"), std::string::npos);
}

} // namespace
} // namespace kaya
