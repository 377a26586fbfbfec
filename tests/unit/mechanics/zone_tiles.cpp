#include "mechanics/zones/tetrahedra.hpp"
#include "mechanics/zones/cell_state.hpp"
#include "mechanics/zones/ruled_faces.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <random>
#include <set>

namespace kaya {
namespace {

using test::Bench;

/// Two blocks of different materials, one of them with more zones than a tile may have.
struct TwoBlocks : Bench {
    TwoBlocks() {
        elastic(1, 2500, 1e9, 0.75e9);
        elastic(2, 2500, 2e9, 1.5e9);
        generate_zones(model, {brick({0, 0, 0}, {1, 1, 1}, 1)}, {7, 7, 7}, {1, 1, 1});
        generate_zones(model, {brick({5, 0, 0}, {6, 1, 1}, 2)}, {3, 3, 3}, {1, 1, 1});
        std::mt19937 random(7);
        distort(random);
        std::uniform_real_distribution<double> small(-0.01, 0.01);
        for (auto& stress : model.zones.stress)
            for (int k = 0; k < 6; ++k) stress[k] = 1e6 * small(random);
    }
    /// The zones no longer belong to cells, as tetrahedra do.
    void part_cells() { std::ranges::fill(model.blocks.cell_zones, 0); }
    /// The zones of a cell get the stress of the first.
    void make_alike() {
        for (std::size_t z = 0; z < model.zones.size(); ++z)
            model.zones.stress[z] = Stress(model.zones.stress[z - z % 6]);
    }
};

Mat3 tensor(const Stress& s) {
    Mat3 m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return m;
}

/// Gradient of a linear field over a tetrahedron, from its values at the corners.
Mat3 gradient_of(const std::array<Vec3, 4>& field, const std::array<Vec3, 4>& place) {
    Mat3 values, edges;
    for (int i = 0; i < 3; ++i) {
        values.col(i) = field[i + 1] - field[0];
        edges.col(i) = place[i + 1] - place[0];
    }
    return values * edges.inverse();
}

TEST(ZoneTiles, EachZoneIsInOneTileOfItsLawWithItsOwnGridpoints) {
    TwoBlocks bench;
    Model& model = bench.model;
    const auto law_of = [&](Row z) { return static_cast<std::size_t>(model.zones.block[z]); };
    const ZoneTiles tiles(model, law_of);
    Row next = 0, next_point = 0;
    for (const ZoneTile& tile : tiles.tiles) {
        EXPECT_EQ(tile.first, next);
        EXPECT_EQ(tile.points.first, next_point);
        EXPECT_LE(tile.last - tile.first, most_zones_in_tile);
        EXPECT_LE(tile.points.count, most_points_in_tile);
        std::set<Row> once;
        for (Row p = tile.points.first; p < tile.points.end(); ++p)
            EXPECT_TRUE(once.insert(tiles.gridpoints[p]).second);
        for (Row z = tile.first; z < tile.last; ++z) {
            EXPECT_EQ(law_of(z), tile.law);
            for (int a = 0; a < 4; ++a)
                EXPECT_EQ(tiles.gridpoints[tile.points.first + tiles.corners[z][a]], model.zones.gridpoints[z][a]);
        }
        next = tile.last;
        next_point = tile.points.end();
    }
    EXPECT_EQ(next, static_cast<Row>(model.zones.size()));
    EXPECT_EQ(next_point, static_cast<Row>(tiles.gridpoints.size()));
    EXPECT_GE(tiles.tiles.size(), 4u);
    std::size_t shared = 0;
    for (Row g = 0; g < static_cast<Row>(model.gridpoints.size()); ++g) {
        for (auto p = tiles.points_of.begin(g); p != tiles.points_of.end(g); ++p) EXPECT_EQ(tiles.gridpoints[*p], g);
        shared += tiles.points_of.end(g) - tiles.points_of.begin(g) > 1;
    }
    EXPECT_GT(shared, 0u);
}

TEST(ZoneTiles, ZonesOfOneTileHaveNoMoreGridpointsThanItHasRoomFor) {
    TwoBlocks bench;
    Model& model = bench.model;
    // No two zones share a gridpoint.
    model.zones.resize(2000);
    model.gridpoints.resize(8000);
    for (Row z = 0; z < 2000; ++z) model.zones.gridpoints[z] = {4 * z, 4 * z + 1, 4 * z + 2, 4 * z + 3};
    const ZoneTiles tiles(model, [](Row) { return std::size_t{0}; });
    EXPECT_EQ(tiles.tiles.size(), 8u);
    for (const ZoneTile& tile : tiles.tiles) EXPECT_LE(tile.points.count, most_points_in_tile);
}

TEST(ZoneTiles, CellsAreWholeInTheirTile) {
    TwoBlocks bench;
    const ZoneTiles tiles(
        bench.model, [](Row) { return std::size_t{0}; }, [](std::size_t) { return Row{6}; });
    EXPECT_GE(tiles.tiles.size(), 3u);
    for (const ZoneTile& tile : tiles.tiles) EXPECT_EQ((tile.last - tile.first) % 6, 0);
    EXPECT_EQ(tiles.tiles.back().last, static_cast<Row>(bench.model.zones.size()));
}

TEST(ZoneTiles, CellsStandInWholeGroupsOfTheirTile) {
    TwoBlocks bench;
    const ZoneTiles tiles(
        bench.model, [](Row) { return std::size_t{0}; }, [](std::size_t) { return Row{6}; });
    Row next = 0;
    for (const ZoneTile& tile : tiles.tiles) {
        EXPECT_EQ(tile.group(tile.first), next);
        for (Row zone = tile.first; zone < tile.last; zone += 6)
            EXPECT_EQ(tiles.cells[tile.cell(zone)], corners_of_cell(&tiles.corners[zone]));
        next += ((tile.last - tile.first) / 6 + 7) / 8;
        EXPECT_EQ(tiles.cells[8 * next - 1], corners_of_cell(&tiles.corners[tile.last - 6])); // filled up with the last
    }
    EXPECT_EQ(tiles.groups(), next);
}

TEST(ZoneTiles, AllFacesOfCellsAreRuledAndOuterOnesAreMarked) {
    TwoBlocks bench;
    ZoneLaws laws(bench.model, bench.joints.zones);
    find_ruled_faces(bench.model, TieLists(), laws);
    int ruled = 0, outer = 0;
    for (const std::uint8_t bits : laws.tiles.ruled) ruled += std::popcount(bits);
    for (const std::uint8_t bits : laws.tiles.outer) outer += std::popcount(bits);
    EXPECT_EQ(ruled, 6 * 343 + 6 * 27);
    EXPECT_EQ(outer, 6 * 49 + 6 * 9);
    EXPECT_EQ(laws.tiles.outer[0], 1 + 2 + 4); // those at the beginning of the axes
}

TEST(ZoneTiles, FacesThatTwoCellsOfABlockShareAreRuledInModelsOfEarlierPrograms) {
    TwoBlocks bench;
    bench.model.settings.triangular_outer_faces = true;
    ZoneLaws laws(bench.model, bench.joints.zones);
    find_ruled_faces(bench.model, TieLists(), laws);
    int ruled = 0;
    for (const std::uint8_t bits : laws.tiles.ruled) ruled += std::popcount(bits);
    EXPECT_EQ(ruled, 6 * (343 - 49) + 6 * (27 - 9));
    EXPECT_EQ(laws.tiles.ruled[0], 8 + 16 + 32); // those at the ends of the axes
}

/// Distorted cells with previous warping: two steps in small strain.
void expect_work_of_cells(TwoBlocks& bench) {
    Model& model = bench.model;
    model.clock.time_step = 0.01;
    model.settings.large_strain = false; // positions are constant, and forces are linear in the step
    ZoneLaws laws(model, bench.joints.zones);
    find_ruled_faces(model, TieLists(), laws);
    settle_cells(model, laws);
    ZoneScratch scratch;
    std::vector<PointRow> before, between, after;
    before.resize(laws.tiles.gridpoints.size());
    after = before;
    run_zone_models(model, laws, scratch, before);
    zone_forces(model, laws, between);
    for (std::size_t p = 0; p < before.size(); ++p)
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(between[p].value[k], before[p].value[k], 1e-12 * before[p].value[3]);
    const auto stress = model.zones.stress;
    const ZoneSums sums = run_zone_models(model, laws, scratch, after);
    double work = 0;
    for (std::size_t p = 0; p < before.size(); ++p) {
        const Vec3 way = model.clock.time_step * model.gridpoints.velocity[laws.tiles.gridpoints[p]];
        for (int k = 0; k < 3; ++k) work -= 0.5 * (before[p].value[k] + after[p].value[k]) * way[k];
    }
    EXPECT_NEAR(sums.work, work, 1e-11 * std::abs(work));
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        const Stress change = model.zones.stress[z] - stress[z],
                     first = model.zones.stress[z - z % 6] - stress[z - z % 6];
        EXPECT_LT((change - first).norm(), 1e-11 * stress[z].norm());
    }
}

TEST(ZoneTiles, CellsTakeTheWorkThatTheirForcesDoAndTheirZonesStrainAlike) {
    TwoBlocks alike, unlike;
    alike.make_alike();
    expect_work_of_cells(alike);
    expect_work_of_cells(unlike);
    EXPECT_FALSE(alike.model.zones.keeps_initial);
    EXPECT_TRUE(unlike.model.zones.keeps_initial);
}

// A negligible difference between the zones of one cell has a negligible effect on all others.
TEST(ZoneTiles, CellsWhoseZonesAreAlikeAnswerAsTheOthersDo) {
    std::vector<PointRow> forces[2];
    Column<Stress> stress[2];
    double work[2];
    for (int i = 0; i < 2; ++i) {
        TwoBlocks bench;
        bench.make_alike();
        Model& model = bench.model;
        for (std::size_t z = 0; i == 1 && z < model.zones.size(); z += 6) model.zones.stress[z][0] *= 1 + 1e-15;
        model.clock.time_step = 0.01;
        ZoneLaws laws(model, bench.joints.zones);
        settle_cells(model, laws);
        ZoneScratch scratch;
        forces[i].resize(laws.tiles.gridpoints.size());
        work[i] = run_zone_models(model, laws, scratch, forces[i]).work;
        stress[i] = model.zones.stress;
    }
    EXPECT_NEAR(work[1], work[0], 1e-12 * std::abs(work[0]));
    for (std::size_t z = 0; z < stress[0].size(); ++z)
        EXPECT_LT((stress[1][z] - stress[0][z]).norm(), 1e-12 * stress[0][z].norm());
    for (std::size_t p = 0; p < forces[0].size(); ++p)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(forces[1][p].value[k], forces[0][p].value[k], 1e-12 * forces[0][p].value[3]);
}

/// Sizes of the forces of single zones, or of whole cells.
void expect_forces_of_stresses(bool cells) {
    TwoBlocks bench;
    Model& model = bench.model;
    if (!cells) bench.part_cells();
    const ZoneLaws laws(model, bench.joints.zones);
    settle_cells(model, laws);
    std::vector<PointRow> forces;
    zone_forces(model, laws, forces);
    std::vector<Vec3> expected(model.gridpoints.size(), Vec3::Zero()), found = expected;
    std::vector<double> sizes(model.gridpoints.size(), 0), found_sizes = sizes;
    std::map<Row, Vec3> element; ///< forces by gridpoint
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        std::array<Vec3, 4> x;
        for (int a = 0; a < 4; ++a) x[a] = model.gridpoints.position[model.zones.gridpoints[z][a]];
        const double volume = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6;
        for (int a = 0; a < 4; ++a) {
            std::array<Vec3, 4> shape{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
            shape[a].x() = 1;
            const Vec3 gradient = gradient_of(shape, x).row(0).transpose(),
                       force = -volume * (tensor(model.zones.stress[z]) * gradient);
            element.try_emplace(model.zones.gridpoints[z][a], Vec3::Zero()).first->second += force;
        }
        if (cells && z % 6 != 5) continue;
        for (const auto& [g, force] : element) {
            expected[g] += force;
            sizes[g] += force.norm();
        }
        element.clear();
    }
    for (std::size_t p = 0; p < forces.size(); ++p) {
        const auto& [fx, fy, fz, size] = forces[p].value;
        found[laws.tiles.gridpoints[p]] += Vec3(fx, fy, fz);
        found_sizes[laws.tiles.gridpoints[p]] += size;
    }
    for (std::size_t g = 0; g < expected.size(); ++g) {
        EXPECT_LT((found[g] - expected[g]).norm(), 1e-12 * sizes[g]);
        EXPECT_NEAR(found_sizes[g], sizes[g], 1e-12 * sizes[g]);
    }
}

TEST(ZoneTiles, ForcesAreMinusVolumeTimesStressTimesGradient) {
    expect_forces_of_stresses(false);
    expect_forces_of_stresses(true);
}

/// Volume and gradient of the motion of a step, in its middle.
struct Step {
    double volume;
    Mat3 gradient;
};

std::vector<Step> steps_of(const Model& model) {
    std::vector<Step> steps;
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        std::array<Vec3, 4> way, middle;
        for (int a = 0; a < 4; ++a) {
            const Row g = model.zones.gridpoints[z][a];
            way[a] = model.clock.time_step * model.gridpoints.velocity[g];
            middle[a] = model.gridpoints.position[g] - 0.5 * way[a];
        }
        const double volume = (middle[1] - middle[0]).dot((middle[2] - middle[0]).cross(middle[3] - middle[0])) / 6;
        steps.push_back({volume, gradient_of(way, middle)});
    }
    return steps;
}

