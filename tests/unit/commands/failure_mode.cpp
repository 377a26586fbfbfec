// Modes of failure of known motions: each body unchanged, mirrored, rotated about the vertical and far away.
#include "commands/stability/failure_mode.hpp"

#include "running.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

namespace kaya {
namespace {

/// Positions of a body are rotated (or mirrored), then shifted.
struct Twin {
    const char* name;
    Mat3 turn;
    Vec3 shift;
};

Mat3 mirror() { return Vec3(-1, 1, 1).asDiagonal(); }
Mat3 turned(double degrees) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitZ()).toRotationMatrix();
}

class FailureModes : public Running, public testing::WithParamInterface<Twin> {
protected:
    using Field = std::function<Vec3(const Vec3&)>;

    FailureModes() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }

    /// A prism over a polygon, clockwise or anticlockwise seen from `along`, because `poly prism` accepts both.
    Row prism(const std::vector<Vec3>& polygon, const Vec3& along) {
        std::string line = "poly prism";
        for (const auto& [side, way] : {std::pair<const char*, Vec3>{" a", Vec3::Zero()}, {" b", along}}) {
            line += side;
            for (const Vec3& corner : polygon) {
                const Vec3 p = GetParam().turn * (corner + way) + GetParam().shift;
                line += fmt::format(" ({:.17g},{:.17g},{:.17g})", p[0], p[1], p[2]);
            }
        }
        run(line);
        return static_cast<Row>(model().blocks.size()) - 1;
    }
    /// Between two lines x = x1 and x = x2 from z = z1 up to z = z2, 2 wide along y.
    Row brick(double x1, double x2, double z1, double z2) {
        return prism({{x1, 0, z1}, {x2, 0, z1}, {x2, 0, z2}, {x1, 0, z2}}, {0, 2, 0});
    }
    void begin(const std::string& lines = "") {
        run(lines + "\njmodel model mohr jkn 1e9 jks 1e9 jfric 30\nprop mat 1 density 2500 k 1e9 g 6e8\n"
                    "gravity 0 0 -10\nset small on\ndamp local\nfix\ncycle 1");
        mode_.emplace(model(), *session().engine.cycle);
    }
    void move(Row block, const Field& field) {
        const Span span = model().blocks.gridpoints[block];
        for (Row g = span.first; g < span.end(); ++g) {
            const Vec3 place = GetParam().turn.transpose() * (model().gridpoints.position[g] - GetParam().shift);
            model().gridpoints.displacement[g] += GetParam().turn * field(place);
        }
    }
    /// Six columns 2 wide and 12 high, side by side on a floor.
    std::vector<Row> columns() {
        brick(-10, 20, -2, 0);
        std::vector<Row> all;
        for (int n = 0; n < 6; ++n) all.push_back(brick(2 * n, 2 * n + 2, 0, 12));
        return all;
    }
    std::string name(double in_joints = 1, double in_zones = 0) {
        model().energy.joint_friction += in_joints;
        model().energy.zone_work += in_zones;
        const std::string text = mode_text(mode_->shares(model(), *session().engine.cycle)),
                          before = "mode of failure: ";
        return text.substr(before.size(), text.find(';') - before.size());
    }

    std::optional<FailureMode> mode_;
};

Vec3 turn_about(const Vec3& axis, const Vec3& pivot, const Vec3& place) { return axis.cross(place - pivot); }

TEST_P(FailureModes, ABlockSlidesDownAPlane) {
    prism({{0, 0, 0}, {20, 0, 0}, {20, 0, 14}}, {0, 2, 0});
    const Row slab = prism({{0, 0, 0}, {20, 0, 14}, {10, 0, 14}}, {0, 2, 0});
    begin();
    move(slab, [](const Vec3&) -> Vec3 { return 0.01 * Vec3(-20, 0, -14); });
    EXPECT_EQ(name(), "sliding");
}

TEST_P(FailureModes, AWedgeSlidesDownItsLine) {
    const Vec3 line(20, 0, 14);
    prism({{0, 0, 0}, {0, 0, -10}, {0, 10, -10}, {0, 10, 10}}, line);
    prism({{0, 0, 0}, {0, 0, -10}, {0, -10, -10}, {0, -10, 10}}, line);
    const Row wedge = prism({{0, 0, 0}, {0, 10, 10}, {0, -10, 10}}, line);
    begin();
    move(wedge, [&](const Vec3&) -> Vec3 { return -0.01 * line; });
    EXPECT_EQ(name(), "sliding");
}

