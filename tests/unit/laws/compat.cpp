// Sources in the dialects of 3DEC 4, 7 and 9, compiled unchanged, and their behaviour in the program.
#include "test_joint.hpp"
#include "laws/stiffness_trial.hpp"

#include "base/diagnostic.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace kaya::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

double tan_degrees(double angle) { return std::tan(angle * (std::numbers::pi / 180)); }

const Values wear_values = {{"jkn", 1e9}, {"jks", 5e8}, {"jfriction", 30}};
const Values cap_values = {{"kn", 2e9}, {"ks", 1e9}, {"friction", 35}};
const Values slip_values = {{"kn", 2e9},       {"ks", 1e9},     {"friction", 30}, {"friction-residual", 25},
                            {"cohesion", 1e4}, {"tension", 2e3}};

std::vector<std::string> names_of(const JointModel& model) {
    std::vector<std::string> names;
    for (const auto& property : model.properties) names.push_back(property.name);
    return names;
}

/// The message of the failing row in a step of this opening.
std::string failure_of(TestJoint& joint, double opening, double slip = 0) {
    joint.normal_disp_inc[0] = opening;
    joint.shear_disp_inc[0][0] = slip;
    auto batch = joint.batch();
    const auto failure = run_batch(*joint.model, batch);
    return failure ? failure->message : "";
}

TEST(Compat, TellsWhatTheClassSaysOfItself) {
    const auto& wear = compat("wear");
    EXPECT_EQ(wear.title, "Joint that wears");
    EXPECT_EQ(wear.version, "5.2");
    EXPECT_THAT(names_of(wear), ElementsAre("jkn", "jks", "jfriction", "jcohesion", "weartable", "wears"));
    EXPECT_THAT(wear.properties[2].aliases, ElementsAre("friction"));
    EXPECT_THAT(wear.states, ElementsAre("slip-n", "tension-n", "slip-p", "tension-p"));

    const auto& cap = compat("masonry_cap");
    EXPECT_EQ(cap.version, "7.3");
    EXPECT_THAT(names_of(cap), ElementsAre("stiffness-normal", "stiffness-shear", "friction", "tension", "strength_cap",
                                           "table_cap", "pull-x", "pull-y", "pull-z", "steps", "friction_residual"));
    EXPECT_THAT(cap.properties[0].aliases, ElementsAre("kn", "jkn"));
    EXPECT_EQ(cap.properties[4].initial, 1e20);
    EXPECT_THAT(cap.states, ElementsAre("slip-n", "tension-n", "slip-p", "tension-p", "cap-n", "cap-p"));

    const auto& slip = compat("slip9");
    EXPECT_EQ(slip.version, "9.14");
    EXPECT_TRUE(std::isnan(slip.properties[8].initial)); // an empty text
    ASSERT_EQ(slip.history.size(), 2u);
    EXPECT_EQ(slip.history[0].name, "energy-slip");
}

TEST(Compat, RunsTheDialectOfVersion4) {
    TestJoint joint(compat("wear"), wear_values, 2);
    joint.step(-1e-4);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 1e5);
    joint.step(0, {1e-5, 0, 0});
    EXPECT_DOUBLE_EQ(joint.shear_stress(), 5e3);
    EXPECT_LT(joint.shear_force[0][0], 0);
    joint.step(0, {1e-3, 0, 0});
    EXPECT_DOUBLE_EQ(joint.shear_stress(), 1e5 * tan_degrees(30));
    EXPECT_TRUE(joint.in_state("slip-n"));
    joint.step(2e-4);
    EXPECT_EQ(joint.normal_force[0], 0);
    EXPECT_TRUE(joint.in_state("tension-n"));
    EXPECT_TRUE(joint.in_state("slip-p"));
    EXPECT_FALSE(joint.in_state("slip-n"));
}

TEST(Compat, ReadsATableByNumber) {
    auto values = wear_values;
    values["weartable"] = 7;
    values["wears"] = 1;
    TestJoint joint(compat("wear"), values);
    joint.step(-1e-4);
    for (int i = 0; i < 200; ++i) joint.step(0, {1e-5, 0, 0});
    EXPECT_NEAR(joint.shear_stress(), 1e5 * tan_degrees(20), 1e-6 * 1e5); // worn down to the end of the table
    values["weartable"] = 99;
    TestJoint lost(compat("wear"), values);
    EXPECT_EQ(failure_of(lost, -1e-5), "joint model wear failed: the wear table is not there");
}

