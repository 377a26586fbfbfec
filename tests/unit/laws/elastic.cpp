#include "test_joint.hpp"

#include <gmock/gmock.h>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::values_of;
using testing::HasSubstr;

TEST(Elastic, FollowsItsTwoSpringsBothWays) {
    TestJoint joint(shipped("elastic"), {{"jkn", 1e4}, {"jks", 4e3}}, 0.5, 17);
    EXPECT_EQ(joint.normal_stiffness[16], 1e4);
    EXPECT_EQ(joint.shear_stiffness[16], 4e3);
    joint.step(-1e-3, {2e-3, 0, -1e-3});
    EXPECT_DOUBLE_EQ(joint.normal_force[16], 5);
    EXPECT_DOUBLE_EQ(joint.shear_force[0][16], -4);
    EXPECT_DOUBLE_EQ(joint.shear_force[2][16], 2);
    joint.step(3e-3, {-4e-3, 0, 2e-3}); // it carries tension, and never slips
    EXPECT_DOUBLE_EQ(joint.normal_force[16], -10);
    EXPECT_DOUBLE_EQ(joint.shear_force[0][16], 4);
    EXPECT_EQ(joint.frictional_work[16], 0);
    EXPECT_EQ(joint.state[16], 0u);
}

TEST(Elastic, NeedsANormalStiffnessButNoShearStiffness) {
    const auto& elastic = shipped("elastic");
    EXPECT_THAT(elastic.check(values_of(elastic, {{"kn", 0}, {"ks", 1}})), HasSubstr("stiffness-normal"));
    EXPECT_EQ(elastic.check(values_of(elastic, {{"kn", 1}, {"ks", 0}})), "");
}

} // namespace
} // namespace kaya
