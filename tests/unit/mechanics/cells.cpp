#include "mechanics/zones/cells.hpp"
#include "mechanics/zones/zone_frequencies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace kaya {
namespace {

using Field = std::function<Vec3(const Vec3&)>;

/// Eight cells: corners of boxes of 2 by 1 by 0.5, randomly displaced.
struct EightCells {
    explicit EightCells(double distortion, unsigned seed = 11) {
        std::mt19937 random(seed);
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

constexpr double lambda = 1.2e9, two_shear = 1.6e9;
const LayerModuli moduli(lambda, two_shear);

/// Cells whose faces with a set bit are ruled surfaces.
RuledFaces faces(std::uint8_t bits) {
    std::array<std::uint8_t, eight> of_cells;
    of_cells.fill(bits);
    return RuledFaces(of_cells.data());
}
constexpr std::uint8_t no_face = 0, every_face = 63;

/// Adds the stress of the warps of a motion. Returns its work.
Eight add_warp_stress(const CellMotion& motion, WarpStress& stress) {
    const WarpStep step(motion);
    const WarpStress change = step.elastic(motion, moduli);
    const Eight work = step.work(motion.volume, added(stress, 0.5, change));
    stress = added(stress, 1, change);
    return work;
}

/// The warping forces of cells after a motion from zero. Returns its work.
Eight warp(const EightCells& cells, const Field& motion, WarpStress& stress) {
    const CellShape shape(cells.corners(), faces(every_face));
    stress = {};
    return add_warp_stress(CellMotion(shape, cells.values(motion), false), stress);
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
    Mat3 gradient;
    gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
    const double strain[6] = {1, 5, 9, -1, 5, -1}, spin[3] = {-14, -4, -6};
    for (const std::uint8_t ruled : {no_face, std::uint8_t{9}, std::uint8_t{22}, every_face}) {
        const CellShape shape(cells.corners(), faces(ruled));
        const CellMotion motion(shape, cells.values([&](const Vec3& x) { return Vec3(gradient * x); }), false);
        for (int l = 0; l < 8; ++l) {
            for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(motion.strain[k][l], strain[k], 1e-12);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(4 * of_lane(motion.half_spin, l)[k], spin[k], 1e-12);
        }
    }
}

TEST(Cells, ALargeRigidRotationCausesNoStrain) {
    const EightCells before(0.15);
    EightCells after = before;
    const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, -2, 3).normalized()).toRotationMatrix();
    for (auto& corner : after.place)
        for (Vec3& x : corner) x = turn * x;
    const CellShape shape(after.corners(), faces(every_face));
    const CellMotion motion(shape, after.values([&](const Vec3& x) { return Vec3(x - turn.transpose() * x); }), true);
    const Vec3 half_spin = std::tan(0.4) * Vec3(1, -2, 3).normalized();
    for (int l = 0; l < 8; ++l) {
        for (const Eight& strain : motion.strain) EXPECT_NEAR(strain[l], 0, 1e-14);
        for (const Eight3& g : motion.warp) EXPECT_LT(of_lane(g, l).norm(), 1e-14);
        EXPECT_LT((of_lane(motion.half_spin, l) - half_spin).norm(), 1e-14);
    }
}

// Each corner of a box has a quarter of its faces if they are ruled; of two triangles a third or a sixth.
TEST(Cells, CornersHaveAQuarterOfARuledFace) {
    const EightCells boxes(0);
    const Vec3 quarter(0.5 * 0.25, 1.0 * 0.25, 2.0 * 0.25); // faces 1 by 0.5, 0.5 by 2, 2 by 1
    const CellShape shape(boxes.corners(), faces(every_face)), triangles(boxes.corners(), faces(no_face));
    for (unsigned c = 1; c < 8; ++c)
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(of_lane(shape.gradient[c - 1], 0)[k], c >> k & 1 ? quarter[k] : -quarter[k], 1e-15);
        }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(of_lane(triangles.gradient[6], 0)[k], quarter[k] * 4 / 3, 1e-15);
}

