// Save files of programs with one name less than this one, or one column more.
#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "io/save_archive.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "model/whole/consistency.hpp"
#include "model/fields/sampling.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/unit/model/hand_made.hpp"
#include "tests/unit/model/other_walk.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

using namespace kaya;
using namespace kaya::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

Model saved_model() {
    Model model = hand_made_model();
    add_history(model, {HistorySource::Kind::global, "unbalanced_force"});
    sample_histories(model, 1, {});
    return model;
}

struct OtherProgram {
    std::string without, with; ///< OtherWalk
    double more = 0;

    void walk(Archive& archive, Model& model) const {
        OtherWalk other(archive);
        other.without = without;
        other.with = with;
        other.more.assign(model.gridpoints.size(), more);
        visit_state(other, model);
    }
    std::uint64_t hash(Model& model) const {
        HashArchive archive;
        walk(archive, model);
        return archive.digest();
    }
    /// The saved image; `hash` replaces its hash if given.
    std::string image(Model& model, std::uint64_t hash) const {
        TreeWriter tree;
        SaveArchive archive(tree);
        std::int32_t version = save_format_version;
        archive.value("format_version", version);
        archive.value("state_hash", hash);
        SaveExtras extras;
        extras.program_version = "9.8.7";
        visit_extras(archive, extras);
        archive.section("model", [&] { walk(archive, model); });
        return with_trailer(tree.image());
    }
};

Diagnostic refusal(const std::string& image) {
    Model model;
    try {
        restore_image(model, image, "x.sav");
    } catch (const Diagnostic& d) {
        EXPECT_TRUE(model.blocks.empty());
        return d;
    }
    return Diagnostic("nothing was refused");
}

} // namespace

// Data that an earlier program did not have are those of a new model. Without links and ids there is no model; loads and motion of blocks
// are never required.
TEST(OtherPrograms, SavesOfOneThatKnowsOneNameLessAreRestored) {
    Model model = saved_model();
    std::set<std::string> never_needed;
    model.tables([&](const char* table_name, auto& table) {
        table.columns([&](const std::string& column, const auto&, Role role) {
            if (role == Role::load || role == Role::motion || role == Role::displacement || role == Role::state)
                never_needed.insert(fmt::format("{}/{}", table_name, column));
        });
    });
    EXPECT_GT(never_needed.size(), 60u);
    int restored_files = 0;
    for (const auto& name : names_of(model).all) {
        const OtherProgram earlier{name, {}};
        const auto hash = earlier.hash(model);
        Model restored;
        try {
            const SaveExtras extras = restore_image(restored, earlier.image(model, hash), "x.sav");
            EXPECT_THAT(extras.missing, ElementsAre(name));
            EXPECT_EQ(inconsistency(restored), "") << name;
            EXPECT_EQ(state_hash(restored), hash) << name;
            ++restored_files;
        } catch (const Diagnostic& refused) {
            EXPECT_THAT(refused.message, HasSubstr("lacks " + name));
            EXPECT_FALSE(never_needed.contains(name)) << name;
        }
    }
    EXPECT_GT(restored_files, 200);
}

TEST(OtherPrograms, AColumnThatADamagedFileHasLostIsNoticedWhenItHeldSomething) {
    Model model = saved_model();
    const auto hash = state_hash(model);
    const auto holding = names_of(model).holding;
    EXPECT_GT(holding.size(), 30u);
    for (const auto& name : holding)
        EXPECT_THAT(refusal(OtherProgram{name, {}}.image(model, hash)).message, HasSubstr("lacks " + name));
    const std::string unused = "gridpoints/pore_pressure";
    ASSERT_FALSE(holding.contains(unused));
    Model restored;
    restore_image(restored, OtherProgram{unused, {}}.image(model, hash), "x.sav");
    EXPECT_EQ(state_hash(restored), hash);
}

TEST(OtherPrograms, AColumnOfALaterOneIsPassedOverUntilItIsUsed) {
    Model model = saved_model();
    const OtherProgram later{{}, "gridpoints/temperature"}, using_it{{}, "gridpoints/temperature", 20};
    Model restored;
    const SaveExtras extras = restore_image(restored, later.image(model, later.hash(model)), "x.sav");
    EXPECT_TRUE(extras.missing.empty());
    EXPECT_EQ(state_hash(restored), state_hash(model));
    const Diagnostic refused = refusal(using_it.image(model, using_it.hash(model)));
    EXPECT_EQ(refused.message,
              "'x.sav' cannot be restored: it holds gridpoints/temperature, which this program does not know");
    EXPECT_EQ(refused.hint, "the model is unchanged; restore it with kaya 9.8.7, which wrote it, or a later one");
}

TEST(OtherPrograms, ATableWithoutMostOfItsColumnsAsksForNoMemory) {
    TreeWriter tree;
    const std::int32_t version = save_format_version;
    const std::uint64_t none = 0, rows = 60'000;
    tree.attribute("format_version", &version, 1);
    tree.attribute("state_hash", &none, 1);
    tree.text("program_version", "");
    tree.text("title", "");
    for (const auto* list : {"scripts", "decks"}) {
        tree.open_group(list);
        tree.attribute("count", &none, 1);
        tree.close_group();
    }
    tree.open_group("model");
    tree.open_group("gridpoints");
    tree.attribute("rows", &rows, 1);
    const std::vector<std::uint8_t> fixed(rows, 0);
    tree.data("fixed", fixed.data(), rows, 1);
    tree.close_group();
    tree.close_group();
    EXPECT_EQ(refusal(with_trailer(tree.image())).message,
              "'x.sav' cannot be restored: gridpoints has too few columns for its rows");
}
