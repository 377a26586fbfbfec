#include "test_joint.hpp"
#include "laws/stiffness_trial.hpp"

#include "base/diagnostic.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace kaya {
namespace {

using test::plugin;
using test::shipped;
using test::values_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::string found(const JointModel& model, std::string_view word) {
    const auto index = model.find_property(word);
    return index ? model.properties[*index].name : "";
}

TEST(JointModel, FindsAPropertyByNameAliasAndBeginning) {
    const auto& mohr = shipped("mohr");
    EXPECT_EQ(found(mohr, "stiffness-normal"), "stiffness-normal");
    EXPECT_EQ(found(mohr, "jkn"), "stiffness-normal");
    EXPECT_EQ(found(mohr, "JKS"), "stiffness-shear");
    EXPECT_EQ(found(mohr, "stiffness-n"), "stiffness-normal");
    EXPECT_EQ(found(mohr, "stiff-n"), "stiffness-normal") << "each part may be shortened";
    EXPECT_EQ(found(mohr, "fric-residual"), "friction-residual");
    EXPECT_EQ(found(mohr, "c-r"), "cohesion-residual");
    EXPECT_EQ(found(mohr, "fric-"), "");
}

TEST(JointModel, AWholeNameWinsOverTheBeginningOfAnother) {
    EXPECT_EQ(found(shipped("mohr"), "friction"), "friction");
    EXPECT_EQ(found(shipped("mohr"), "friction-"), "friction-residual");
    EXPECT_EQ(found(shipped("mohr"), "frict"), "friction");
    EXPECT_EQ(found(shipped("mohr"), "dilat"), "dilation");
}

TEST(JointModel, AnAmbiguousOrUnknownWordIsRefused) {
    EXPECT_EQ(found(shipped("mohr"), "stiffness-"), "");
    EXPECT_EQ(found(shipped("mohr"), "st"), "");
    EXPECT_EQ(found(shipped("mohr"), "jcoo"), "");
    EXPECT_EQ(found(shipped("mohr"), ""), "");
}

TEST(JointModel, ManyWordsOfOnePropertyAreNotAmbiguous) {
    EXPECT_EQ(found(shipped("barton-bandis"), "jc"), "jcso"); // jcso and jcs
    EXPECT_EQ(found(shipped("barton-bandis"), "jr"), "");     // jrco and jrfric
}

TEST(JointModel, NamesRequiredProperties) {
    const auto& mohr = shipped("mohr");
    EXPECT_THAT(mohr.missing(values_of(mohr, {{"jkn", 1}})), ElementsAre("stiffness-shear"));
    EXPECT_THAT(mohr.missing(values_of(mohr, {{"jkn", 1}, {"jks", 1}})), ElementsAre());
}

TEST(JointModel, PassesOnTheSentenceOfItsCheck) {
    const auto& mohr = shipped("mohr");
    EXPECT_EQ(mohr.check(values_of(mohr, {{"jkn", 1}, {"jks", 1}})), "");
    EXPECT_THAT(mohr.check(values_of(mohr, {{"jkn", 0}, {"jks", 1}})), HasSubstr("stiffness-normal (jkn) is 0"));
}

TEST(JointModel, AModelWithoutACheckAgreesToEverything) { EXPECT_EQ(plugin("works").check({-1}), ""); }

TEST(JointModel, ACheckThatThrowsIsASentence) {
    EXPECT_EQ(plugin("throws").check({1}), "joint model throws threw an exception from check(): no table");
}

TEST(JointModel, GivesTheStiffnessToStartWith) {
    const auto& mohr = shipped("mohr");
    const auto stiffness = initial_stiffness(mohr, values_of(mohr, {{"jkn", 3}, {"jks", 2}}));
    EXPECT_EQ(stiffness.normal, 3);
    EXPECT_EQ(stiffness.shear, 2);
}

TEST(JointModel, RefusesAStiffnessThatGivesNoTimeStep) {
    for (const char* name : {"no-stiffness", "throws"}) {
        try {
            initial_stiffness(plugin(name), {1});
            ADD_FAILURE() << name;
        } catch (const Diagnostic& d) {
            EXPECT_THAT(d.message, HasSubstr("gives no stiffness to compute a time step from")) << name;
            EXPECT_EQ(d.fault, Fault::run);
            ASSERT_EQ(d.context.size(), 1u);
        }
    }
    EXPECT_THROW(initial_stiffness(plugin("works"), {-1}), Diagnostic);
    try {
        initial_stiffness(plugin("too-soft"), {5});
        ADD_FAILURE() << "a model that is a hundred times stiffer than it says was taken";
    } catch (const Diagnostic& d) {
        EXPECT_EQ(d.context.at(0), "it resists closing with a stiffness of 5, and reports 0.05");
    }
    const auto reason = [](const char* name) -> std::string {
        try {
            initial_stiffness(plugin(name), {5});
        } catch (const Diagnostic& d) { return d.context.at(0); }
        return "taken";
    };
    EXPECT_EQ(reason("shears-hard"), "it resists shear with a stiffness of 50, and reports 5");
    EXPECT_EQ(reason("stiffens"), "it resists closing with a stiffness of 50, and reports 5");
    EXPECT_EQ(reason("works"), "taken");
    EXPECT_THROW(initial_stiffness(plugin("works"), {NAN}), Diagnostic);
    EXPECT_THROW(initial_stiffness(plugin("works"), {INFINITY}), Diagnostic);
}

} // namespace
} // namespace kaya
