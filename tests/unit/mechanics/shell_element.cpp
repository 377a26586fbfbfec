// Triangles of a plate: patches of constant strain and curvature on distorted meshes, motions as a rigid body, balance.
#include "mechanics/structures/shell_element.hpp"

#include "random_motions.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace kaya;
using namespace kaya::test;

namespace {

const ShellSection section{.thickness = 0.2, .young = 3e4, .poisson = 0.3};
const ShellResultants nothing_kept = ShellResultants::Zero();

/// A square of 4 by 4 cells, each divided into two triangles; inner nodes are displaced by up to a third of a cell.
struct Patch {
    std::vector<Vec3> places; ///< in the plane z = 0
    std::vector<std::array<int, 3>> triangles;

    explicit Patch(Random& random) {
        for (int j = 0; j <= 4; ++j)
            for (int i = 0; i <= 4; ++i)
                places.emplace_back(i + (inner(i, j) ? random(0.33) : 0), j + (inner(i, j) ? random(0.33) : 0), 0);
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const int a = 5 * j + i;
                if ((i + j) % 2) {
                    triangles.push_back({a, a + 1, a + 6});
                    triangles.push_back({a, a + 6, a + 5});
                } else {
                    triangles.push_back({a + 1, a + 6, a + 5});
                    triangles.push_back({a, a + 1, a + 5});
                }
            }
    }
    static bool inner(int i, int j) { return i > 0 && j > 0 && i < 4 && j < 4; }
    bool inner(std::size_t node) const { return inner(static_cast<int>(node) % 5, static_cast<int>(node) / 5); }
};

struct Motion {
    Vec3 shift, rotation;
};

struct PatchForces {
    std::vector<EndForce> nodes;
    std::vector<ShellForces> elements;
};

/// Forces of a patch in a frame, whose nodes move by a small motion in that frame, and then with the frame.
template <class Move>
PatchForces forces_of(const Patch& patch, const Mat3& frame, const Mat3& turn, const Vec3& far, const Move& move) {
    std::vector<NodePose> poses;
    for (const Vec3& place : patch.places) {
        const Motion m = move(place);
        poses.push_back(
            {far + turn * frame * (place + m.shift), turn * frame * turn_of(m.rotation) * frame.transpose()});
    }
    PatchForces result;
    result.nodes.resize(poses.size());
    for (const auto& t : patch.triangles) {
        const auto at = [&](int k) { return static_cast<std::size_t>(t[static_cast<std::size_t>(k)]); };
        const ShellShape shape({frame * patch.places[at(0)], frame * patch.places[at(1)], frame * patch.places[at(2)]},
                               section);
        result.elements.push_back(shell_forces(shape, {poses[at(0)], poses[at(1)], poses[at(2)]}, nothing_kept));
        for (int k = 0; k < 3; ++k) {
            result.nodes[at(k)].force += result.elements.back().ends[static_cast<std::size_t>(k)].force;
            result.nodes[at(k)].moment += result.elements.back().ends[static_cast<std::size_t>(k)].moment;
        }
    }
    return result;
}

/// A symmetric tensor of an element in the axes of the patch.
Eigen::Matrix2d in_patch(const ShellForces& element, const Vec3& value, const Mat3& frame) {
    Eigen::Matrix2d own;
    own << value[0], value[2], value[2], value[1];
    const Eigen::Matrix2d turn = (frame.transpose() * element.axes).topLeftCorner<2, 2>();
    return turn * own * turn.transpose();
}

} // namespace

TEST(ShellElement, FeelsNoRigidMotion) {
    Random random(1);
    for (int k = 0; k < 20; ++k) {
        const Patch patch(random);
        const PatchForces f = forces_of(patch, random.turn(), random.turn(), random.vector(10), [](const Vec3&) {
            return Motion{Vec3::Zero(), Vec3::Zero()};
        });
        for (const auto& node : f.nodes) {
            EXPECT_LT(node.force.norm(), 1e-9);
            EXPECT_LT(node.moment.norm(), 1e-9);
        }
    }
}

TEST(ShellElement, PassesThePatchOfConstantStrain) {
    Random random(2);
    for (int k = 0; k < 20; ++k) {
        const Patch patch(random);
        const double exx = random(1e-6), eyy = random(1e-6), exy = random(1e-6), spin = random(1e-6);
        const Mat3 frame = random.turn(), turn = random.turn();
        const PatchForces f = forces_of(patch, frame, turn, random.vector(3), [&](const Vec3& x) {
            return Motion{{exx * x[0] + (exy - spin) * x[1], (exy + spin) * x[0] + eyy * x[1], 0}, {0, 0, spin}};
        });
        const double size = section.young * section.thickness * 1e-6;
        for (std::size_t node = 0; node < f.nodes.size(); ++node) {
            if (patch.inner(node)) { EXPECT_LT(f.nodes[node].force.norm(), 1e-5 * size); }
            EXPECT_LT(f.nodes[node].moment.norm(), 1e-5 * size);
        }
        const double plane = section.young * section.thickness / (1 - section.poisson * section.poisson);
        for (const auto& element : f.elements) {
            const Eigen::Matrix2d n = in_patch(element, element.membrane, turn * frame);
            EXPECT_NEAR(n(0, 0), plane * (exx + section.poisson * eyy), 1e-5 * size);
            EXPECT_NEAR(n(1, 1), plane * (eyy + section.poisson * exx), 1e-5 * size);
            EXPECT_NEAR(n(0, 1), plane * (1 - section.poisson) * exy, 1e-5 * size);
        }
    }
}