TEST(Compat, RunsTheDialectOfVersion7) {
    auto values = cap_values;
    values["strength_cap"] = 3e5;
    values["table_cap"] = 8;
    TestJoint joint(compat("masonry_cap"), values, 0.5);
    joint.step(-1e-4);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 2e5);
    joint.step(-1e-4);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 3e5); // crushed by 5e-5 so far, the table begins with 1
    EXPECT_TRUE(joint.in_state("cap-n"));
    joint.step(-1e-6);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 3e5 + 2e3); // it hardens by the table
    joint.step(-1e-4);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 3e5 * (1 + 50e-6 / 1e-3));
    EXPECT_TRUE(joint.in_state("cap-p"));
}

TEST(Compat, ResidualThatFollowsAPropertyIsSetByCommandsOnly) {
    TestJoint joint(compat("masonry_cap"), cap_values);
    joint.step(-1e-4);
    joint.step(0, {1e-2, 0, 0});
    joint.step(0, {1e-2, 0, 0});
    EXPECT_DOUBLE_EQ(joint.shear_stress(), 2e5 * tan_degrees(35));
}

TEST(Compat, ExceptionsOfRunAndInitializeAreTheRowsOwn) {
    TestJoint joint(compat("masonry_cap"), {{"kn", 2e9}, {"table_cap", 3}}, 1, 3);
    EXPECT_EQ(failure_of(joint, -1e-5), "joint model masonry_cap failed: no table named 3 for the cap");
    auto values = slip_values;
    values["report"] = 1;
    TestJoint slips(compat("slip9"), values, 1, 5);
    slips.step(-1e-4);
    slips.shear_disp_inc[1][3] = 1;
    for (auto& inc : slips.normal_disp_inc) inc = 0;
    auto batch = slips.batch();
    const auto failure = run_batch(*slips.model, batch);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->row, 3u);
    EXPECT_EQ(failure->message, "joint model slip9 failed: slip, after a step of 0.000010");
}

TEST(Compat, EnergiesAreHistoryVariablesAndSlipIsTakenUp) {
    TestJoint joint(compat("slip9"), slip_values);
    joint.step(-1e-4);
    EXPECT_DOUBLE_EQ(joint.history_value("energy-strain"), 0.5 * 2e9 * 1e-8);
    double work = 0;
    for (int i = 0; i < 100; ++i) {
        const TestJoint before = joint;
        joint.step(0, {1e-5, 0, 0});
        work += work_of_step(before, joint);
    }
    EXPECT_GT(joint.history_value("energy-slip"), 0);
    const double stored = joint.history_value("energy-strain") - 0.5 * 2e9 * 1e-8;
    EXPECT_NEAR(joint.frictional_work[0], work - stored, 1e-9 * work);
    // The model adds the force after the step times the slip; the decrease of strength is the difference.
    EXPECT_NEAR(joint.frictional_work[0], joint.history_value("energy-slip"), 0.02 * work);
}

TEST(Compat, APropertyThatChangesOnTheWayReachesTheObject) {
    TestJoint joint(compat("slip9"), slip_values);
    joint.step(-1e-4);
    joint.step(0, {1e-2, 0, 0});
    joint.step(0, {1e-2, 0, 0});
    EXPECT_DOUBLE_EQ(joint.shear_stress(), 2e5 * tan_degrees(25));
    joint.values[*joint.model->find_property("friction-residual")] = 20;
    joint.step(0, {1e-2, 0, 0});
    EXPECT_DOUBLE_EQ(joint.shear_stress(), 2e5 * tan_degrees(20));
    joint.values[*joint.model->find_property("kn")] = 4e9;
    joint.step(0);
    EXPECT_EQ(joint.normal_stiffness[0], 4e9);
}

TEST(Compat, WhatAnObjectHoldsOfAPropertyIsSeenAndSet) {
    TestJoint joint(compat("slip9"), slip_values, 1, 3);
    const auto kn = *joint.model->find_property("kn");
    joint.step(-1e-4);
    ASSERT_TRUE(joint.model->shows_objects());
    EXPECT_EQ(joint.model->object_value(joint.object[0], kn), 2e9);
    EXPECT_TRUE(joint.model->set_object_value(joint.object[1], kn, 4e9));
    joint.step(-1e-5);
    EXPECT_EQ(joint.normal_stiffness, (std::vector<double>{2e9, 4e9, 2e9}));
    EXPECT_EQ(joint.model->object_value(joint.object[1], kn), 4e9);
    // A command that sets another value changes all of them.
    joint.values[kn] = 3e9;
    joint.step(-1e-5);
    EXPECT_EQ(joint.normal_stiffness, (std::vector<double>{3e9, 3e9, 3e9}));
    // There is no value without an object, and models without objects have none.
    EXPECT_FALSE(joint.model->object_value(JointObject(), kn));
    EXPECT_FALSE(test::shipped("mohr").shows_objects());
}

