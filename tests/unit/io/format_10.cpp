// A file of the first format that is read for good, as it was written then.
#include "io/info.hpp"
#include "io/save.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/cycle.hpp"
#include "model/state.hpp"

#include <gtest/gtest.h>

using namespace kaya;

// Blocks with and without zones, a table drives a load, a joint is weak, there are histories, a FISH variable and a named range.
TEST(Format10, IsReadAndGoesOn) {
    Model model;
    const SaveExtras extras = restore_state(model, KAYA_FORMAT_10);
    EXPECT_EQ(extras.title, "The first format that is kept");
    EXPECT_EQ(model.clock.cycle, 50);
    EXPECT_EQ(model.blocks.size(), 4u);
    EXPECT_GT(model.zones.size(), 0u);
    EXPECT_EQ(model.histories.all.size(), 2u);
    JointRegistry joints;
    joints.set_path({KAYA_TEST_JOINTS});
    Cycle cycle(model, joints);
    cycle.hooks.table_value = [](std::int64_t, double) { return 1.0; };
    for (int k = 0; k < 5; ++k) cycle.advance();
    EXPECT_EQ(model.clock.cycle, 55);
}

TEST(Format10, InfoSaysWhoReadsIt) {
    const std::string text = describe_save_file(KAYA_FORMAT_10);
    EXPECT_NE(text.find("(format 10)"), std::string::npos);
    EXPECT_NE(text.find("read by         this program and later ones"), std::string::npos);
}
