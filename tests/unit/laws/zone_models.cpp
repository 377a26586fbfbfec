// Every zone model that ships, one zone at a time: strength compared with closed forms, and requirements on any path.
#include "one_zone.hpp"

#include "base/diagnostic.hpp"
#include "laws/zone_trial.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace kaya {

using namespace one_zone;

namespace {

TEST(ZoneModels, EachShippedModelIsTestedHere) {
    JointRegistry shipped; // other tests load models of other folders
    shipped.set_path({KAYA_TEST_JOINTS});
    EXPECT_EQ(all_zones().size(), shipped.zones.available().size());
}

TEST(ZoneModels, MohrCoulombFailsAtItsTriaxialStrength) {
    for (const double friction : {0.0, 20.0, 45.0})
        for (const double side : {0.0, 1e5, 2e6}) {
            Zone zone("mohr-coulomb",
                      with({{"cohesion", 3e5}, {"friction", friction}, {"dilation", friction / 3}, {"tension", 1e4}}));
            const double n = std::pow(std::tan((45 + friction / 2) * M_PI / 180), 2),
                         found = zone.axial_strength(side, 2e-4, 60);
            EXPECT_NEAR(found / (n * zone.side_pressure() + 2 * 3e5 * std::sqrt(n)), 1, 1e-6)
                << friction << " " << side;
            EXPECT_NEAR(found / (n * side + 2 * 3e5 * std::sqrt(n)), 1, 1e-4) << friction << " " << side;
        }
}

TEST(ZoneModels, HoekBrownFailsOnItsCurve) {
    for (const double side : {0.0, 1e5, 3e6}) {
        Zone zone("hoek-brown",
                  with({{"constant-sci", 3e7}, {"constant-mb", 1.7}, {"constant-s", 0.0039}, {"dilation", 10}}));
        const double found = zone.axial_strength(side, 2e-4, 80);
        const auto exact = [](double s3) { return s3 + 3e7 * std::sqrt(1.7 * s3 / 3e7 + 0.0039); };
        EXPECT_NEAR(found / exact(zone.side_pressure()), 1, 1e-6) << side;
        EXPECT_NEAR(found / exact(side), 1, 1e-3) << side;
    }
}

TEST(ZoneModels, DruckerPragerFailsOnItsCone) {
    for (const double side : {1e5, 2e6}) {
        Zone zone(
            "drucker-prager",
            with({{"cohesion-drucker", 3e5}, {"friction-drucker", 0.3}, {"dilation-drucker", 0.1}, {"tension", 1e9}}));
        // (sa - sr)/sqrt(3) = k + q (sa + 2 sr)/3
        const double found = zone.axial_strength(side, 2e-4, 80);
        const double exact = (3e5 + zone.side_pressure() * (0.2 + 1 / std::sqrt(3))) / (1 / std::sqrt(3) - 0.1);
        EXPECT_NEAR(found / exact, 1, 1e-6) << side;
        EXPECT_NEAR(zone.side_pressure() / side, 1, 1e-4);
    }
}

TEST(ZoneModels, WeakPlanesCarryTheirStrengthAndNoMore) {
    std::mt19937 random(4);
    for (const double dip : {0.0, 35.0, 60.0, 90.0}) {
        constexpr double cohesion = 1e5, cut = 2e4, dip_direction = 37, degree = M_PI / 180;
        const double tangent = std::tan(30 * degree);
        Zone zone("ubiquitous-joint", with({{"cohesion", 1e7},
                                            {"friction", 40},
                                            {"tension", 1e7},
                                            {"joint-cohesion", cohesion},
                                            {"joint-friction", 30},
                                            {"joint-dilation", 8},
                                            {"joint-tension", cut},
                                            {"dip", dip},
                                            {"dip-direction", dip_direction}}));
        const Eigen::Vector3d normal(std::sin(dip * degree) * std::sin(dip_direction * degree),
                                     std::sin(dip * degree) * std::cos(dip_direction * degree), std::cos(dip * degree));
        int slips = 0, openings = 0;
        for (int i = 0; i < 40000; ++i) {
            zone.strain(random_strain(random, 5e-6));
            const Eigen::Vector3d traction = matrix(zone.stress) * normal;
            const double across = traction.dot(normal), along = (traction - across * normal).norm();
            ASSERT_LE(along + across * tangent, (1 + 1e-9) * cohesion + 1e-9 * along) << dip << " in step " << i;
            ASSERT_LE(across, (1 + 1e-9) * cut + 1e-9 * along) << dip << " in step " << i;
            constexpr std::uint32_t shear = 16, tension = 32;
            if ((zone.state & tension) != 0) {
                ++openings;
                ASSERT_NEAR(across / cut, 1, 1e-6) << dip << " in step " << i;
            } else if ((zone.state & shear) != 0) {
                ++slips;
                ASSERT_NEAR((along + across * tangent) / cohesion, 1, 1e-6) << dip << " in step " << i;
            }
        }
        EXPECT_GT(slips, 100);
        EXPECT_GT(openings, 5);
    }
}

TEST(ZoneModels, ARotatedPathGivesRotatedStresses) {
    std::mt19937 random(1);
    for (const Zone& fresh : all_zones()) {
        if (fresh.model.find_property("dip"))
            continue; // its planes turn with the rock, not with the path: turning_zones.cpp
        const Eigen::Matrix3d turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
        Zone one = fresh, other = fresh;
        for (int i = 0; i < 500; ++i) {
            const Tensor step = random_strain(random, 2e-5);
            one.strain(step);
            other.strain(tensor(turn * matrix(step) * turn.transpose()));
            const Eigen::Matrix3d difference = turn * matrix(one.stress) * turn.transpose() - matrix(other.stress);
            ASSERT_LE(difference.norm(), 1e-8 * (1e5 + one.stress.norm())) << one.model.name << " in step " << i;
            ASSERT_EQ(one.state, other.state) << one.model.name << " in step " << i;
        }
    }
}

/// Upward normal of a plane.
Eigen::Vector3d normal_of(double dip, double dip_direction) {
    const double d = dip * M_PI / 180, dd = dip_direction * M_PI / 180;
    return {std::sin(d) * std::sin(dd), std::sin(d) * std::cos(dd), std::cos(d)};
}

using Given = std::vector<std::pair<std::string, double>>;

/// Random anisotropic rock with positive work for any strain.
Given anisotropic_rock(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform;
    const double plane = 1e9 * std::pow(10, 2 * uniform(random)), normal = 1e9 * std::pow(10, 2 * uniform(random)),
                 poisson = 0.9 * uniform(random) - 0.4;
    const double most = std::sqrt((1 - poisson) * normal / plane / 2);
    return {{"young-plane", plane},
            {"young-normal", normal},
            {"poisson-plane", poisson},
            {"poisson-normal", 0.95 * most * (2 * uniform(random) - 1)},
            {"shear-normal", 3e8 * std::pow(10, 2 * uniform(random))}};
}

TEST(ZoneModels, RotatedAnisotropicRockGivesRotatedStresses) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform;
    for (int family = 0; family < 50; ++family) {
        Given level = anisotropic_rock(random), turned = level;
        const double dip = 90 * uniform(random), dip_direction = 360 * uniform(random);
        turned.insert(turned.end(), {{"dip", dip}, {"dip-direction", dip_direction}});
        const Eigen::Vector3d normal = normal_of(dip, dip_direction), strike = normal_of(90, dip_direction + 90);
        Eigen::Matrix3d turn;
        turn << strike, normal.cross(strike), normal;
        Zone one("anisotropic-elastic", level), other("anisotropic-elastic", turned);
        for (int i = 0; i < 20; ++i) {
            const Tensor step = random_strain(random, 1e-4);
            one.strain(step);
            other.strain(tensor(turn * matrix(step) * turn.transpose()));
        }
        const Eigen::Matrix3d difference = turn * matrix(one.stress) * turn.transpose() - matrix(other.stress);
        EXPECT_LE(difference.norm(), 1e-12 * one.stress.norm()) << family;
    }
}

