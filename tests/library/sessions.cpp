// Models of libkaya: many at once, mistakes, spans, interruption.
#include "kaya/kaya.h"

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

namespace {

class Model {
public:
    explicit Model(kaya_writer output = nullptr, void* user = nullptr) {
        kaya_options options{};
        options.interface = KAYA_LIBRARY_INTERFACE;
        options.output = output;
        options.user = user;
        EXPECT_EQ(kaya_open(&options, &model_), KAYA_DONE);
    }
    ~Model() { kaya_close(model_); }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
    operator kaya_model*() const { return model_; }

    kaya_status run(const std::string& commands) { return kaya_run(model_, commands.c_str(), "test"); }

private:
    kaya_model* model_ = nullptr;
};

/// A pile of blocks on a slope with joints; each number is another pile.
std::string pile(int number) {
    const std::string angle = std::to_string(20 + 3 * number), friction = std::to_string(25 + 2 * number);
    return "poly brick 0 4 0 2 0 3\njset dip " + angle + " dd 90 spacing 0.7 num 9 origin 0 0 1\n" +
           "prop mat 1 dens 2500\njmodel model mohr\nprop jmat 1 jkn 1e9 jks 5e8 jfric " + friction +
           "\ngravity 0 0 -9.81\nfix range z 0 0.4\nset @start 0\ndef note\n  start = start + 1\nend\ncycle 150\n@note\n" +
           (number % 2 == 0 ? "set small on\n" : "") + "cycle 150\n";
}

std::uint64_t hash_of(int number) {
    Model model;
    EXPECT_EQ(model.run(pile(number)), KAYA_DONE) << kaya_error_at(model, 0).text;
    return kaya_hash(model);
}

} // namespace

TEST(Library, EightSessionsInFourThreadsHaveTheBitsOfOneAlone) {
    std::array<std::uint64_t, 8> alone{}, together{};
    for (int k = 0; k < 8; ++k) alone[static_cast<std::size_t>(k)] = hash_of(k);
    for (int k = 1; k < 8; ++k) EXPECT_NE(alone[static_cast<std::size_t>(k)], alone[0]);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([t, &together] {
            // Both models of a thread are alive at once and run in turn.
            Model first, second;
            const std::string of_first = pile(2 * t), of_second = pile(2 * t + 1);
            EXPECT_EQ(first.run(of_first), KAYA_DONE) << kaya_error_at(first, 0).text;
            EXPECT_EQ(second.run(of_second), KAYA_DONE) << kaya_error_at(second, 0).text;
            together[static_cast<std::size_t>(2 * t)] = kaya_hash(first);
            together[static_cast<std::size_t>(2 * t + 1)] = kaya_hash(second);
        });
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(together, alone);
}

TEST(Library, ModelsAreSavedInSeveralThreads) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "kaya-library-saves";
    std::filesystem::create_directory(folder);
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([t] {
            Model model, again;
            const std::string name = "save" + std::to_string(t);
            EXPECT_EQ(model.run(pile(t)), KAYA_DONE) << kaya_error_at(model, 0).text;
            for (int k = 0; k < 5; ++k) {
                EXPECT_EQ(model.run("save " + name), KAYA_DONE) << kaya_error_at(model, 0).text;
                EXPECT_EQ(again.run("restore " + name), KAYA_DONE) << kaya_error_at(again, 0).text;
                EXPECT_EQ(kaya_hash(again), kaya_hash(model));
                EXPECT_EQ(model.run("cycle 10"), KAYA_DONE);
            }
        });
    for (auto& thread : threads) thread.join();
    std::filesystem::current_path(before);
    std::filesystem::remove_all(folder);
}

TEST(Library, ALongMeshIsInterrupted) {
    Model model;
    ASSERT_EQ(model.run("poly brick 0 1 0 1 0 1"), KAYA_DONE);
    std::atomic<bool> done = false;
    std::thread other([&] {
        // Until it is heard: a request before the command begins is for the command before.
        while (!done) {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            kaya_interrupt(model);
        }
    });
    EXPECT_EQ(model.run("gen edge 0.012"), KAYA_FAILED); // some million zones
    done = true;
    other.join();
    kaya_span span;
    ASSERT_EQ(kaya_field(model, "zone", "volume", &span), KAYA_DONE);
    EXPECT_EQ(span.rows, 0u);
}

TEST(Library, CommandsInsideACycleAreRefused) {
    Model model;
    ASSERT_EQ(model.run(pile(1)), KAYA_DONE);
    kaya_status inside = KAYA_DONE;
    ASSERT_EQ(kaya_after_cycles(
                  model, 1,
                  [](void* user, kaya_model* of) { *static_cast<kaya_status*>(user) = kaya_run(of, "cycle 1", "x"); },
                  &inside),
              KAYA_DONE);
    EXPECT_EQ(model.run("cycle 2"), KAYA_DONE);
    EXPECT_EQ(inside, KAYA_WRONG);
}

TEST(Library, NothingIsNoModel) {
    kaya_span span;
    EXPECT_EQ(kaya_run(nullptr, "cycle 1", "x"), KAYA_WRONG);
    EXPECT_EQ(kaya_field(nullptr, "block", "volume", &span), KAYA_WRONG);
    EXPECT_EQ(kaya_error_count(nullptr), 0u);
    kaya_interrupt(nullptr);
    Model model;
    EXPECT_EQ(kaya_run(model, nullptr, nullptr), KAYA_WRONG);
    EXPECT_EQ(kaya_field(model, nullptr, "volume", &span), KAYA_WRONG);
    EXPECT_EQ(kaya_error_count(model), 1u);
}