/// Forces of a uniform stress on the corners of cells.
CellForces even_forces(const EightCells& cells, std::uint8_t ruled) {
    const SixEights stress{eights(-1), eights(-2), eights(-4), eights(0.5), eights(0.25), eights(-0.75)};
    return forces_of(CellShape(cells.corners(), faces(ruled)), stress, WarpStress{});
}

// The face at the end of an axis of one cell is the one at the start of that axis of the other.
TEST(Cells, AUniformStressPassesThroughARuledFace) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        const EightCells first(0.15);
        EightCells second(0.15, 12);
        const unsigned bit = 1U << axis;
        for (unsigned c = 0; c < 8; ++c) {
            for (std::size_t l = 0; l < 8; ++l)
                second.place[c][l] += Vec3(4.0 * (bit == 1), 2.0 * (bit == 2), 1.0 * (bit == 4));
            if ((c & bit) == 0) second.place[c] = first.place[c | bit];
        }
        const std::uint8_t high = static_cast<std::uint8_t>(8U << axis), low = static_cast<std::uint8_t>(1U << axis);
        const CellForces two[2] = {even_forces(first, high), even_forces(second, low)},
                         triangles[2] = {even_forces(first, no_face), even_forces(second, no_face)};
        for (unsigned c = 0; c < 8; ++c)
            for (int l = 0; l < 8; ++l) {
                if (c & bit) {
                    const Vec3 change = of_lane(two[0][c] - triangles[0][c], l);
                    EXPECT_GT(change.norm(), 1e-3);
                    EXPECT_LT((change + of_lane(two[1][c - bit] - triangles[1][c - bit], l)).norm(), 1e-13);
                } else {
                    EXPECT_LT(of_lane(two[0][c] - triangles[0][c], l).norm(), 1e-14);
                }
            }
    }
}

/// The stiffness matrix of an elastic cell, corner by corner.
Eigen::MatrixXd stiffness_of(const EightCells& cells, const RuledFaces& ruled, int lane) {
    const CellShape shape(cells.corners(), ruled);
    Eigen::MatrixXd stiffness(24, 24);
    for (int i = 0; i < 24; ++i) {
        std::array<std::array<Vec3, 8>, 8> motion;
        for (auto& corner : motion) corner.fill(Vec3::Zero());
        for (Vec3& v : motion[static_cast<std::size_t>(i / 3)]) v[i % 3] = 1;
        const CellMotion step(shape, EightCells::loaded(motion), false);
        WarpStress warped{};
        add_warp_stress(step, warped);
        const Eight mean = lambda * (step.strain[0] + step.strain[1] + step.strain[2]);
        SixEights stress;
        for (std::size_t k = 0; k < 6; ++k) stress[k] = two_shear * step.strain[k] + (k < 3 ? mean : Eight{});
        const CellForces forces = forces_of(shape, stress, warped);
        for (int c = 0; c < 8; ++c)
            for (int k = 0; k < 3; ++k)
                stiffness(3 * c + k, i) = -of_lane(forces[static_cast<std::size_t>(c)], lane)[k];
    }
    return stiffness;
}

/// The bound of the time step for the six zones, by corner: equation (7) of docs/theory/time-step.md.
std::array<double, 8> bounds_of(const EightCells& cells, std::size_t lane) {
    std::array<double, 8> bound{};
    for (const auto& zone : corners_of_zone) {
        Mat3 edges;
        for (int k = 0; k < 3; ++k)
            edges.row(k) = cells.place[zone[static_cast<std::size_t>(k) + 1]][lane] - cells.place[zone[0]][lane];
        const Mat3 gradients = edges.inverse();
        const Vec3 first = -gradients.rowwise().sum();
        const Mat3 squares = gradients * gradients.transpose() + first * first.transpose();
        const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(squares).eigenvalues()[2];
        for (const std::size_t c : zone)
            bound[c] += (lambda * squares.trace() + two_shear * largest) * edges.determinant() / 6;
    }
    return bound;
}

