#include "mechanics/step/step_bounds.hpp"

#include "two_bricks.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace kaya {
namespace {

using test::Bench;

/// By iteration from a vector with all directions, in plain loops.
double largest_eigenvalue_of(const std::vector<double>& matrix, std::size_t n) {
    std::vector<double> x(n), y(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = 1 + std::sin(37.0 * static_cast<double>(i));
    double value = 0;
    for (int step = 0; step < 3000; ++step) {
        double square = 0, along = 0, before = 0;
        for (std::size_t i = 0; i < n; ++i) {
            y[i] = 0;
            for (std::size_t k = 0; k < n; ++k) y[i] += matrix[i * n + k] * x[k];
            square += y[i] * y[i];
            along += x[i] * y[i];
            before += x[i] * x[i];
        }
        value = along / before;
        for (std::size_t i = 0; i < n; ++i) x[i] = y[i] / std::sqrt(square);
    }
    return value;
}

/// The largest eigenvalue of M^-1 (K + 2 C/step) of rigid blocks, from the whole matrix, spring by spring.
double exact(const Model& model, double step) {
    const auto& blocks = model.blocks;
    const std::size_t n = 6 * blocks.size();
    std::vector<double> matrix(n * n, 0.0);
    std::vector<Mat3> root(blocks.size(), Mat3::Zero());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.fixed[b] == fix_all) continue;
        const auto& q = blocks.orientation[b];
        const Mat3 turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
        Eigen::SelfAdjointEigenSolver<Mat3> solver;
        solver.computeDirect(blocks.mass[b] / blocks.volume[b] * (turn * blocks.inertia[b] * turn.transpose()));
        for (int k = 0; k < 3; ++k)
            root[b] += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose() /
                       std::sqrt(solver.eigenvalues()[k]);
    }
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Beta beta = beta_of(model, static_cast<Row>(c));
        for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s)
            for (int direction = 0; direction < 3; ++direction) { // each a separate spring: normal and tangential
                const Vec3 n0 = contacts.normal[c], n1 = n0.unitOrthogonal(), n2 = n0.cross(n1);
                const Vec3 d = direction == 0 ? n0 : direction == 1 ? n1 : n2;
                const double k =
                    subs.area[s] * (direction == 0 ? subs.normal_stiffness[s] * (1 + 2 * beta.normal / step)
                                                   : subs.shear_stiffness[s] * (1 + 2 * beta.shear / step));
                std::vector<std::pair<std::size_t, double>> row;
                for (const auto& [block, sign] :
                     {std::pair{contacts.block1[c], -1.0}, std::pair{contacts.block2[c], 1.0}}) {
                    if (blocks.fixed[block] == fix_all) continue;
                    const Vec3 turned = root[block] * (Vec3(subs.position[s]) - blocks.centroid[block]).cross(d);
                    for (int i = 0; i < 3; ++i) {
                        row.emplace_back(6 * block + i, sign * d[i] / std::sqrt(blocks.mass[block]));
                        row.emplace_back(6 * block + 3 + i, sign * turned[i]);
                    }
                }
                for (const auto& [i, a] : row)
                    for (const auto& [j, b] : row) matrix[i * n + j] += k * a * b;
            }
    }
    return largest_eigenvalue_of(matrix, n);
}

/// The largest stable step by the bound over the exact one: at most 1, and 1 if the bound is exact.
double sharpness(Bench& bench) {
    bench.cycle.prepare();
    const Adjacency adjacency = make_adjacency(bench.model);
    StepBounds bounds;
    bounds.update(bench.model, adjacency);
    const double stable = bounds.limit(bench.model, adjacency).stable;
    return 0.5 * stable * std::sqrt(exact(bench.model, stable));
}

struct Placed : Bench {
    Mat3 turn = Mat3::Identity();
    Vec3 way = Vec3::Zero();
    double size = 1;