TEST(ShellElement, PassesThePatchOfConstantCurvature) {
    Random random(3);
    for (int k = 0; k < 20; ++k) {
        const Patch patch(random);
        const double kxx = random(1e-7), kyy = random(1e-7), kxy = random(1e-7); // of w
        const Mat3 frame = random.turn(), turn = random.turn();
        const PatchForces f = forces_of(patch, frame, turn, random.vector(3), [&](const Vec3& x) {
            const double w = 0.5 * kxx * x[0] * x[0] + 0.5 * kyy * x[1] * x[1] + kxy * x[0] * x[1];
            return Motion{{0, 0, w}, {kyy * x[1] + kxy * x[0], -kxx * x[0] - kxy * x[1], 0}};
        });
        const double plate = section.young * std::pow(section.thickness, 3) /
                             (12 * (1 - section.poisson * section.poisson)),
                     size = plate * 1e-7;
        for (std::size_t node = 0; node < f.nodes.size(); ++node) {
            if (!patch.inner(node)) continue;
            EXPECT_LT(f.nodes[node].force.norm(), 1e-3 * size); // bending stretches the plane to second order
            EXPECT_LT(f.nodes[node].moment.norm(), 1e-3 * size);
        }
        for (const auto& element : f.elements) {
            const Eigen::Matrix2d m = in_patch(element, element.moment, turn * frame);
            EXPECT_NEAR(m(0, 0), -plate * (kxx + section.poisson * kyy), 1e-3 * size);
            EXPECT_NEAR(m(1, 1), -plate * (kyy + section.poisson * kxx), 1e-3 * size);
            EXPECT_NEAR(m(0, 1), -plate * (1 - section.poisson) * kxy, 1e-3 * size);
        }
    }
}

TEST(ShellElement, IsInBalanceHoweverItIsDeformed) {
    Random random(4);
    for (int k = 0; k < 200; ++k) {
        std::array<Vec3, 3> corners{random.vector(1), random.vector(1), random.vector(1)};
        const ShellShape shape(corners, section);
        if (shape.area < 0.1) continue;
        std::array<NodePose, 3> nodes;
        for (std::size_t i = 0; i < 3; ++i) nodes[i] = {corners[i] + random.vector(0.05), turn_of(random.vector(0.3))};
        const ShellForces f = shell_forces(shape, nodes, nothing_kept);
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        double size = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            force += f.ends[i].force;
            moment += f.ends[i].moment + nodes[i].place.cross(f.ends[i].force);
            size += f.ends[i].force.norm() + f.ends[i].moment.norm();
        }
        EXPECT_LT(force.norm(), 1e-12 * size);
        EXPECT_LT(moment.norm(), 1e-12 * size);
    }
}

TEST(ShellElement, IsNoStifferThanItsBound) {
    Random random(5);
    for (int k = 0; k < 50; ++k) {
        const std::array<Vec3, 3> corners{random.vector(1), random.vector(1), random.vector(1)};
        const ShellShape shape(corners, section);
        if (shape.area < 0.1) continue;
        const EndStiffness bound = shell_end_stiffness(shape);
        double most = 0;
        for (int i = 0; i < 300; ++i) {
            std::array<NodePose, 3> nodes;
            std::array<Vec3, 3> shift, rotation;
            double allowed = 0, energy = 0;
            for (std::size_t n = 0; n < 3; ++n) {
                shift[n] = 1e-7 * random.vector(1);
                rotation[n] = 1e-7 * random.vector(1);
                nodes[n] = {corners[n] + shift[n], turn_of(rotation[n])};
                allowed += bound.translation * shift[n].squaredNorm() + bound.rotation * rotation[n].squaredNorm();
            }
            const ShellForces f = shell_forces(shape, nodes, nothing_kept);
            for (std::size_t n = 0; n < 3; ++n)
                energy -= f.ends[n].force.dot(shift[n]) + f.ends[n].moment.dot(rotation[n]);
            most = std::max(most, energy / allowed);
        }
        EXPECT_LE(most, 1 + 1e-4);
        EXPECT_GT(most, 0.1);
    }
}
