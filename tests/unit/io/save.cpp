#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "io/hdf5_tree.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "model/whole/consistency.hpp"
#include "model/fields/sampling.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

using namespace kaya;
using namespace kaya::test;
using testing::HasSubstr;

namespace {

Model saved_model() {
    Model model = hand_made_model();
    // A deleted object leaves a free id.
    model.contacts.ids.destroy(model.contacts.ids.create(5));
    add_history(model, {HistorySource::Kind::global, "unbalanced_force"});
    add_history(model, {HistorySource::Kind::sub_contact, "shear_stress", Vec3(-1, -1, 0)}, "Shear, \"tau\"");
    sample_histories(model, 1, {});
    add_history(model, {HistorySource::Kind::function, "sstav"}, "later");
    return model;
}

SaveExtras some_extras() {
    SaveExtras extras;
    extras.program_version = "0.1.0";
    extras.title = "Direct shear: \xc3\xa9preuve";
    std::string bytes = "lua";
    bytes.push_back('\0');
    bytes += "\xff\x01";
    extras.scripts = {{"lua", bytes}, {"empty", ""}};
    extras.decks = {{"deck.3dd", "poly brick 0 1\n"}, {"a folder/b.fis", "def f\nend\n"}};
    return extras;
}

Diagnostic error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Diagnostic& d) { return d; }
    return Diagnostic("nothing was thrown");
}

/// The error of restoring these bytes; the present model must be unchanged.
Diagnostic refused(const std::string& image) {
    Model model = hand_made_model();
    const auto before = state_hash(model);
    const Diagnostic d = error_of([&] { restore_image(model, image, "x.sav"); });
    EXPECT_EQ(state_hash(model), before);
    return d;
}

/// A save file of an invalid model, as an attacker could write it, with a valid trailer.
std::string image_of(const std::function<void(Model&)>& change) {
    Model model = saved_model();
    change(model);
    return save_image(model, {});
}

} // namespace

TEST(Save, WhatIsRestoredIsWhatWasSaved) {
    const ScratchFolder folder;
    Model model = saved_model();
    save_state(model, folder / "a.sav", some_extras());
    Model restored;
    const SaveExtras extras = restore_state(restored, folder / "a.sav");

    EXPECT_EQ(state_hash(restored), state_hash(model));
    EXPECT_EQ(restored.joint_properties[0].place, "deck.3dd:23");
    EXPECT_EQ(restored.stale.contacts(), model.stale.contacts());
    EXPECT_EQ(restored.stale.properties(), model.stale.properties());
    EXPECT_TRUE(restored.stale.lists());
    EXPECT_EQ(restored.histories.all[1].label, "Shear, \"tau\"");
    EXPECT_TRUE(std::isnan(restored.materials.at(3).density));
    EXPECT_EQ(restored.contacts.ids.free_slots(), model.contacts.ids.free_slots());

    const SaveExtras given = some_extras();
    EXPECT_EQ(extras.program_version, given.program_version);
    EXPECT_EQ(extras.title, given.title);
    ASSERT_EQ(extras.scripts.size(), 2u);
    EXPECT_EQ(extras.scripts[0].content, given.scripts[0].content);
    EXPECT_EQ(extras.scripts[1].content, "");
    ASSERT_EQ(extras.decks.size(), 2u);
    EXPECT_EQ(extras.decks[1].name, "a folder/b.fis");
    EXPECT_EQ(extras.decks[1].content, "def f\nend\n");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Save, AnEmptyModelCanBeSavedAndRestored) {
    Model empty;
    Model restored = hand_made_model();
    restore_image(restored, save_image(empty, {}), "x.sav");
    EXPECT_EQ(state_hash(restored), state_hash(empty));
    EXPECT_EQ(restored.blocks.size(), 0u);
}

TEST(Save, TheSameStateGivesTheSameBytes) {
    Model first = saved_model(), second = saved_model();
    const std::string image = save_image(first, some_extras());
    EXPECT_EQ(save_image(second, some_extras()), image);
    Model restored;
    restore_image(restored, image, "x.sav");
    EXPECT_EQ(save_image(restored, some_extras()), image);
}

