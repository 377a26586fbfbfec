#include "tests/unit/commands/running.hpp"

#include <gmock/gmock.h>

namespace kaya {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SessionTest : public Running {};

class StrictSessionTest : public Running {
protected:
    static Options strict() {
        Options options;
        options.strict = true;
        return options;
    }
    StrictSessionTest() : Running(strict()) {}
};

TEST_F(SessionTest, ARangeThatMatchesNothingIsAWarning) {
    run("poly brick 0 1\nfix range x 5 6\n");
    EXPECT_THAT(said(), HasSubstr("test.3dd:2:5: warning: 0 of 1 blocks matched"));
    EXPECT_EQ(session().program.warnings, 1u);
    EXPECT_EQ(model().blocks.fixed[0], 0);
}

TEST_F(SessionTest, AnEmptyModelIsNotCalledUnmatched) {
    run("fix\n");
    EXPECT_THAT(said(), HasSubstr("there are no blocks"));
}

TEST_F(StrictSessionTest, WarningsAreErrors) {
    const Diagnostic problem = mistake("poly brick 0 1\nfix range x 5 6\n");
    EXPECT_EQ(problem.message, "0 of 1 blocks matched");
    EXPECT_EQ(problem.severity, Severity::error);
    EXPECT_EQ(problem.place.line, 2);
}

TEST_F(SessionTest, NewForgetsTheModelAndTheScripts) {
    run("poly brick 0 1\nset @x = 5\nrange name all x 0 1\nnew\n");
    EXPECT_EQ(model().blocks.size(), 0u);
    EXPECT_TRUE(session().deck.ranges.empty());
    EXPECT_FALSE(mistake("print @x\n").message.empty());
}

TEST_F(SessionTest, NotesAreSaidOnce) {
    run("label arrow 1\nlabel arrow 2\n");
    const std::string text = said();
    EXPECT_EQ(text.find("note"), text.rfind("note"));
    EXPECT_THAT(text, HasSubstr("test.3dd:1:1: note"));
}

TEST_F(SessionTest, AnInterruptStopsBeforeTheNextCommand) {
    session().interrupt();
    const Diagnostic problem = mistake("poly brick 0 1\n");
    EXPECT_EQ(problem.fault, Fault::run);
    EXPECT_EQ(model().blocks.size(), 0u);
    run("poly brick 0 1\n");
    EXPECT_EQ(model().blocks.size(), 1u);
}

TEST_F(SessionTest, GroupsKeepTheirNumbers) {
    run("poly brick 0 1\npoly brick 2 3\ngroup block a range x 0 1\ngroup block b range x 2 3\ngroup block "
        "a\n");
    EXPECT_THAT(model().group_names, ElementsAre("", "a", "b"));
    EXPECT_THAT(model().blocks.group, ElementsAre(1, 1));
}

TEST_F(SessionTest, ConfigKnowsItsWords) {
    run("config dyn cppudm\n");
    EXPECT_TRUE(model().settings.dynamic);
    EXPECT_EQ(mistake("config thremal\n").hint, "did you mean 'thermal'?");
}

class MaterialsTest : public Running {};

TEST_F(MaterialsTest, YoungAndPoissonGiveBulkAndShear) {
    run("prop mat 1 ymod 10 prat 0.25\n");
    EXPECT_DOUBLE_EQ(model().materials.at(1).bulk, 10 / 1.5);
    EXPECT_DOUBLE_EQ(model().materials.at(1).shear, 4);
}

TEST_F(MaterialsTest, TheyMayComeOnTwoLines) {
    run("prop mat 1 ymod 10\nprop mat 1 prat 0.25\n");
    EXPECT_DOUBLE_EQ(model().materials.at(1).shear, 4);
}

TEST_F(MaterialsTest, TheLastPairApplies) {
    run("prop mat 1 ymod 10 prat 0.25 k 3 g 2\n");
    EXPECT_EQ(model().materials.at(1).bulk, 3);
    EXPECT_TRUE(std::isnan(model().materials.at(1).young));
}

TEST_F(MaterialsTest, HalfOfAPairIsAMistakeWhenItIsUsed) {
    const Diagnostic problem = mistake("poly brick 0 1\nprop mat 1 dens 1 prat 0.2\ncycle 1\n");
    EXPECT_EQ(problem.message, "material 1 has prat but no ymod");
    EXPECT_EQ(problem.place.line, 3);
}

TEST_F(MaterialsTest, ValuesOutsideTheirLimitsArePointedAt) {
    const Diagnostic problem = mistake("prop mat 1 dens 2000 prat 0.5\n");
    EXPECT_EQ(problem.message, "'prat' is 0.5, but must be above -1 and below 0.5");
    EXPECT_EQ(problem.place.column, 22);
    EXPECT_TRUE(model().materials.empty()) << "half a line has taken effect";
    EXPECT_FALSE(mistake("prop mat 1 dens 0\n").message.empty());
    EXPECT_FALSE(mistake("prop mat 1 bfric 90\n").message.empty());
}

TEST_F(MaterialsTest, AnUnknownWordGetsAGuess) {
    const Diagnostic problem = mistake("prop mat 1 denisty 2000\n");
    EXPECT_EQ(problem.message, "'denisty' is not a property of blocks, nor of joints");
    EXPECT_EQ(problem.hint, "did you mean 'density'?");
    EXPECT_EQ(problem.place.column, 12);
}

TEST_F(MaterialsTest, JointWordsGoToTheJointMaterialOfTheSameNumber) {
    run("prop mat 2 dens 2000 jkn 1e9\n");
    EXPECT_EQ(model().materials.at(2).density, 2000);
    EXPECT_EQ(model().materials.at(2).joint.at("jkn"), 1e9);
}

TEST_F(MaterialsTest, AnotherSpellingOfAJointWordTakesItsPlace) {
    run("prop mat 1 jfriction 30 jcoh 2\nprop mat 1 jfric 35\n");
    const auto& joint = model().materials.at(1).joint;
    EXPECT_EQ(joint.size(), 2u);
    EXPECT_EQ(joint.at("jfric"), 35);
    EXPECT_EQ(joint.at("jcoh"), 2);
}

} // namespace
} // namespace kaya
