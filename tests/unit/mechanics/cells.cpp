#include "mechanics/cells.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace kaya {
namespace {

using Field = std::function<Vec3(const Vec3&)>;

/// Eight cells: corners of boxes of 2 by 1 by 0.5, moved by up to so much.
struct EightCells {
    explicit EightCells(double distortion) {
        std::mt19937 random(11);
        std::uniform_real_distribution<double> small(-distortion, distortion);
        for (unsigned c = 0; c < 8; ++c)
            for (std::size_t l = 0; l < 8; ++l) {
                place[c][l] = Vec3(2.0 * (c & 1), 1.0 * (c >> 1 & 1), 0.5 * (c >> 2 & 1));
                for (int k = 0; k < 3; ++k) place[c][l][k] += small(random);
            }
    }
    static CellField loaded(const std::array<std::array<Vec3, 8>, 8>& at) {
        CellField field;
        for (std::size_t c = 1; c < 8; ++c)
            for (std::size_t l = 0; l < 8; ++l) {
                const Vec3 from_first = at[c][l] - at[0][l];
                field[c - 1].x[static_cast<int>(l)] = from_first.x();
                field[c - 1].y[static_cast<int>(l)] = from_first.y();
                field[c - 1].z[static_cast<int>(l)] = from_first.z();
            }
        return field;
    }
    CellField corners() const { return loaded(place); }
    CellField values(const Field& field) const {
        auto at = place;
        for (auto& corner : at)
            for (Vec3& x : corner) x = field(x);
        return loaded(at);
    }

