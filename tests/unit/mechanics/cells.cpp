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
    static EightCorners loaded(const std::array<std::array<Vec3, 8>, 8>& at) {
        EightCorners corners;
        for (std::size_t c = 0; c < 8; ++c)
            for (std::size_t l = 0; l < 8; ++l) {
                corners[c].x[static_cast<int>(l)] = at[c][l].x();
                corners[c].y[static_cast<int>(l)] = at[c][l].y();
                corners[c].z[static_cast<int>(l)] = at[c][l].z();
            }
        return corners;
    }
    EightCorners corners() const { return loaded(place); }
    EightCorners values(const Field& field) const {
        auto at = place;
        for (auto& corner : at)
            for (Vec3& x : corner) x = field(x);
        return loaded(at);
    }

    std::array<std::array<Vec3, 8>, 8> place; ///< by corner and lane
};

Vec3 of_lane(const Eight3& v, int l) { return {v.x[l], v.y[l], v.z[l]}; }

const LayerModuli moduli(1.2e9, 1.6e9); // lambda and 2 G

TEST(Cells, AnEvenStrainAndARigidTurnDoNotWarp) {
    const EightCells cells(0.15);
    Mat3 gradient;
    gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
    WarpStress stress{};
    const Eight work = add_warp_stress(CellShape(cells.corners()),
                                       cells.values([&](const Vec3& x) { return Vec3(gradient * x + Vec3(3, 2, 1)); }),
                                       moduli, stress);
    for (int l = 0; l < 8; ++l) {
        EXPECT_NEAR(work[l], 0, 1e-12);
        for (const Eight& s : stress) EXPECT_NEAR(s[l] / moduli.young, 0, 1e-12);
    }
}

TEST(Cells, GradientsAreThoseOfTheMeanOverTheZones) {
    const EightCells cells(0.15);
    const CellShape shape(cells.corners());
    Mat3 gradient;
    gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
    const EightCorners values = cells.values([&](const Vec3& x) { return Vec3(gradient * x); });
    for (int l = 0; l < 8; ++l) {
        Mat3 sum = Mat3::Zero();
        for (std::size_t c = 0; c < 8; ++c) sum += of_lane(values[c], l) * of_lane(shape.gradient[c], l).transpose();
        EXPECT_LT((sum - shape.volume[l] * gradient).norm(), 1e-12);
    }
}

TEST(Cells, ForcesAreInBalanceAndDoTheWork) {
    const EightCells cells(0.15);
    const CellShape shape(cells.corners());
    const EightCorners shift =
        cells.values([](const Vec3& x) { return Vec3(x.y() * x.z(), x.x() * x.y() * x.z(), x.x() * x.z() - x.x()); });
    WarpStress stress{};
    const Eight work = add_warp_stress(shape, shift, moduli, stress);
    const EightCorners forces = warp_forces(shape, stress);
    for (int l = 0; l < 8; ++l) {
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        double done = 0, size = 0;
        for (std::size_t c = 0; c < 8; ++c) {
            const Vec3 f = of_lane(forces[c], l);
            force += f;
            moment += cells.place[c][static_cast<std::size_t>(l)].cross(f);
            done -= f.dot(of_lane(shift[c], l));
            size += f.norm();
        }
        EXPECT_LT(force.norm(), 1e-12 * size);
        EXPECT_LT(moment.norm(), 1e-12 * size);
        EXPECT_GT(work[l], 0);
        EXPECT_NEAR(done, 2 * work[l], 1e-12 * done); // the forces grow from nothing
    }
}

// To a curvature k, with the section free to curve the other way: E k^2/2 times the second moment of the section times the length.
TEST(Cells, ABoxBendsAsABeam) {
    const EightCells cells(0);
    const double k = 1e-3, young = moduli.young, nu = 1.2 / (2 * (1.2 + 0.8));
    WarpStress stress{};
    const Eight work = add_warp_stress(CellShape(cells.corners()), cells.values([&](const Vec3& x) {
        const double xm = x.x() - 1, ym = x.y() - 0.5, zm = x.z() - 0.25;
        return Vec3(k * xm * zm, -nu * k * ym * zm, 0);
    }),
                                       moduli, stress);
    EXPECT_NEAR(work[0], 0.5 * young * k * k * (1.0 * 0.5 * 0.5 * 0.5 / 12) * 2, 1e-9 * work[0]);
}

TEST(Cells, ABoxTwistsInItsLayers) {
    const EightCells cells(0);
    const double a = 1e-3, shear = 0.5 * moduli.two_shear;
    WarpStress stress{};
    const Eight work = add_warp_stress(CellShape(cells.corners()), cells.values([&](const Vec3& x) {
        const double xm = x.x() - 1, ym = x.y() - 0.5, zm = x.z() - 0.25;
        return Vec3(a * ym * zm, a * xm * zm, -a * xm * ym); // a saddle: layers of z shear by 2 a z, no others
    }),
                                       moduli, stress);
    EXPECT_NEAR(work[0], 0.5 * shear * 4 * a * a * (1.0 * 0.5 * 0.5 * 0.5 / 12) * 2, 1e-9 * work[0]);
}

} // namespace
} // namespace kaya
