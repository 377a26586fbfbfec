// What a joint model writes where it must not, in a batch of several rows.
#include "test_joint.hpp"

#include "system/ending.hpp"
#include "system/run_copies.hpp"

#include <cstdlib>
#include <gmock/gmock.h>

namespace kaya {
namespace {

using test::plugin;
using test::TestJoint;
using testing::HasSubstr;

constexpr std::size_t rows = 37;

/// The harm of tests/plugins/harmful.cpp that is chosen as long as it lives.
struct Harm {
    explicit Harm(const std::string& name) { setenv("KAYA_HARM", ("call:" + name).c_str(), 1); }
    ~Harm() { unsetenv("KAYA_HARM"); }
    Harm(const Harm&) = delete;
    Harm& operator=(const Harm&) = delete;
};

struct Reach {
    const char* harm;
    std::size_t row;
    const char* sentence;
};

class Fences : public testing::TestWithParam<Reach> {};

TEST_P(Fences, FindTheColumnAndTheRow) {
    TestJoint joint(plugin("harmful"), {{"stiffness", 1e9}}, 2, rows);
    auto batch = joint.batch();
    const Harm harm(GetParam().harm);
    const auto failure = run_batch(*joint.model, batch, nullptr, Guard::fenced);
    ASSERT_TRUE(failure);
    EXPECT_TRUE(failure->trespass);
    EXPECT_EQ(failure->row, GetParam().row);
    EXPECT_THAT(failure->message, HasSubstr(GetParam().sentence));
    EXPECT_EQ(joint.area, std::vector<double>(rows, 2)) << "what may only be read is as it was";
    EXPECT_EQ(batch.normal_force, joint.normal_force.data());
    EXPECT_EQ(batch.n, rows);
}

INSTANTIATE_TEST_SUITE_P(Reaches, Fences,
                         testing::Values(Reach{"area", 0, "wrote to 'area', which it may only read"},
                                         Reach{"last-area", rows - 1, "wrote to 'area', which it may only read"},
                                         Reach{"normal-disp", 0, "wrote to 'normal_disp', which it may only read"},
                                         Reach{"normal-disp-inc", 0, "wrote to 'normal_disp_inc'"},
                                         Reach{"shear-disp", 0, "wrote to 'shear_disp'"},
                                         Reach{"shear-disp-inc", 0, "wrote to 'shear_disp_inc'"},
                                         Reach{"pore-pressure", 0, "wrote to 'pore_pressure'"},
                                         Reach{"properties", 0, "wrote to 'properties'"},
                                         Reach{"past-force", rows - 1, "wrote after the column 'normal_force'"},
                                         Reach{"past-shear", rows - 1, "wrote after the column 'shear_force'"},
                                         Reach{"past-stiffness", rows - 1, "wrote after the column 'normal_stiffness'"},
                                         Reach{"past-state", rows - 1, "wrote after the column 'state'"},
                                         Reach{"past-history", rows - 1, "wrote after the column 'steps'"},
                                         Reach{"before-force", 0, "wrote before the column 'normal_force'"},
                                         Reach{"before-history", 0, "wrote before the column 'steps'"},
                                         Reach{"before-work", 0, "wrote before the column 'frictional_work'"},
                                         Reach{"more-rows", 0, "wrote to the table of its columns"},
                                         Reach{"other-columns", 0, "wrote to the table of its columns"},
                                         Reach{"no-columns", 0, "wrote to the table of its columns"}));

TEST(Fences, ChangeNoBit) {
    TestJoint fenced(plugin("works"), {{"stiffness", 3}}, 0.7, rows);
    for (std::size_t i = 0; i < rows; ++i) fenced.normal_disp_inc[i] = -0.1 / static_cast<double>(i + 1);
    TestJoint plain = fenced;
    auto in_fences = fenced.batch(), without = plain.batch();
    ASSERT_FALSE(run_batch(*fenced.model, in_fences, nullptr, Guard::fenced));
    ASSERT_FALSE(run_batch(*plain.model, without, nullptr, Guard::in_cycle));
    EXPECT_EQ(fenced.normal_force, plain.normal_force);
    EXPECT_EQ(fenced.normal_stiffness, plain.normal_stiffness);
    EXPECT_NE(fenced.normal_force[0], 0);
}

TEST(Fences, MeetEachBatchOnceInAWhile) {
    JointRegistry registry;
    registry.set_path({KAYA_TEST_PLUGINS});
    registry.get("works");
    JointModel& works = *registry.loaded().front();
    for (std::int64_t batch = 0; batch < 300; ++batch) {
        std::int64_t last = 10'000, longest = 0;
        int count = 0;
        for (std::int64_t cycle = 10'000; cycle < 12'000; ++cycle) {
            if (guard_in_cycle(works, cycle, batch) != Guard::fenced) continue;
            longest = std::max(longest, cycle - last);
            last = cycle;
            ++count;
        }
        EXPECT_LE(longest, 128);
        EXPECT_LE(count, 16) << "it would cost too much";
    }
    works.fence_all_calls(true);
    EXPECT_EQ(guard_in_cycle(works, 10'001, 0), Guard::fenced);
    EXPECT_EQ(guard_in_cycle(plugin("works"), 10'001, 0), Guard::in_cycle) << "that of another owner";
    works.fence_all_calls(false);
    EXPECT_EQ(guard_in_cycle(works, 10'001, 0), Guard::in_cycle);
}

/// An end of a process, as waitpid() tells it.
constexpr int exited(int status) { return status << 8; }

TEST(Ending, HasTheStatusOfSuccessOnlyAsItsOwnEnd) {
    testing::internal::CaptureStderr();
    begin_run_record();
    const AtCommand at_command("cycle 2000 (wall.3dd:7)");
    EXPECT_EQ(tell_ending(exited(0)).status, 2);
    EXPECT_EQ(tell_ending(exited(5)).status, 2);
    EXPECT_EQ(tell_ending(9).signal, 9);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_THAT(said, HasSubstr("ended with status 0 before the run came to its end"));
    EXPECT_THAT(said, HasSubstr("ended with status 5 before the run came to its end"));
    EXPECT_THAT(said, HasSubstr("ended by signal 9 (Killed)"));
    EXPECT_THAT(said, HasSubstr("the last command: cycle 2000 (wall.3dd:7)"));

    begin_run_record();
    const Called* who = called("wear", "/lib/wear.so", "joint model");
    note_copy(who, "run");
    note_end(0);
    testing::internal::CaptureStderr();
    EXPECT_EQ(tell_ending(exited(0)).status, 2) << "a second process was found too late for the run";
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                HasSubstr("joint model 'wear' made a second process of the run"));

    testing::internal::CaptureStderr();
    for (const int status : {0, 1, 2, 3, 141}) {
        begin_run_record();
        note_end(status);
        EXPECT_EQ(tell_ending(exited(status)).status, status);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace kaya