TEST(Compat, ManySetsOfValuesDoNotMix) {
    std::vector<TestJoint> joints;
    for (int k = 0; k < 40; ++k) {
        auto values = slip_values;
        values["kn"] = 1e9 + 1e6 * k;
        joints.emplace_back(compat("slip9"), values, 1, 2);
    }
    for (int round = 0; round < 3; ++round)
        for (auto& joint : joints) joint.step(-1e-5);
    for (int k = 0; k < 40; ++k)
        EXPECT_NEAR(joints[static_cast<std::size_t>(k)].normal_force[1], 3e-5 * (1e9 + 1e6 * k), 1e-9) << k;
}

TEST(Compat, WhatWasSavedGoesOnAsIfNothingHadHappened) {
    for (const char* name : {"masonry_cap", "wear", "slip9"}) {
        auto values = name == std::string("masonry_cap") ? cap_values
                      : name == std::string("wear")      ? wear_values
                                                         : slip_values;
        if (name == std::string("masonry_cap"))
            values.insert({{"strength_cap", 3e5}, {"table_cap", 8}, {"pull-y", 10}});
        if (name == std::string("wear")) values.insert({{"weartable", 7}, {"wears", 1}});
        TestJoint joint(compat(name), values, 0.7, 3);
        for (int i = 0; i < 40; ++i) joint.step(-1e-5, {3e-6, 1e-6, 0});
        TestJoint restored = joint;
        for (auto& object : restored.object) {
            const std::string bytes = object.bytes();
            const auto asleep = JointObject::asleep(bytes);
            EXPECT_TRUE(asleep.is_asleep());
            EXPECT_EQ(JointObject(asleep).bytes(), bytes);
            object = restored.model->restore_object(restored.values, asleep.bytes());
            EXPECT_EQ(object.bytes(), bytes) << name;
        }
        for (int i = 0; i < 40; ++i) {
            joint.step(i < 20 ? -1e-5 : 1e-5, {3e-6, -1e-6, 2e-6});
            restored.step(i < 20 ? -1e-5 : 1e-5, {3e-6, -1e-6, 2e-6});
        }
        EXPECT_EQ(joint.normal_force, restored.normal_force) << name;
        EXPECT_EQ(joint.shear_force, restored.shear_force) << name;
        EXPECT_EQ(joint.state, restored.state) << name;
        for (std::size_t row = 0; row < 3; ++row)
            EXPECT_EQ(joint.object[row].bytes(), restored.object[row].bytes()) << name;
    }
}

TEST(Compat, BytesThatWereCutOffAreRefused) {
    TestJoint joint(compat("masonry_cap"), cap_values);
    joint.step(-1e-5);
    const std::string bytes = joint.object[0].bytes();
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
        try {
            joint.model->restore_object(joint.values, std::string_view(bytes).substr(0, size));
            ADD_FAILURE() << size << " bytes of " << bytes.size() << " were taken";
        } catch (const Diagnostic& diagnostic) { EXPECT_THAT(diagnostic.message, HasSubstr("ends too early")); }
    }
}

TEST(Compat, AnAreaOfZeroAndARowOfManyDoNoHarm) {
    for (const char* name : {"masonry_cap", "wear", "slip9"}) {
        TestJoint joint(compat(name), {{"kn", 1e9}, {"ks", 1e9}, {"friction", 30}}, 0, 37);
        joint.step(-1e-5, {1e-6, 0, 0});
        joint.step(1e-4, {1e-6, 0, 0});
        for (std::size_t row = 0; row < 37; ++row) EXPECT_EQ(joint.normal_force[row], 0);
    }
}

TEST(Compat, StiffnessComesFromTheObject) {
    EXPECT_EQ(initial_stiffness(compat("wear"), values_of(compat("wear"), wear_values)).normal, 1e9);
    EXPECT_THROW(initial_stiffness(compat("wear"), values_of(compat("wear"), {})), Diagnostic);
}

TEST(Compat, BatchesWithoutRoomForObjectsAreRefused) {
    TestJoint joint(compat("wear"), wear_values);
    auto batch = joint.batch();
    batch.object = nullptr;
    EXPECT_THAT(run_batch(*joint.model, batch)->message, HasSubstr("stores objects"));
}

} // namespace
} // namespace kaya::test