    Row box(const Vec3& low, const Vec3& high) {
        Polyhedron solid = make_brick(low, high);
        for (auto& x : solid.vertices) x = size * (turn * x) + way;
        return add_block(model, solid, {});
    }
    void stand(const std::function<void(Placed&)>& build, double contact_damping, double kn, double ks) {
        elastic(1, 2000, 0, 0);
        build(*this);
        fix_blocks(model, {0});
        model.settings.contact_damping = contact_damping;
        joint("elastic", {{"stiffness-normal", kn}, {"stiffness-shear", ks}});
    }
};

void needle(Placed& p) {
    p.box({-1, -1, -1}, {2, 1, 0});
    p.box({0, 0, 0}, {1, 0.04, 0.04});
}
void stack(Placed& p) {
    p.box({-1, -1, -1}, {2, 2, 0});
    for (int i = 0; i < 6; ++i) p.box({0.1 * i, 0, 1.0 * i}, {1 + 0.1 * i, 1, 1.0 + i});
}
void wall(Placed& p) {
    p.box({-1, 0, -1}, {7, 1, 0});
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i < 5; ++i) p.box({i + 0.5 * (k % 2), 0, 0.4 * k}, {i + 1 + 0.5 * (k % 2), 0.5, 0.4 * (k + 1)});
}
void bricks_on_a_slab(Placed& p) {
    p.box({-1, -1, -1}, {12, 12, 0});
    p.box({0, 0, 0}, {10, 10, 1});
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j) p.box({2.0 * i, 2.0 * j, 1}, {2.0 * i + 0.3, 2.0 * j + 0.3, 1.3});
}

struct Family {
    const char* name;
    void (*build)(Placed&);
    double least; ///< sharpness
};
constexpr Family families[] = {{"needle", needle, 0.97},
                               {"stack", stack, 0.82},
                               {"wall", wall, 0.75},
                               {"bricks on a slab", bricks_on_a_slab, 0.82}};

TEST(StepBounds, TheBoundIsCertainAndSharpForSlenderStackedAndVeryDifferentBlocks) {
    for (const Family& family : families)
        for (const double damping : {0.0, 0.3})
            for (const double ks : {1e9, 2e8}) {
                Placed bench;
                bench.stand(family.build, damping, 1e9, ks);
                const double part = sharpness(bench);
                EXPECT_LE(part, 1 + 1e-9) << family.name << ", damping " << damping << ", ks " << ks;
                EXPECT_GE(part, family.least) << family.name << ", damping " << damping << ", ks " << ks;
            }
}

/// Calls check(name, placed, adjacency) for all families, without dashpots and with them.
template <class Check> void for_families(const Check& check) {
    for (const Family& family : families)
        for (const double damping : {0.0, 0.3}) {
            Placed p;
            p.stand(family.build, damping, 1e9, 3e8);
            p.cycle.prepare();
            check(family.name, p, make_adjacency(p.model));
        }
}

// A body has a coarse bound only where that allows the wanted step.
TEST(StepBounds, ALimitIsExactUnlessAllBodiesAllowTheStepThatIsEnough) {
    for_families([](const char* name, const Placed& p, const Adjacency& adjacency) {
        StepBounds bounds;
        for (const auto of : {StepBounds::Of::bodies, StepBounds::Of::bodies_and_neighbours}) {
            bounds.update(p.model, adjacency, of);
            const double exact = bounds.limit(p.model, adjacency).stable;
            for (const double part : {0.2, 0.5, 0.8, 0.95, 0.99, 1.0, 1 + 1e-9, 1.01, 1.5, 10.0}) {
                const double enough = part * exact,
                             coarse = bounds.limit(p.model, adjacency, Masses::inertial, enough).stable;
                EXPECT_LE(coarse, exact) << name << " " << part;
                EXPECT_GE(coarse, std::min(enough, exact)) << name << " " << part;
            }
        }
    });
}