TEST(Save, ALargeModelKeepsEveryBitCompressedOrNot) {
    // Enough rows for chunks and compression; some columns repeat, others are noise.
    Model model;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> noise(-1, 1);
    for (int k = 0; k < 3000; ++k)
        add_tetrahedron(model, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, k % 2 == 0);
    for (auto& position : model.gridpoints.position) position = Vec3(noise(random), noise(random), noise(random));
    for (auto& mass : model.gridpoints.mass) mass = 1.0 / 3.0;
    ASSERT_EQ(inconsistency(model), "");
    const std::string image = save_image(model, {});
    // 12,000 gridpoints of at least 200 bytes; only the 24 bytes of the position do not repeat.
    EXPECT_LT(image.size(), 2'000'000u);
    Model restored;
    restore_image(restored, image, "x.sav");
    EXPECT_EQ(state_hash(restored), state_hash(model));
}

TEST(Save, AFullDiskLeavesTheSaveFileFromBefore) {
    const ScratchFolder folder;
    Model model = saved_model();
    save_state(model, folder / "a.sav", {});
    const std::string before = content_of(folder / "a.sav");
    model.clock.cycle += 1000;
    {
        const SmallDisk disk(before.size() / 2);
        const Diagnostic d = error_of([&] { save_state(model, folder / "a.sav", {}); });
        EXPECT_THAT(d.message, HasSubstr("cannot write"));
        EXPECT_EQ(d.fault, Fault::run);
    }
    EXPECT_EQ(content_of(folder / "a.sav"), before);
    EXPECT_EQ(folder.file_count(), 1u);
    Model restored;
    restore_state(restored, folder / "a.sav");
    EXPECT_EQ(restored.clock.cycle, 42);
}

TEST(Save, AMissingFolderIsSaid) {
    const ScratchFolder folder;
    Model model = saved_model();
    EXPECT_EQ(error_of([&] { save_state(model, folder / "no/a.sav", {}); }).hint, "make the folder first");
}

TEST(Restore, MissingFileFolderAndEmptyFile) {
    const ScratchFolder folder;
    Model model;
    EXPECT_THAT(error_of([&] { restore_state(model, folder / "none.sav"); }).message, HasSubstr("there is no file"));
    EXPECT_THAT(error_of([&] { restore_state(model, folder.path().string()); }).message, HasSubstr("is a folder"));
    put(folder / "empty.sav", "");
    EXPECT_EQ(error_of([&] { restore_state(model, folder / "empty.sav"); }).message,
              "'" + (folder / "empty.sav") + "' is empty");
}

TEST(Restore, ForeignFiles) {
    EXPECT_EQ(refused("poly brick 0 1 0 1 0 1\n").message, "'x.sav' is not a save file of kaya");
    EXPECT_EQ(refused(std::string(100000, '\0')).message, "'x.sav' is not a save file of kaya");
    TreeWriter foreign;
    foreign.open_group("VTKHDF");
    foreign.close_group();
    EXPECT_EQ(refused(foreign.image()).message, "'x.sav' is cut short, or another program wrote it");
    EXPECT_EQ(refused(with_trailer(foreign.image())).message, "'x.sav' cannot be restored: format_version is missing");
    EXPECT_EQ(refused(with_trailer("\x89HDF\r\n\x1a\n and no more")).message,
              "'x.sav' cannot be restored: it is not an HDF5 file");
    EXPECT_EQ(refused("x").fault, Fault::run);
}

TEST(Restore, ATruncatedFileOfAnyLengthIsRefused) {
    Model model = saved_model();
    const std::string image = save_image(model, some_extras());
    for (std::size_t length = 0; length < image.size(); length += length < 64 ? 1 : 997) {
        const std::string message = refused(image.substr(0, length)).message;
        EXPECT_THAT(message, testing::AnyOf("'x.sav' is empty", "'x.sav' is cut short, or another program wrote it"));
    }
    EXPECT_EQ(refused(image.substr(0, image.size() - 1)).message, "'x.sav' is cut short, or another program wrote it");
    EXPECT_EQ(refused(image + "x").message, "'x.sav' is cut short, or another program wrote it");
}

TEST(Restore, AnyChangedByteIsNoticed) {
    Model model = saved_model();
    const std::string image = save_image(model, {});
    for (std::size_t place = 0; place < image.size(); place += 499) {
        std::string changed = image;
        changed[place] = static_cast<char>(changed[place] ^ 0x10);
        EXPECT_NE(refused(changed).message, "nothing was thrown") << place;
    }
    std::string changed = image;
    changed[image.size() / 2] ^= 1;
    EXPECT_EQ(refused(changed).message, "'x.sav' is damaged: its bytes are not those that were written");
}

TEST(Restore, AFileOfAnotherFormatNamesBoth) {
    TreeWriter tree;
    const std::int32_t later = save_format_version + 1;
    tree.attribute("format_version", &later, 1);
    EXPECT_EQ(refused(with_trailer(tree.image())).message,
              fmt::format("'x.sav' cannot be restored: it has format {}, and this program reads formats 10 to {}",
                          later, save_format_version));
}