TEST(Cells, AreNotStifferThanTheBoundOfTheirZones) {
    for (const double distortion : {0.0, 0.05, 0.1})
        for (unsigned seed = 1; seed <= 3; ++seed)
            for (const std::uint8_t ruled : {no_face, std::uint8_t{7}, std::uint8_t{18}, every_face})
                for (int l = 0; l < 8; ++l) {
                    const EightCells cells(distortion, seed);
                    const auto bound = bounds_of(cells, static_cast<std::size_t>(l));
                    Eigen::MatrixXd scaled = stiffness_of(cells, faces(ruled), l);
                    for (int i = 0; i < 24; ++i)
                        for (int j = 0; j < 24; ++j)
                            scaled(i, j) /= std::sqrt(bound[static_cast<std::size_t>(i / 3)] *
                                                      bound[static_cast<std::size_t>(j / 3)]);
                    EXPECT_LT((scaled - scaled.transpose()).norm(), 1e-12);
                    const Eigen::VectorXd values =
                        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
                    EXPECT_LT(values[23], 1);
                    EXPECT_GT(values[6], 1e-4); // only rigid motion has no energy
                }
}

TEST(Cells, AreNotStifferThanTheirOwnBound) {
    for (const double distortion : {0.0, 0.05, 0.1, 0.2})
        for (unsigned seed = 1; seed <= 5; ++seed)
            for (const std::uint8_t ruled : {no_face, std::uint8_t{7}, std::uint8_t{18}, every_face})
                for (int l = 0; l < 8; ++l) {
                    const EightCells cells(distortion, seed);
                    std::array<Vec3, 8> place;
                    for (std::size_t c = 0; c < 8; ++c) place[c] = cells.place[c][static_cast<std::size_t>(l)];
                    const Eigen::MatrixXd stiffness = stiffness_of(cells, faces(ruled), l);
                    const double greatest =
                        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly)
                            .eigenvalues()[23];
                    const double bound = stiffness_of_cell(place, {lambda, two_shear});
                    EXPECT_LT(greatest, bound) << distortion;
                    EXPECT_GT(greatest, 0.5 * bound) << distortion;
                }
}

TEST(Cells, ACommonVelocityOfAllCornersHasNoEffect) {
    const EightCells cells(0.15);
    const CellMotion motion(CellShape(cells.corners(), faces(every_face)),
                            cells.values([](const Vec3&) { return Vec3(1e6, 0.1, 1.0 / 3); }), true);
    for (const Eight& strain : motion.strain) EXPECT_TRUE(all_zero(strain));
    for (const Eight3& g : motion.warp) EXPECT_TRUE(all_zero(g));
}

TEST(Cells, VolumeAndTheSmallestZoneAreThoseOfTheSixZones) {
    constexpr std::size_t zones[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                         {0, 1, 7, 5}, {0, 4, 7, 6}, {0, 2, 7, 3}};
    const EightCells cells(0.15);
    const CellShape shape(cells.corners(), faces(no_face));
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
    const CellShape shape(cells.corners(), faces(22));
    const Field motion = [](const Vec3& x) {
        return Vec3(x.y() * x.z(), x.x() * x.y() * x.z(), x.x() * x.z() - x.x());
    };
    const CellMotion step(shape, cells.values(motion), false);
    WarpStress warped{};
    const Eight of_warping = add_warp_stress(step, warped);
    SixEights stress;
    for (std::size_t k = 0; k < 6; ++k) stress[k] = moduli.young * step.strain[k]; // of some law
    const CellForces forces = forces_of(shape, stress, warped);
    for (int l = 0; l < 8; ++l) {
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        double done = 0, size = 0, stored = 2 * of_warping[l]; // the forces increase from zero
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

// To a curvature k, with free transverse curvature of the section: E k^2/2 times the second moment of the section times the length.
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