TEST(StepBounds, TheStiffnessOfABodyIsExactUnlessItAllowsTheStepThatIsEnough) {
    for_families([](const char* name, const Placed& p, const Adjacency& adjacency) {
        StepBounds bounds;
        bounds.update(p.model, adjacency, StepBounds::Of::bodies);
        const std::vector<Resistance> exact = bounds.stiffness(p.model, adjacency).of_block;
        for (const double enough : {1e-5, 1e-4, 1e-3, 1e-2}) {
            const auto& coarse = bounds.stiffness(p.model, adjacency, enough).of_block;
            for (std::size_t b = 0; b < coarse.size(); ++b) {
                EXPECT_GE(coarse[b].elastic, exact[b].elastic) << name << " " << b;
                EXPECT_TRUE(coarse[b].elastic == exact[b].elastic ||
                            coarse[b].over(p.model.blocks.inertial_mass[b]).stable_step() >= enough)
                    << name << " " << b << " " << enough;
            }
        }
    });
}

TEST(StepBounds, TheBoundDoesNotDependOnPlaceAndFrameAndFollowsTheSize) {
    const auto stable = [](const Mat3& turn, const Vec3& way, double size) {
        Placed bench;
        bench.turn = turn;
        bench.way = way;
        bench.size = size;
        bench.stand(wall, 0.1, 1e9, 5e8);
        bench.cycle.prepare();
        const Adjacency adjacency = make_adjacency(bench.model);
        StepBounds bounds;
        bounds.update(bench.model, adjacency);
        return bounds.limit(bench.model, adjacency).stable;
    };
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
    const double one = stable(Mat3::Identity(), Vec3::Zero(), 1);
    EXPECT_NEAR(stable(turn, Vec3::Zero(), 1) / one, 1, 1e-6);
    EXPECT_NEAR(stable(Mat3::Identity(), {1e4, -2e4, 3e4}, 1) / one, 1, 1e-6);
    // Masses are proportional to the cube, areas to the square.
    EXPECT_NEAR(stable(Mat3::Identity(), Vec3::Zero(), 4) / one, 2, 1e-6);
}

TEST(StepBounds, ADistantSmallStiffBlockDoesNotChangeTheBoundsOfOthers) {
    const auto of_all = [](bool small_one) {
        Placed bench;
        bench.stand(
            [&](Placed& p) {
                stack(p);
                if (small_one) p.box({1.5, 1.5, 0}, {1.6, 1.6, 0.1});
            },
            0.1, 1e9, 1e9);
        bench.cycle.prepare();
        const Adjacency adjacency = make_adjacency(bench.model);
        StepBounds bounds;
        std::vector<char> upper(bench.model.contacts.size(), 0);
        for (std::size_t c = 0; c < upper.size(); ++c)
            upper[c] = std::max(bench.model.blocks.number[bench.model.contacts.block1[c]],
                                bench.model.blocks.number[bench.model.contacts.block2[c]]) == 7;
        bounds.update_at(bench.model, adjacency, upper, StepBounds::Of::bodies_and_neighbours);
        return bounds.limit(bench.model, adjacency).stable;
    };
    EXPECT_EQ(of_all(true), of_all(false));
}

TEST(StepBounds, BodiesWithFixedRotationAreBoundedByTranslations) {
    Placed bench;
    bench.stand(
        [](Placed& p) {
            p.box({-1, -1, -1}, {2, 2, 0});
            p.box({0, 0, 0}, {1, 1, 1});
        },
        0, 1e9, 5e8);
    bench.model.blocks.fixed[1] = fix_rx | fix_ry | fix_rz;
    bench.cycle.prepare();
    const Adjacency adjacency = make_adjacency(bench.model);
    StepBounds bounds;
    bounds.update(bench.model, adjacency);
    EXPECT_NEAR(bounds.limit(bench.model, adjacency).stable, 2 / std::sqrt(1e9 / 2000),
                2e-3 * 2 / std::sqrt(1e9 / 2000));
}

TEST(StepBounds, TheEstimateIsTheHighestFrequency) {
    for (const Family& family : families) {
        Placed bench;
        bench.stand(family.build, 0.1, 1e9, 5e8);
        bench.cycle.prepare();
        StepBounds bounds;
        const double step = 1e-4, true_one = exact(bench.model, step);
        const double found = bounds.estimate(bench.model, make_adjacency(bench.model), step);
        EXPECT_GE(found, (1 - 1e-3) * true_one) << family.name;
        EXPECT_LE(found, 1.05 * true_one) << family.name;
    }
}

} // namespace
} // namespace kaya