TEST(Restore, ModelsWhoseTablesDoNotFitTogetherAreRefused) {
    EXPECT_THAT(refused(image_of([](Model& m) { m.zones.gridpoints[0][0] = 1 << 30; })).message,
                HasSubstr("row 0 of zones: gridpoint 1073741824"));
    EXPECT_THAT(refused(image_of([](Model& m) { m.blocks.faces[0].count = -7; })).message, HasSubstr("face"));
    EXPECT_THAT(refused(image_of([](Model& m) { m.gridpoints.mass.resize(3); })).message,
                HasSubstr("column mass has other rows"));
    EXPECT_THAT(refused(image_of([](Model& m) { m.contacts.ids.free_slots()[0] = 4000000000u; })).message,
                HasSubstr("free id 4000000000 of contacts"));
    EXPECT_THAT(refused(image_of([](Model& m) { m.contacts.id.push_back({}); })).message, HasSubstr("other rows"));
    EXPECT_THAT(refused(image_of([](Model& m) { m.histories.time.push_back(1); })).message, HasSubstr("histories"));
    EXPECT_THAT(refused(image_of([](Model& m) {
                    m.clock.time_step = 1e-4;
                    m.stale.properties_computed();
                    m.blocks.material[0] = 7;
                })).message,
                HasSubstr("row 0 of blocks: there is no material 7"));
}

TEST(Restore, ADigestThatDoesNotFitTheContentIsNoticed) {
    // As if the saving program had walked over other names.
    Model model = saved_model();
    const std::string original = save_image(model, {});
    const auto hash = state_hash(model);
    std::string image(without_trailer(original, "x.sav"));
    const std::string bytes(reinterpret_cast<const char*>(&hash), sizeof hash);
    const auto place = image.find(bytes);
    ASSERT_NE(place, std::string::npos);
    image[place] = static_cast<char>(image[place] ^ 1);
    // tests/app/hostile_saves reads that hash, and writes it.
    EXPECT_THAT(refused(with_trailer(image)).message,
                HasSubstr(fmt::format("does not add up to the state hash in it: {:016x} is not", hash)));
}

namespace {

/// Writes the header of a save file and lets the test write the model.
std::string image_with(const std::function<void(TreeWriter&)>& write_model) {
    TreeWriter tree;
    const std::int32_t version = save_format_version;
    const std::uint64_t number = 0;
    tree.attribute("format_version", &version, 1);
    tree.attribute("state_hash", &number, 1);
    tree.text("program_version", "");
    tree.text("title", "");
    for (const auto* list : {"scripts", "decks"}) {
        tree.open_group(list);
        tree.attribute("count", &number, 1);
        tree.close_group();
    }
    tree.open_group("model");
    tree.open_group("blocks");
    write_model(tree);
    tree.close_group();
    tree.close_group();
    return with_trailer(tree.image());
}

} // namespace

TEST(Restore, TablesThatAreMissingOrOfAnotherTypeOrSize) {
    const std::uint64_t two = 2;
    const double real[4] = {};
    const std::uint32_t whole[6] = {};
    EXPECT_THAT(refused(image_with([](TreeWriter&) {})).message, HasSubstr("model/blocks/rows is missing"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) { t.attribute("rows", real, 1); })).message,
                HasSubstr("model/blocks/rows is of another type or size"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) { t.attribute("rows", &two, 1); })).message,
                HasSubstr("blocks has too few columns for its rows"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) {
                    t.attribute("rows", &two, 1);
                    t.data("id", real, 2, 2);
                })).message,
                HasSubstr("model/blocks/id is of another type"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) {
                    t.attribute("rows", &two, 1);
                    t.data("id", whole, 3, 2);
                })).message,
                HasSubstr("column id has other rows"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) {
                    t.attribute("rows", &two, 1);
                    t.data("id", whole, 2, 3);
                })).message,
                HasSubstr("model/blocks/id is of another size"));
}

TEST(Restore, NumbersOfRowsThatNoMemoryHoldsAreRefused) {
    const std::uint64_t many = 2'000'000'000, more = ~std::uint64_t{0};
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) { t.attribute("rows", &many, 1); })).message,
                HasSubstr("too few columns"));
    EXPECT_THAT(refused(image_with([&](TreeWriter& t) { t.attribute("rows", &more, 1); })).message,
                HasSubstr("too many rows"));
}
