// What commands do with a joint model whose properties have other words than those of kaya and state what they mean.
#include "running.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace kaya {

namespace {

Options with_plugins() {
    Options options;
    options.joint_folders = {KAYA_TEST_JOINTS, KAYA_TEST_JOINTS "/../tests/plugins"};
    return options;
}

class Roles : public Running {
protected:
    Roles() : Running(with_plugins()) {}

    /// A block on a plane that dips by 30 degrees; gravity is turned.
    void lay(const std::string& values) {
        run("prop mat 1 density 2500\npoly brick -15 25 0 10 -5 0\nfix\npoly brick 0 10 0 10 0 5\njmodel model own-words\n"
            "jmodel p1 1e10 p2 1e10 " +
            values + "\nmscale on\ngravity 4.905 0 -8.4957");
    }
    double factor() { return model().clock.factor_of_safety; }
};

constexpr double degree = std::numbers::pi / 180;

} // namespace

// tan phi / tan 30; with cohesion c A / (W sin 30) more.
TEST_F(Roles, AFactorOfSafetyDividesFrictionByItsRole) {
    lay("phi 40");
    run("solve fos resolution 0.004");
    EXPECT_NEAR(factor(), std::tan(40 * degree) / std::tan(30 * degree), 0.005 * 1.4534);
}

TEST_F(Roles, AndCohesion) {
    lay("phi 20 c 5e4");
    run("solve fos resolution 0.004");
    const double weight = 2500 * 500 * 9.81;
    const double exact = std::tan(20 * degree) / std::tan(30 * degree) + 5e4 * 100 / (weight * std::sin(30 * degree));
    EXPECT_NEAR(factor(), exact, 0.005 * exact);
}

TEST_F(Roles, AnAngleInRadiansIsDoubted) {
    lay("phi 0.7");
    EXPECT_THAT(said(), testing::HasSubstr("phi 0.7: angles are in degrees"));
}

TEST_F(Roles, ElasticSolutionsRaiseCohesion) {
    lay("phi 20 c 1");
    run("solve elastic");
    EXPECT_THAT(said(), testing::Not(testing::HasSubstr("no effect")));
}

} // namespace kaya
