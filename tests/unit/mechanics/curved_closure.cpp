// Forces of overlaps whose joint model is curved: the gradient of an energy, for any place, shape and law.
#include "mechanics/contact/closed_halves.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "mechanics/shape/surfaces.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace kaya {
namespace {

using test::Bench;

/// sigma = w^m, of any unit.
struct PowerLaw {
    double m;

    HalfSpring at(double w) const { return {std::pow(w, m), m * std::pow(w, m - 1), std::pow(w, m + 1) / (m + 1)}; }
    ClosedHalves::Springs of(const ClosedHalves& halves) const {
        return {at(halves.closure(0)), at(halves.closure(1))};
    }
};

/// A brick over another, which is larger, at a random place.
class Pressing : public Bench {
public:
    /// `turn` tilts the upper brick about `about`, the middle of its lower face, which is then `closure` below the upper face of the other.
    Pressing(const Mat3& turn, double closure, bool parallel, double least_area) {
        lower_ = brick({-4, -4, -2}, {4, 4, 0});
        upper_ = brick({-0.5, -0.4, 0}, {0.5, 0.4, 1.2});
        for (const Row g : gridpoints_of(upper_))
            start_.push_back(turn * model.gridpoints.position[g] - closure * Vec3::UnitZ());
        pair_ = {lower_, upper_, no_row, no_row, least_area};
        if (!parallel) return;
        for (Row f = 0; f < static_cast<Row>(model.faces.size()); ++f) {
            const double up = current_normal(model, f).z();
            if (model.faces.block[f] == lower_ && up > 0.9) pair_.face1 = f;
            if (model.faces.block[f] == upper_ && up < -0.9) pair_.face2 = f;
        }
    }
    /// Moves the upper brick from its start by a small motion, and finds what presses on it.
    OverlapPatch at(const Vec3& shift, const Vec3& turn, OverlapSlopes& slopes) {
        const double angle = turn.norm();
        const Mat3 turned =
            angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3(Mat3::Identity());
        const std::vector<Row> rows = gridpoints_of(upper_);
        for (std::size_t i = 0; i < rows.size(); ++i) model.gridpoints.position[rows[i]] = turned * start_[i] + shift;
        return overlap_patch(model, pair_, Vec3::UnitZ(), {}, scratch_, &slopes);
    }

private:
    Row lower_, upper_;
    OverlapPair pair_;
    std::vector<Vec3> start_;
    OverlapScratch scratch_;
};

double energy_of(const OverlapSlopes& slopes, double whole, const PowerLaw& law) {
    const ClosedHalves halves(slopes, whole);
    return halves.energy(law.of(halves));
}

struct Case {
    const char* name;
    double tilt, closure; ///< degrees
    bool parallel;
    double least_area, whole; ///< 0: the common area is not known
};

class CurvedClosure : public testing::TestWithParam<Case> {};

TEST_P(CurvedClosure, TheForceIsTheGradientOfAnEnergy) {
    const Case& given = GetParam();
    std::mt19937 random(17);
    std::uniform_real_distribution<double> some(-1, 1);
    for (int trial = 0; trial < 8; ++trial) {
        const Vec3 about = Vec3(some(random), some(random), 0.1 * some(random)).normalized();
        const Mat3 tilt = Eigen::AngleAxisd(given.tilt * std::acos(-1) / 180, about).toRotationMatrix();
        Pressing blocks(tilt, given.closure, given.parallel, given.least_area);
        for (const double m : {0.7, 1.0, 1.5, 2.0, 3.5}) {
            const PowerLaw law{m};
            OverlapSlopes slopes;
            const OverlapPatch patch = blocks.at(Vec3::Zero(), Vec3::Zero(), slopes);
            ASSERT_GT(patch.carried, 0) << given.name;
            const ClosedHalves halves(slopes, given.whole);
            const OverlapGradient push = halves.push(law.of(halves));
            const double size = push.force.norm();
            const Vec3 shift(some(random), some(random), some(random)), turn(some(random), some(random), some(random));
            const double step = 1e-5 * patch.depth,
                         expected = push.force.dot(shift) + (push.moment + slopes.origin.cross(push.force)).dot(turn);
            OverlapSlopes before, after;
            ASSERT_GT(blocks.at(-step * shift, -step * turn, before).carried, 0);
            ASSERT_GT(blocks.at(step * shift, step * turn, after).carried, 0);
            const double found =
                -(energy_of(after, given.whole, law) - energy_of(before, given.whole, law)) / (2 * step);
            EXPECT_NEAR(found, expected, 2e-5 * size) << given.name << ", m = " << m << ", trial " << trial;
        }
    }
}

TEST_P(CurvedClosure, StraightSpringsPressAsTheOverlapDoes) {
    const Case& given = GetParam();
    const Mat3 tilt = Eigen::AngleAxisd(given.tilt * std::acos(-1) / 180, Vec3(0.6, 0.8, 0)).toRotationMatrix();
    Pressing blocks(tilt, given.closure, given.parallel, given.least_area);
    OverlapSlopes slopes;
    const OverlapPatch patch = blocks.at(Vec3::Zero(), Vec3::Zero(), slopes);
    const ClosedHalves halves(slopes, given.whole);
    const ClosedHalves::Springs springs = PowerLaw{1}.of(halves);
    const OverlapGradient push = halves.push(springs);
    EXPECT_NEAR(halves.energy(springs), patch.energy, 1e-12 * patch.energy);
    EXPECT_NEAR((push.force - patch.carried * patch.normal).norm(), 0, 1e-12 * patch.carried);
    EXPECT_NEAR((push.moment - slopes.energy.moment).norm(), 0, 1e-11 * patch.carried);
}

// A strip that is closed everywhere or in part: exact for stresses up to the square of the closure.
TEST(ClosedHalvesOfStrips, HaveTheEnergyOfTheStrip) {
    for (const double low : {-3e-5, -1e-5, 0.0, 1e-5, 4e-5}) {
        constexpr double width = 1, deep = 0.8, rise = 5e-5;
        const Mat3 tilt = Eigen::AngleAxisd(std::atan(rise), Vec3(0, 1, 0)).toRotationMatrix();
        Pressing blocks(tilt, low + 0.5 * rise, true, 8e-3);
        OverlapSlopes slopes;
        ASSERT_GT(blocks.at(Vec3::Zero(), Vec3::Zero(), slopes).carried, 0);
        for (const double m : {1.0, 1.5, 2.0, 3.5}) {
            const double high = low + rise * width, from = std::max(low, 0.0),
                         exact = deep / rise * (std::pow(high, m + 2) - std::pow(from, m + 2)) / ((m + 1) * (m + 2));
            EXPECT_NEAR(energy_of(slopes, width * deep, PowerLaw{m}), exact, (m <= 2 ? 5e-3 : 0.06) * exact)
                << low << " " << m;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CurvedClosure,
                         testing::Values(Case{"joint open in part", 0.02, 1e-5, true, 8e-3, 0.8},
                                         Case{"joint closed everywhere", 0.01, 3e-4, true, 8e-3, 0.8},
                                         Case{"joint of unknown area", 0.01, 3e-4, true, 8e-3, 0},
                                         Case{"joint of a former area", 0.01, 3e-4, true, 8e-3, 0.6},
                                         Case{"nearly parallel", 1, 2e-3, true, 8e-3, 0.8},
                                         Case{"between parallel and not", 4, 1e-2, true, 8e-3, 0.8},
                                         Case{"edge or corner", 25, -0.15, false, 1e-6, 0},
                                         Case{"tip with a least joint", 40, -0.2, false, 8e-2, 0}),
                         [](const auto& info) {
                             std::string name = info.param.name;
                             std::ranges::replace(name, ' ', '_');
                             return name;
                         });

} // namespace
} // namespace kaya