TEST(Library, MistakesHaveTheirPlace) {
    Model model;
    const std::string deck = testing::TempDir() + "library-mistakes.3dd";
    std::ofstream(deck) << "poly brick 0 1 0 1 0 1\npoly brik 0 1 0 1 0 1\npropp mat 1 dens 1\n";
    EXPECT_EQ(kaya_run_file(model, deck.c_str()), KAYA_WRONG);
    std::filesystem::remove(deck);
    ASSERT_EQ(kaya_error_count(model), 2u);
    const kaya_error first = kaya_error_at(model, 0);
    EXPECT_EQ(first.status, KAYA_WRONG);
    EXPECT_EQ(first.line, 2);
    EXPECT_EQ(first.column, 6);
    EXPECT_EQ(first.file, deck);
    EXPECT_NE(std::string(first.hint).find("brick"), std::string::npos);
    EXPECT_EQ(kaya_error_at(model, 1).line, 3);
    EXPECT_STREQ(kaya_error_at(model, 7).message, "");
    EXPECT_EQ(model.run("cycle 0\n  gravity 0 0"), KAYA_WRONG);
    EXPECT_STREQ(kaya_error_at(model, 0).file, "test");
    EXPECT_EQ(kaya_error_at(model, 0).line, 2);
    EXPECT_EQ(model.run("poly brick 0 1 0 1 0 1"), KAYA_DONE);
    EXPECT_EQ(kaya_error_count(model), 0u);
}

TEST(Library, FieldsAreSpans) {
    Model model;
    ASSERT_EQ(model.run("poly brick 0 1 0 1 0 2\npoly brick 1 2 0 1 0 1"), KAYA_DONE);
    kaya_span span;
    ASSERT_EQ(kaya_field(model, "block", "volume", &span), KAYA_DONE);
    ASSERT_EQ(span.rows, 2u);
    EXPECT_EQ(span.each, 1u);
    EXPECT_EQ(span.type, KAYA_FLOAT64);
    EXPECT_EQ(static_cast<const double*>(span.values)[0], 2);
    ASSERT_EQ(kaya_field(model, "blocks", "velocity", &span), KAYA_DONE);
    EXPECT_EQ(span.each, 3u);
    const double velocity[] = {1, 2, 3};
    ASSERT_EQ(kaya_set_field(model, "block", "velocity", 1, velocity, 3), KAYA_DONE) << kaya_error_at(model, 0).text;
    ASSERT_EQ(kaya_field(model, "block", "velocity", &span), KAYA_DONE);
    EXPECT_EQ(static_cast<const double*>(span.values)[4], 2);
    ASSERT_EQ(kaya_field(model, "contact", "normal", &span), KAYA_DONE); // contacts are found for it
    EXPECT_EQ(span.rows, 1u);
    ASSERT_EQ(kaya_field(model, "block", "id", &span), KAYA_DONE);
    EXPECT_EQ(span.type, KAYA_INT64);
    EXPECT_EQ(kaya_field(model, "block", "volumn", &span), KAYA_WRONG);
    EXPECT_EQ(kaya_field(model, "stone", "volume", &span), KAYA_WRONG);
    EXPECT_EQ(kaya_set_field(model, "block", "velocity", 2, velocity, 3), KAYA_WRONG);
    EXPECT_EQ(kaya_set_field(model, "block", "velocity", 1, velocity, 2), KAYA_WRONG);
    EXPECT_EQ(kaya_set_field(model, "block", "volume", 1, velocity, 1), KAYA_WRONG);
}

TEST(Library, OutputGoesToTheCaller) {
    std::string heard;
    Model model(
        [](void* user, const char* text, std::size_t size) { static_cast<std::string*>(user)->append(text, size); },
        &heard);
    ASSERT_EQ(model.run("poly brick 0 1 0 1 0 1\nlist blocks"), KAYA_DONE);
    EXPECT_NE(heard.find("1"), std::string::npos);
}

TEST(Library, AFunctionIsCalledAfterCyclesAndAnotherThreadInterrupts) {
    Model model;
    ASSERT_EQ(model.run(pile(1)), KAYA_DONE);
    struct Seen {
        std::atomic<int> calls = 0;
    } seen;
    ASSERT_EQ(kaya_after_cycles(
                  model, 10, [](void* user, kaya_model*) { ++static_cast<Seen*>(user)->calls; }, &seen),
              KAYA_DONE);
    ASSERT_EQ(model.run("cycle 100"), KAYA_DONE);
    EXPECT_EQ(seen.calls, 10);
    std::thread other([&] {
        while (seen.calls < 20) std::this_thread::yield();
        kaya_interrupt(model);
    });
    EXPECT_EQ(model.run("cycle 100000000"), KAYA_FAILED);
    other.join();
    EXPECT_EQ(model.run("cycle 10"), KAYA_DONE);
    EXPECT_EQ(kaya_after_cycles(
                  model, 0, [](void*, kaya_model*) {}, nullptr),
              KAYA_WRONG);
}

TEST(Library, RefusesAnotherInterface) {
    kaya_options options{};
    kaya_model* model = nullptr;
    EXPECT_EQ(kaya_open(&options, &model), KAYA_WRONG);
    EXPECT_EQ(kaya_open(nullptr, &model), KAYA_WRONG);
    EXPECT_EQ(model, nullptr);
    kaya_close(nullptr);
    EXPECT_NE(std::string(kaya_version()), "");
}