TEST_P(FailureModes, ASlabSlidesAndItsToeYields) {
    prism({{0, 0, 0}, {20, 0, 0}, {20, 0, 14}}, {0, 2, 0});
    const Row slab = prism({{0, 0, 0}, {20, 0, 14}, {10, 0, 14}}, {0, 2, 0});
    begin("gen edge 4");
    move(slab, [](const Vec3& x) -> Vec3 { return (0.01 + 0.01 * std::exp(-x[2] / 3)) * Vec3(-20, 0, -14); });
    EXPECT_EQ(name(1, 1), "sliding with yield of zones");
}

TEST_P(FailureModes, ColumnsTopple) {
    const auto all = columns();
    begin();
    for (std::size_t n = 0; n < all.size(); ++n)
        move(all[n], [&](const Vec3& x) { return turn_about({0, -0.01, 0}, {2.0 * static_cast<double>(n), 0, 0}, x); });
    EXPECT_EQ(name(), "toppling");
}

TEST_P(FailureModes, ColumnsToppleAndPushTheLowestOut) {
    const auto all = columns();
    begin();
    for (std::size_t n = 2; n < all.size(); ++n)
        move(all[n], [&](const Vec3& x) { return turn_about({0, -0.01, 0}, {2.0 * static_cast<double>(n), 0, 0}, x); });
    for (std::size_t n = 0; n < 2; ++n) move(all[n], [](const Vec3&) { return Vec3(-0.08, 0, 0); });
    EXPECT_EQ(name(), "toppling");
}

TEST_P(FailureModes, ColumnsLeanBackAndTheirFeetMoveOut) {
    const auto all = columns();
    begin();
    for (std::size_t n = 0; n < all.size(); ++n)
        move(all[n], [&](const Vec3& x) -> Vec3 {
            return Vec3(-0.1, 0, 0) + turn_about({0, 0.01, 0}, {2.0 * static_cast<double>(n) + 2, 0, 0}, x);
        });
    EXPECT_EQ(name(), "backward toppling");
}

TEST_P(FailureModes, ColumnsBendAndBreak) {
    const auto all = columns();
    begin("gen edge 2");
    for (std::size_t n = 0; n < all.size(); ++n) {
        const double middle = 2.0 * static_cast<double>(n) + 1;
        move(all[n], [=](const Vec3& x) { return Vec3(-1e-3 * x[2] * x[2], 0, 2e-3 * x[2] * (x[0] - middle)); });
    }
    EXPECT_EQ(name(1, 2), "toppling with yield of zones");
}

TEST_P(FailureModes, AColumnTipsAlone) {
    brick(-10, 20, -2, 0);
    const Row column = brick(0, 2, 0, 12);
    begin();
    move(column, [](const Vec3& x) { return turn_about({0, -0.01, 0}, Vec3::Zero(), x); });
    EXPECT_EQ(name(0), "toppling");
}

/// Rock that rotates about a centre high above, across a joint that remains closed.
TEST_P(FailureModes, RockYieldsAlongACircle) {
    const Row low = brick(0, 20, 0, 10), high = brick(0, 20, 10, 20);
    begin("gen edge 2");
    for (const Row block : {low, high})
        move(block, [](const Vec3& x) -> Vec3 {
            const Vec3 centre(0, 0, 25);
            const double depth = 24 - std::hypot(x[0], x[2] - 25);
            return std::clamp(depth / 4, 0.0, 1.0) * turn_about({0, 0.01, 0}, centre, x);
        });
    EXPECT_EQ(name(1, 20), "yield of zones");
}

INSTANTIATE_TEST_SUITE_P(Twins, FailureModes,
                         testing::Values(Twin{"itself", Mat3::Identity(), Vec3::Zero()},
                                         Twin{"mirrored", mirror(), Vec3::Zero()},
                                         Twin{"turned", turned(37), Vec3::Zero()},
                                         Twin{"far", Mat3::Identity(), {1e6, -1e6, 1e6}},
                                         Twin{"all", turned(37) * mirror(), {1e6, -1e6, 1e6}}),
                         [](const auto& twin) { return twin.param.name; });

} // namespace
} // namespace kaya
