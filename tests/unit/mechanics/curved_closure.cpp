// Forces of overlaps whose joint model is curved: the gradient of an energy, for any place, shape and law.
#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/shape/surfaces.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaya {
namespace {

using test::Bench;

/// sigma = w^m, of any unit.
struct PowerLaw {
    double m;

    double stress(double w) const { return std::pow(w, m); }
    double energy(double w) const { return std::pow(w, m + 1) / (m + 1); }
    double part() const { return 1 / (m + 1); }
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

/// A energy density times the area that goes with the mean closure.
double energy_of(const OverlapSlopes& slopes, const PowerLaw& law) {
    const double w = slopes.closure.value;
    return 2 * slopes.energy.value / (w * w) * law.energy(w);
}

struct Case {
    const char* name;
    double tilt, closure; ///< degrees
    bool parallel;
    double least_area;
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
            OverlapPatch patch = blocks.at(Vec3::Zero(), Vec3::Zero(), slopes);
            ASSERT_GT(patch.carried, 0) << given.name;
            press(patch, slopes, law.part());
            const double size = patch.carried / patch.depth * law.stress(patch.depth);
            const Vec3 shift(some(random), some(random), some(random)), turn(some(random), some(random), some(random));
            const double step = 1e-5 * patch.depth, of_force = patch.normal.dot(shift + turn.cross(patch.centre)),
                         expected = size * (of_force + patch.twist * patch.normal.dot(turn));
            OverlapSlopes before, after;
            ASSERT_GT(blocks.at(-step * shift, -step * turn, before).carried, 0);
            ASSERT_GT(blocks.at(step * shift, step * turn, after).carried, 0);
            const double found = -(energy_of(after, law) - energy_of(before, law)) / (2 * step);
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
    OverlapPatch pressed = patch;
    press(pressed, slopes, 0.5);
    EXPECT_NEAR(pressed.carried, patch.carried, 1e-12 * patch.carried);
    EXPECT_NEAR((pressed.normal - patch.normal).norm(), 0, 1e-12);
    EXPECT_NEAR((pressed.centre - patch.centre).norm(), 0, 1e-9);
    EXPECT_NEAR(pressed.twist, patch.twist, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Shapes, CurvedClosure,
                         testing::Values(Case{"joint open in part", 0.02, 1e-5, true, 8e-3},
                                         Case{"joint closed everywhere", 0.01, 3e-4, true, 8e-3},
                                         Case{"nearly parallel", 1, 2e-3, true, 8e-3},
                                         Case{"between parallel and not", 4, 1e-2, true, 8e-3},
                                         Case{"edge or corner", 25, -0.15, false, 1e-6},
                                         Case{"tip with a least joint", 40, -0.2, false, 8e-2}),
                         [](const auto& info) {
                             std::string name = info.param.name;
                             std::ranges::replace(name, ' ', '_');
                             return name;
                         });

} // namespace
} // namespace kaya
