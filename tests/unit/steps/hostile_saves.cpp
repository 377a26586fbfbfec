// Save files with modified numbers and valid digest and hash: from the file to the model to three cycles. Invalid files are refused with a
// message, without crashes and internal errors.
#include "hostile_model.hpp"

#include "commands/session/save_session.hpp"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

namespace kaya::test {
namespace {

// KAYA_HOSTILE_SAVES sets their number.
TEST(HostileSaves, AreRefusedOrRunButNeverCrash) {
    const char* given = std::getenv("KAYA_HOSTILE_SAVES");
    const int files = given ? std::atoi(given) : 150;
    const std::string file =
        (std::filesystem::temp_directory_path() / fmt::format("kaya-hostile-{}.h5", ::getpid())).string();
    Scene scene;
    scene.run(hostile_deck);
    const Model good = scene.session().engine.model;
    Mutation counting;
    {
        Model copy = good;
        visit_state(counting, copy);
    }
    ASSERT_GT(counting.count(), 200u);
    const char* seed = std::getenv("KAYA_FIRST_SEED");
    std::mt19937_64 random(seed ? std::strtoull(seed, nullptr, 10) : 11);
    int refused = 0, ran = 0;
    for (int k = 0; k < files; ++k) {
        Mutation mutation(random() % counting.count(), [&random] { return random(); });
        scene.session().engine.model = good;
        visit_state(mutation, scene.session().engine.model);
        SCOPED_TRACE(mutation.what());
        if (std::getenv("KAYA_HOSTILE_SHOW")) fmt::print(stderr, "{} {}\n", k, mutation.what());
        save_session(scene.session(), file);
        Scene other;
        try {
            other.run(fmt::format("restore {}\ncycle 3\nlist max\n", file));
            ++ran;
        } catch (const Diagnostic& problem) {
            EXPECT_NE(problem.fault, Fault::own) << render(problem);
            ++refused;
        }
        scene.session().engine.model = good;
    }
    std::filesystem::remove(file);
    EXPECT_GT(refused, files / 5);
    EXPECT_GT(ran, files / 5);
}

} // namespace
} // namespace kaya::test