    std::array<std::array<Vec3, 8>, 8> place; ///< by corner and lane
};

Vec3 of_lane(const Eight3& v, int l) { return {v.x[l], v.y[l], v.z[l]}; }

const LayerModuli moduli(1.2e9, 1.6e9); // lambda and 2 G

/// What a motion adds to how cells resist warping, from nothing on. Returns its work.
Eight warp(const EightCells& cells, const Field& motion, WarpStress& stress) {
    const CellShape shape(cells.corners());
    stress = {};
    return add_warp_stress(shape, CellMotion(shape, cells.values(motion)).warp, moduli, stress);
}

TEST(Cells, AnEvenStrainAndARigidTurnDoNotWarp) {
    const EightCells cells(0.15);
    Mat3 gradient;
    gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
    WarpStress stress;
    const Eight work = warp(
        cells, [&](const Vec3& x) { return Vec3(gradient * x + Vec3(3, 2, 1)); }, stress);
    for (int l = 0; l < 8; ++l) {
        EXPECT_NEAR(work[l], 0, 1e-12);
        for (const Eight& s : stress) EXPECT_NEAR(s[l] / moduli.young, 0, 1e-12);
    }
}

TEST(Cells, AnEvenStrainIsFound) {
    const EightCells cells(0.15);
    const CellShape shape(cells.corners());
    Mat3 gradient;
    gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
    const CellMotion motion(shape, cells.values([&](const Vec3& x) { return Vec3(gradient * x); }));
    const double strain[6] = {1, 5, 9, -1, 5, -1}, spin[3] = {-14, -4, -6};
    for (int l = 0; l < 8; ++l) {
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(motion.strain[k][l], strain[k], 1e-12);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(4 * of_lane(motion.half_spin, l)[k], spin[k], 1e-12);
    }
}

TEST(Cells, WhatAllCornersHaveInCommonLeavesNothing) {
    const EightCells cells(0.15);
    const CellMotion motion(CellShape(cells.corners()),
                            cells.values([](const Vec3&) { return Vec3(1e6, 0.1, 1.0 / 3); }));
    for (const Eight& strain : motion.strain) EXPECT_TRUE(all_zero(strain));
    for (const Eight3& g : motion.warp) EXPECT_TRUE(all_zero(g));
}

TEST(Cells, VolumeAndTheSmallestZoneAreThoseOfTheSixZones) {
    constexpr std::size_t zones[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                         {0, 1, 7, 5}, {0, 4, 7, 6}, {0, 2, 7, 3}};
    const EightCells cells(0.15);
    const CellShape shape(cells.corners());
    for (std::size_t l = 0; l < 8; ++l) {
        double whole = 0, least = 1e9;
        for (const auto& zone : zones) {
            const auto at = [&](std::size_t a) { return Vec3(cells.place[zone[a]][l] - cells.place[0][l]); };
            const double six_volumes = at(1).dot(at(2).cross(at(3)));
            whole += six_volumes / 6;
            least = std::min(least, six_volumes);
        }
        EXPECT_NEAR(shape.volume[static_cast<int>(l)], whole, 1e-14);
        EXPECT_NEAR(shape.least[static_cast<int>(l)], least, 1e-14);
    }
}

TEST(Cells, ForcesAreInBalanceAndDoTheWork) {
    const EightCells cells(0.15);
    const CellShape shape(cells.corners());
    const Field motion = [](const Vec3& x) {
        return Vec3(x.y() * x.z(), x.x() * x.y() * x.z(), x.x() * x.z() - x.x());
    };
    const CellMotion step(shape, cells.values(motion));
    WarpStress warped{};
    const Eight of_warping = add_warp_stress(shape, step.warp, moduli, warped);
    SixEights stress;
    for (std::size_t k = 0; k < 6; ++k) stress[k] = moduli.young * step.strain[k]; // of some law
    const CellForces forces = forces_of(shape, stress, warped);
    for (int l = 0; l < 8; ++l) {
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        double done = 0, size = 0, stored = 2 * of_warping[l]; // the forces grow from nothing
        for (std::size_t k = 0; k < 6; ++k)
            stored += (k < 3 ? 1 : 2) * shape.volume[l] * stress[k][l] * step.strain[k][l];
        for (std::size_t c = 0; c < 8; ++c) {
            const Vec3 f = of_lane(forces[c], l), &x = cells.place[c][static_cast<std::size_t>(l)];
            force += f;
            moment += x.cross(f);
            done -= f.dot(motion(x));
            size += f.norm();
        }
        EXPECT_LT(force.norm(), 1e-12 * size);
        EXPECT_LT(moment.norm(), 1e-12 * size);
        EXPECT_GT(of_warping[l], 0);
        EXPECT_NEAR(done, stored, 1e-12 * done);
    }
}

// To a curvature k, with the section free to curve the other way: E k^2/2 times the second moment of the section times the length.
TEST(Cells, ABoxBendsAsABeam) {
    const EightCells cells(0);
    const double k = 1e-3, young = moduli.young, nu = 1.2 / (2 * (1.2 + 0.8));
    WarpStress stress;
    const Eight work = warp(
        cells,
        [&](const Vec3& x) {
            const double xm = x.x() - 1, ym = x.y() - 0.5, zm = x.z() - 0.25;
            return Vec3(k * xm * zm, -nu * k * ym * zm, 0);
        },
        stress);
    EXPECT_NEAR(work[0], 0.5 * young * k * k * (1.0 * 0.5 * 0.5 * 0.5 / 12) * 2, 1e-9 * work[0]);
}

TEST(Cells, ABoxTwistsInItsLayers) {
    const EightCells cells(0);
    const double a = 1e-3, shear = 0.5 * moduli.two_shear;
    WarpStress stress;
    const Eight work = warp(
        cells,
        [&](const Vec3& x) {
            const double xm = x.x() - 1, ym = x.y() - 0.5, zm = x.z() - 0.25;
            return Vec3(a * ym * zm, a * xm * zm, -a * xm * ym); // a saddle: layers of z shear by 2 a z, no others
        },
        stress);
    EXPECT_NEAR(work[0], 0.5 * shear * 4 * a * a * (1.0 * 0.5 * 0.5 * 0.5 / 12) * 2, 1e-9 * work[0]);
}

} // namespace
} // namespace kaya