using Square = std::array<std::array<double, 6>, 6>;

/// Stiffness in six components of equal weight, computed strain by strain.
Square stiffness_of(const Given& given) {
    Square stiffness{};
    for (int k = 0; k < 6; ++k) {
        Zone zone("anisotropic-elastic", given);
        Tensor unit = Tensor::Zero();
        unit[k] = k < 3 ? 1 : std::sqrt(0.5);
        zone.strain(unit);
        for (int i = 0; i < 6; ++i) stiffness[i][k] = (i < 3 ? 1 : std::sqrt(2.0)) * zone.stress[i];
    }
    return stiffness;
}

/// Whether a symmetric matrix plus a multiple of the identity has only positive eigenvalues.
bool is_positive(Square m, double unit) {
    for (int k = 0; k < 6; ++k) m[k][k] += unit;
    for (int k = 0; k < 6; ++k) {
        if (!(m[k][k] > 0)) return false;
        for (int i = k + 1; i < 6; ++i)
            for (int j = k + 1; j < 6; ++j) m[i][j] -= m[i][k] * m[k][j] / m[k][k];
    }
    return true;
}

TEST(ZoneModels, ModuliOfAnisotropicRockBoundItsStiffnessAndNoMore) {
    std::mt19937 random(6);
    for (int family = 0; family < 200; ++family) {
        Given given = anisotropic_rock(random);
        given.insert(given.end(), {{"dip", 35}, {"dip-direction", 110}});
        const Square stiffness = stiffness_of(given);
        const Zone zone("anisotropic-elastic", given);
        const auto [bulk, shear] = zone.model.moduli(zone.values);
        const double scale = 3 * bulk + 2 * shear;
        Square left{};
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) {
                EXPECT_NEAR(stiffness[i][j], stiffness[j][i], 1e-12 * scale) << family;
                left[i][j] =
                    (i == j ? 2 * shear : 0) + (i < 3 && j < 3 ? bulk - 2.0 / 3.0 * shear : 0) - stiffness[i][j];
            }
        EXPECT_TRUE(is_positive(stiffness, 0)) << family;
        EXPECT_TRUE(is_positive(left, 1e-10 * scale)) << family;
        EXPECT_FALSE(is_positive(left, -1e-7 * scale)) << family << ": a softer one would do";
    }
    const Zone isotropic(
        "anisotropic-elastic",
        {{"young-plane", 5e9}, {"young-normal", 5e9}, {"poisson-plane", 0.25}, {"poisson-normal", 0.25}});
    const auto [bulk, shear] = isotropic.model.moduli(isotropic.values);
    EXPECT_NEAR(bulk / (5e9 / 1.5), 1, 1e-12);
    EXPECT_NEAR(shear / 2e9, 1, 1e-12); // shear-normal of (3) is that of isotropic rock
}

