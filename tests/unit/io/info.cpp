#include "io/info.hpp"

#include "base/diagnostic.hpp"
#include "io/save.hpp"
#include "model/fields/sampling.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace kaya;
using namespace kaya::test;

TEST(Info, ASaveFileInWords) {
    const ScratchFolder folder;
    Model model = hand_made_model();
    add_history(model, {HistorySource::Kind::function, "sstav"}, "Shear Stress");
    SaveExtras extras;
    extras.program_version = "0.1.0";
    extras.title = "Direct shear";
    extras.decks = {{"a.3dd", "new\ncycle 10\n"}, {"b.fis", "def f\nend"}, {"c.dat", ""}};
    extras.scripts = {{"lua", "12345"}};
    save_state(model, folder / "a.sav", extras);
    EXPECT_EQ(describe_save_file(folder / "a.sav"),
              fmt::format("file            {} (format 14)\n"
                          "written by      kaya 0.1.0\n"
                          "read by         this program and later ones; none that is older than format 14\n"
                          "title           Direct shear\n"
                          "cycle           42\n"
                          "time            0.1, step 0\n"
                          "unbalanced      force 12.5, average ratio 0\n"
                          "blocks          2 (1 deformable), 8 gridpoints, 1 zones, 8 faces\n"
                          "contacts        1, 2 sub-contacts\n"
                          "joint models    mohr (1 contact)\n"
                          "histories       1, 0 samples, every cycle\n"
                          "                1:Shear Stress [script sstav]\n"
                          "deck            a.3dd, 2 lines\n"
                          "deck            b.fis, 2 lines\n"
                          "deck            c.dat, 0 lines\n"
                          "also            lua, 5 bytes\n"
                          "state hash      {:016x}\n",
                          folder / "a.sav", state_hash(model)));
}

TEST(Info, AnEmptyModel) {
    const ScratchFolder folder;
    Model model;
    save_state(model, folder / "a.sav", {});
    const std::string text = describe_save_file(folder / "a.sav");
    EXPECT_NE(text.find("joint models    none\n"), std::string::npos);
    EXPECT_EQ(text.find("title"), std::string::npos);
}

TEST(Info, AFileThatIsNone) {
    const ScratchFolder folder;
    put(folder / "a.3dd", "new\n");
    EXPECT_THROW(describe_save_file(folder / "a.3dd"), Diagnostic);
    EXPECT_THROW(describe_save_file(folder / "none.sav"), Diagnostic);
}
