// Modified save files with a corrected digest, so that the change reaches the reader: a file is either refused with a message or gives a
// complete model.
#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "io/save_trailer.hpp"
#include "model/whole/consistency.hpp"
#include "model/fields/sampling.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace kaya;
using namespace kaya::test;

namespace {

std::string image_without_trailer() {
    Model model = hand_made_model();
    add_history(model, {HistorySource::Kind::global, "time"});
    sample_histories(model, 1, {});
    SaveExtras extras;
    extras.decks = {{"a.3dd", "new\n"}};
    return std::string(without_trailer(save_image(model, extras), "x.sav"));
}

struct Outcome {
    int refused = 0, accepted = 0;
};

void restore_damaged(const std::string& image, Outcome& outcome) {
    Model model;
    try {
        restore_image(model, with_trailer(image), "x.sav");
        EXPECT_EQ(inconsistency(model), "");
        ++outcome.accepted;
    } catch (const Diagnostic& d) {
        EXPECT_EQ(d.fault, Fault::run);
        EXPECT_TRUE(model.blocks.empty());
        ++outcome.refused;
    }
}

} // namespace

TEST(DamagedFiles, SingleChangedBytes) {
    const std::string image = image_without_trailer();
    Outcome outcome;
    std::mt19937 random(7);
    for (std::size_t place = 0; place < image.size(); place += 1 + random() % 801) {
        std::string damaged = image;
        damaged[place] = static_cast<char>(random());
        restore_damaged(damaged, outcome);
    }
    // Changes in unused bytes of HDF5 have no effect; those in values and structure are detected.
    EXPECT_GT(outcome.refused, 20);
    EXPECT_GT(outcome.accepted, 0);
}

TEST(DamagedFiles, SmallNumbersWhereSizesAndLinksAre) {
    const std::string image = image_without_trailer();
    Outcome outcome;
    std::mt19937 random(8);
    const std::array<char, 4> telling{0, 1, '\x7f', '\xff'};
    for (int k = 0; k < 150; ++k) {
        std::string damaged = image;
        const std::size_t place = random() % (image.size() - 8);
        for (int j = 0; j < 8; ++j) damaged[place + static_cast<std::size_t>(j)] = telling[random() % telling.size()];
        restore_damaged(damaged, outcome);
    }
    EXPECT_GT(outcome.refused, 20);
}

TEST(DamagedFiles, TruncatedAnywhere) {
    const std::string image = image_without_trailer();
    Outcome outcome;
    for (std::size_t length = 8; length < image.size(); length += 4999)
        restore_damaged(image.substr(0, length), outcome);
    EXPECT_EQ(outcome.accepted, 0);
}

TEST(DamagedFiles, PiecesExchanged) {
    const std::string image = image_without_trailer();
    Outcome outcome;
    std::mt19937 random(9);
    for (int k = 0; k < 100; ++k) {
        std::string damaged = image;
        const std::size_t length = 1 + random() % 512;
        const std::size_t from = random() % (image.size() - length), to = random() % (image.size() - length);
        damaged.replace(to, length, image.substr(from, length));
        restore_damaged(damaged, outcome);
    }
    EXPECT_GT(outcome.refused, 20);
}
