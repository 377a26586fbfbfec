// The files format-N.h5 of this folder, written by earlier programs: every later program reads them. Each contains its deck (/decks): run
// the last of them to store a file of a new format. format-10: blocks with and without zones, a table controls a load, a joint is weak,
// histories, a FISH variable, a named range. format-13 and later: also cables, beams, liners, stiffness-proportional damping, excavated
// blocks and a water table.
#include "base/diagnostic.hpp"
#include "io/info.hpp"
#include "io/save.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/cycle/cycle.hpp"
#include "model/whole/state.hpp"
#include "model/whole/state_hash.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using testing::Contains;
using testing::HasSubstr;

namespace {

std::string kept(int format) { return fmt::format("{}/format-{}.h5", KAYA_KEPT_SAVES, format); }

std::vector<int> kept_formats() {
    std::vector<int> formats;
    for (int format = first_kept_format; format <= save_format_version; ++format)
        if (std::filesystem::exists(kept(format))) formats.push_back(format);
    return formats;
}

} // namespace

TEST(KeptSaves, AreThere) { EXPECT_THAT(kept_formats(), testing::IsSupersetOf({first_kept_format, 13})); }

TEST(KeptSaves, AreReadAndContinue) {
    JointRegistry joints;
    joints.set_path({KAYA_TEST_JOINTS});
    for (const int format : kept_formats()) {
        SCOPED_TRACE(format);
        Model model;
        const SaveExtras extras = restore_state(model, kept(format));
        EXPECT_EQ(extras.format, format);
        EXPECT_EQ(model.clock.cycle, 50);
        EXPECT_GE(model.blocks.size(), 4u);
        EXPECT_GT(model.zones.size(), 0u);
        EXPECT_GE(model.histories.all.size(), 2u);
        Cycle cycle(model, joints);
        cycle.hooks.table_value = [](std::int64_t, double) { return 1.0; };
        for (int k = 0; k < 5; ++k) cycle.advance();
        EXPECT_EQ(model.clock.cycle, 55);
        Model again;
        EXPECT_TRUE(restore_image(again, save_image(model, extras), "again").missing.empty());
        EXPECT_EQ(state_hash(again), state_hash(model));
    }
}

// Names added later, by the format of the last file without them. A new column is missing in all.
TEST(KeptSaves, SayWhatTheyDoNotHave) {
    Model model;
    const auto missing = restore_state(model, kept(10)).missing;
    for (const char* name : {"cables", "members", "water_ground", "energy/structure_work", "zones/keeps_dashpots"})
        EXPECT_THAT(missing, Contains(name));
    EXPECT_EQ(model.energy.structure_work, 0);
    EXPECT_TRUE(model.zones.keeps_dashpots) << "until format 11 the column is always there";
    EXPECT_EQ(model.zones.dashpot.size(), model.zones.size());
    EXPECT_TRUE(model.settings.triangular_outer_faces) << "contacts of cells are those of triangles";
}

TEST(KeptSaves, InfoSaysWhoReadsThem) {
    for (const int format : kept_formats()) {
        const std::string text = describe_save_file(kept(format));
        EXPECT_THAT(text, HasSubstr(fmt::format("(format {})", format)));
        EXPECT_THAT(text, HasSubstr("read by         this program and later ones"));
    }
    EXPECT_THAT(describe_save_file(kept(10)), HasSubstr("not in it       "));
}