TEST(ZoneModels, AnisotropicRockThatReleasesWorkIsRefused) {
    const ZoneModel& model = models().get("anisotropic-elastic");
    const auto said = [&](double plane, double normal, double poisson_plane, double poisson_normal, double shear) {
        return model.check({plane, normal, poisson_plane, poisson_normal, shear, 0, 0});
    };
    EXPECT_EQ(said(4e9, 1e9, 0.2, 0.3, 5e8), "");
    EXPECT_EQ(said(4e9, 1e9, 0.2, 0.3, NAN), "");
    EXPECT_THAT(said(4e9, 1e9, 0.2, 0.32, 5e8), testing::HasSubstr("give out work"));
    EXPECT_THAT(said(0, 1e9, 0.2, 0.1, 5e8), testing::HasSubstr("above 0"));
    EXPECT_THAT(said(4e9, 1e9, 1, 0, 5e8), testing::HasSubstr("poisson-plane"));
    EXPECT_THAT(said(4e9, 1e9, 0.2, 0.1, 0), testing::HasSubstr("shear-normal"));
}

TEST(ZoneModels, FlowTakesEnergyAndGivesNone) {
    std::mt19937 random(2);
    for (const Zone& fresh : all_zones()) {
        Zone zone = fresh;
        double put_in = 0;
        const auto [bulk, shear] =
            fresh.model.moduli(fresh.values); // with the largest moduli: a lower bound of the stored energy
        const auto stored = [bulk = bulk, shear = shear](const Zone& z) {
            const double mean = z.stress.head<3>().sum() / 3;
            Tensor deviator = z.stress;
            deviator.head<3>().array() -= mean;
            return mean * mean / (2 * bulk) +
                   (deviator.head<3>().squaredNorm() + 2 * deviator.tail<3>().squaredNorm()) / (4 * shear);
        };
        for (int i = 0; i < 40000; ++i) {
            const Tensor step = random_strain(random, 5e-7), before = zone.stress;
            zone.strain(step);
            const Tensor mean = 0.5 * (before + zone.stress);
            put_in += mean.head<3>().dot(step.head<3>()) + 2 * mean.tail<3>().dot(step.tail<3>());
            ASSERT_GE(put_in, 0.98 * stored(zone) - 1) << zone.model.name << " in step " << i;
        }
        if (zone.model.flows()) {
            EXPECT_GT(zone.dissipated, 0) << zone.model.name;
            EXPECT_LE(zone.dissipated, 1.02 * put_in) << zone.model.name;
        }
    }
}

