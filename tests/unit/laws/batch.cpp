#include "test_joint.hpp"

#include <gmock/gmock.h>

namespace kaya {
namespace {

using test::plugin;
using test::TestJoint;
using testing::HasSubstr;

/// The message of the guard for a batch of 20 rows in which row 13 fails in the given way.
std::optional<BatchFailure> failure_of(int way) {
    TestJoint joint(plugin("misbehaves"), {{"stiffness", way}}, 1, 20);
    joint.normal_disp[0] = 13;
    auto batch = joint.batch();
    return run_batch(*joint.model, batch);
}

TEST(Batch, RunsAModelThatWorks) {
    TestJoint joint(plugin("works"), {{"stiffness", 5}}, 2, 3);
    joint.step(-0.5);
    EXPECT_EQ(joint.normal_force, (std::vector<double>{5, 5, 5}));
    EXPECT_EQ(joint.history_value("steps"), 1);
}

TEST(Batch, AnEmptyBatchIsWell) {
    TestJoint joint(plugin("works"), {}, 1, 0);
    auto batch = joint.batch();
    EXPECT_FALSE(run_batch(*joint.model, batch));
}

struct Misbehaviour {
    int way;
    std::size_t row;
    const char* sentence;
};

class Guard : public testing::TestWithParam<Misbehaviour> {};

TEST_P(Guard, FindsTheRowAndTheReason) {
    const auto failure = failure_of(GetParam().way);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->row, GetParam().row);
    EXPECT_THAT(failure->message, HasSubstr(GetParam().sentence));
    EXPECT_THAT(failure->message, HasSubstr("joint model misbehaves"));
}

INSTANTIATE_TEST_SUITE_P(
    Misbehaviours, Guard,
    testing::Values(Misbehaviour{0, 13, "returned normal force nan"}, Misbehaviour{1, 13, "returned shear force z inf"},
                    Misbehaviour{2, 13, "returned normal stiffness -1"}, Misbehaviour{3, 13, "returned steps nan"},
                    Misbehaviour{4, 0, "returned row 29 of a batch of 20 rows"},
                    Misbehaviour{5, 0, "returned row -2 of a batch of 20 rows"},
                    Misbehaviour{6, 13, "failed: it gives no reason"},
                    Misbehaviour{7, 13, "failed: the wear table ends at 0.5"}, Misbehaviour{8, 13, "failed: xxxxxxxx"},
                    Misbehaviour{10, 13, "returned frictional work nan"}));

TEST(Batch, MinusZeroIsNotNegative) { EXPECT_FALSE(failure_of(9)); }

TEST(Batch, AMessageOfAnEarlierCallIsForgotten) {
    TestJoint joint(plugin("misbehaves"), {{"stiffness", 7}}, 1, 2);
    auto batch = joint.batch();
    EXPECT_THAT(run_batch(*joint.model, batch)->message, HasSubstr("the wear table ends"));
    joint.values[0] = 6;
    EXPECT_THAT(run_batch(*joint.model, batch)->message, HasSubstr("it gives no reason"));
}

TEST(Batch, CatchesWhatAModelThrows) {
    TestJoint joint(plugin("works"), {}, 1, 2);
    auto batch = joint.batch();
    const auto& throws = plugin("throws");
    EXPECT_THAT(run_batch(throws, batch)->message, HasSubstr("joint model throws threw an exception"));
    EXPECT_THAT(run_batch(throws, batch)->message, HasSubstr("the table of wear is empty"));
    EXPECT_THAT(initialise_batch(throws, batch)->message, HasSubstr("not a std::exception"));
}

} // namespace
} // namespace kaya