/// Equation (7) of docs/theory/zones.md: by volume over the zones at a gridpoint, and over the gridpoints of a zone.
std::vector<double> mean_volume_strains(const Model& model, const std::vector<Step>& steps) {
    std::vector<double> sum(model.gridpoints.size(), 0), volume = sum, mean;
    for (std::size_t z = 0; z < steps.size(); ++z)
        for (const Row g : model.zones.gridpoints[z]) {
            sum[g] += steps[z].volume * steps[z].gradient.trace();
            volume[g] += steps[z].volume;
        }
    for (const auto& corners : model.zones.gridpoints) {
        mean.push_back(0);
        for (const Row g : corners) mean.back() += 0.25 * sum[g] / volume[g];
    }
    return mean;
}

void expect_step_of_tensors(bool averages) {
    TwoBlocks bench;
    Model& model = bench.model;
    model.clock.time_step = 0.01;
    model.settings.mixed_discretisation = averages;
    bench.part_cells();
    ZoneLaws laws(model, bench.joints.zones);
    ZoneScratch scratch;
    std::vector<PointRow> forces;
    zone_forces(model, laws, forces);
    const auto before = model.zones.stress;
    const ZoneSums sums = run_zone_models(model, laws, scratch, forces);
    const std::vector<Step> steps = steps_of(model);
    const std::vector<double> means = mean_volume_strains(model, steps);
    double work = 0;
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        const Mat3& gradient = steps[z].gradient;
        const Mat3 one = Mat3::Identity(), own = 0.5 * (gradient + gradient.transpose()),
                   spin = 0.5 * (gradient - gradient.transpose());
        const Mat3 strain = averages ? Mat3(own + (means[z] - own.trace()) / 3 * one) : own;
        const Mat3 turn = (one - 0.5 * spin).inverse() * (one + 0.5 * spin);
        const Mat3 turned = turn * tensor(before[z]) * turn.transpose();
        const auto& [lambda, two_shear] = laws.of_block(model.zones.block[z]).elastic;
        const Mat3 stress = turned + two_shear * strain + lambda * strain.trace() * one;
        EXPECT_LT((stress - tensor(model.zones.stress[z])).norm(), 1e-11 * stress.norm());
        work += 0.5 * steps[z].volume * (turned + stress).cwiseProduct(own).sum();
    }
    EXPECT_NEAR(sums.work, work, 1e-11 * std::abs(work));
}

TEST(ZoneTiles, AStepStrainsAndRotatesTheStressLikeTheTensors) {
    expect_step_of_tensors(false);
    expect_step_of_tensors(true);
}

} // namespace
} // namespace kaya