TEST(ZoneModels, OneLargeStepEndsOnTheSurfaceAsManySmallOnesDo) {
    for (const double size : {1e-4, 1e-2, 1.0}) {
        Zone zone("mohr-coulomb", with({{"cohesion", 1e5}, {"friction", 30}, {"dilation", 0}, {"tension", 2e4}}));
        std::mt19937 random(3);
        for (int i = 0; i < 2000; ++i) {
            zone.stress.setZero();
            zone.strain(random_strain(random, size));
            const Eigen::Vector3d s = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix(zone.stress)).eigenvalues();
            const double scale = 1e5 + s.cwiseAbs().maxCoeff() + 1e9 * size * 1e-3;
            ASSERT_LE(3 * s[2] - s[0] - 2 * 1e5 * std::sqrt(3), 1e-9 * scale) << size << " " << i;
            ASSERT_LE(s[2] - 2e4, 1e-9 * scale) << size << " " << i;
        }
    }
}

TEST(ZoneModels, NoStrainChangesNothing) {
    for (const Zone& fresh : all_zones()) {
        Zone zone = fresh;
        Tensor step = Tensor::Zero();
        step[2] = -1e-4;
        zone.strain(step);
        const Tensor before = zone.stress;
        for (int i = 0; i < 1000; ++i) zone.strain(Tensor::Zero());
        EXPECT_LE((zone.stress - before).norm(), 1e-9 * before.norm()) << zone.model.name;
    }
}

std::string refusal(const std::string& name) {
    try {
        models().get(std::string(KAYA_TEST_PLUGINS) + "/zones/" + name + ".so");
    } catch (const Diagnostic& error) { return error.code + ": " + error.message; }
    return "taken";
}

TEST(ZoneModels, InvalidModelsAreRefusedWhenLoaded) {
    EXPECT_THAT(refusal("version-99"),
                testing::HasSubstr("was built for interface version 99, this program has version 2"));
    EXPECT_THAT(refusal("null-run"), testing::HasSubstr("'run' is NULL"));
    EXPECT_THAT(refusal("crashes-at-load"), testing::HasSubstr("crashes when it is loaded (signal 11)"));
    EXPECT_THAT(refusal("not-there"), testing::HasSubstr("there is no zone model file"));
    try {
        models().get("mohr-colomb");
        FAIL();
    } catch (const Diagnostic& error) { EXPECT_EQ(error.hint, "did you mean 'mohr-coulomb'?"); }
}

TEST(ZoneModels, FailuresInAStepNameTheRow) {
    const std::pair<double, const char*> cases[] = {
        {1, "zone model misbehaves threw an exception in a batch that begins here: it does not like this zone"},
        {2, "zone model misbehaves returned xy stress nan"},
        {3, "zone model misbehaves returned row 1 of a batch of 1 rows, which begins here"},
        {4, "zone model misbehaves failed: the rock is tired"},
        {5, "zone model misbehaves returned kept nan"}};
    const ZoneModel& model = models().get(std::string(KAYA_TEST_PLUGINS) + "/zones/misbehaves.so");
    for (const auto& [what, message] : cases) {
        double stress[6] = {}, strain[6] = {}, one = 1, none = 0, kept = 0;
        std::uint32_t state = 0;
        double* columns[1] = {&kept};
        const std::vector<double> values{1, 1, what};
        kaya_zbatch batch{};
        batch.n = 1;
        batch.properties = values.data();
        batch.volume = &one;
        batch.pore_pressure = &none;
        batch.dissipation = &none;
        batch.state = &state;
        batch.history = columns;
        for (int k = 0; k < 6; ++k) {
            batch.strain_inc[k] = &strain[k];
            batch.stress[k] = &stress[k];
        }
        const auto failure = model.run(batch);
        ASSERT_TRUE(failure) << what;
        EXPECT_EQ(failure->row, 0u);
        EXPECT_EQ(failure->message, message);
    }
}

TEST(ZoneModels, WritesToReadOnlyColumnsAreFoundBeforeTheRun) {
    const ZoneModel& model = models().get(std::string(KAYA_TEST_PLUGINS) + "/zones/hostile.so");
    try_zone(model, {2e8, 1e8, 0});
    for (const auto& [what, sentence] : {std::pair{10.0, "wrote to 'strain_inc', which it may only read"},
                                         std::pair{11.0, "wrote after the column 'stress'"}}) {
        try {
            try_zone(model, {2e8, 1e8, what});
            ADD_FAILURE() << what;
        } catch (const Diagnostic& error) {
            EXPECT_THAT(error.message, testing::HasSubstr(sentence));
            EXPECT_EQ(error.code, "zone-model-trespass");
        }
    }
    for (const Zone& zone : all_zones()) try_zone(zone.model, zone.values);
}

} // namespace
} // namespace kaya
