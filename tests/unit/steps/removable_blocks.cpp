// Random joint systems behind a face and above a roof, without friction: the blocks that leave their position when the model cycles are
// those of block theory.
#include "commands/session/session.hpp"
#include "commands/list/stability.hpp"

#include "base/diagnostic.hpp"
#include "model/edit/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace kaya {
namespace {

constexpr double size = 10,
                 moved = 0.03 * size; // length
constexpr double look = 0.25,         // time between checks
    longest_wait = 10;                // for a removable block; 20 degrees of plunge take half a second
constexpr double rest = 2.5;          // time without a departure

/// A cube of rock with three joint sets. A roof is open below; a face is open to +x and above.
std::string system(std::mt19937& random, bool roof) {
    std::uniform_real_distribution<double> part(0, 1);
    std::string deck = fmt::format(
        "poly brick 0 {0} 0 {0} 0 {0}\nprop mat 1 density 2500\nprop jmat 1 jkn 1e9 jks 1e9 jfric 0\n", size);
    for (int set = 0; set < 3; ++set)
        deck += fmt::format("jset dip {:.4f} dd {:.4f} spacing {:.4f} number 6 origin {:.4f} {:.4f} {:.4f}\n",
                            15 + 70 * part(random), 360 * part(random), 2.5 + 1.5 * part(random),
                            size * (0.3 + 0.4 * part(random)), size * (0.3 + 0.4 * part(random)),
                            size * (0.3 + 0.4 * part(random)));
    return deck + fmt::format("gravity 0 0 -10\ndamp local 0.3\njmodel model mohr\n; {}\n", roof ? "roof" : "face");
}

void hold_outside(Model& model, bool roof) {
    for (Row g = 0; g < static_cast<Row>(model.gridpoints.size()); ++g) {
        const Vec3& p = model.gridpoints.position[g];
        const double near = 1e-6 * size;
        const bool side = p.x() < near || p.y() < near || p.y() > size - near ||
                          (roof ? p.x() > size - near || p.z() > size - near : p.z() < near);
        if (side) model.blocks.fixed[model.gridpoints.block[g]] = fix_all;
    }
    ModelEdit(model, Change::contacts);
}

Options quiet() {
    Options options;
    options.threads = 1;
    options.quiet = true;
    options.joint_folders = {KAYA_TEST_JOINTS};
    return options;
}

struct Outcome {
    std::size_t free = 0, named = 0, gone = 0;
};

/// The removable blocks by theory.
std::set<std::int32_t> named_by_theory(Session& session, Outcome& outcome) {
    std::set<std::int32_t> named;
    for (const BodyStability& body : stability_of(session.engine.model, session.engine.joints)) {
        if (body.fixed) continue;
        ++outcome.free;
        if (body.answer.factor && *body.answer.factor < 1)
            named.insert(session.engine.model.blocks.number[body.blocks.front()]);
    }
    return named;
}

/// The blocks that leave their position. They are deleted, as in theory, which does not test whether the path is long enough for the blocks
/// behind them.
std::set<std::int32_t> gone_by_cycling(Session& session, const std::set<std::int32_t>& named) {
    Model& model = session.engine.model;
    std::set<std::int32_t> gone;
    for (double since = 0; since < (std::ranges::includes(gone, named) ? rest : longest_wait); since += look) {
        session.deck.interpreter.run_text(fmt::format("cycle time {}\n", look), "system");
        std::vector<Row> leave;
        for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b)
            if (model.blocks.displacement[b].norm() > moved) leave.push_back(b);
        if (leave.empty()) continue;
        since = -look;
        for (const Row b : leave) gone.insert(model.blocks.number[b]);
        delete_blocks(model, leave);
    }
    return gone;
}

/// Results of cycling, with rotation or with translation only.
struct Comparison {
    std::set<std::int32_t> named, gone;
    std::string text() const {
        return fmt::format("by theory leave {}, by cycling {}", fmt::join(named, " "), fmt::join(gone, " "));
    }
};

Comparison compare(unsigned seed, bool may_turn, Outcome& outcome) {
    std::mt19937 random(seed);
    const bool roof = seed % 2 == 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere(std::tmpfile(), &std::fclose);
    Session session(quiet(), nowhere.get(), nowhere.get());
    session.deck.interpreter.run_text(system(random, roof), "system");
    hold_outside(session.engine.model, roof);
    Comparison found;
    found.named = named_by_theory(session, outcome);
    if (!may_turn)
        for (auto& fixed : session.engine.model.blocks.fixed) fixed |= fix_rx | fix_ry | fix_rz;
    found.gone = gone_by_cycling(session, found.named);
    outcome.named += found.named.size(), outcome.gone += found.gone.size();
    return found;
}

TEST(RemovableBlocks, AreTheSameByBlockTheoryAndByCycling) {
    const char *given = std::getenv("KAYA_JOINT_SYSTEMS"), *start = std::getenv("KAYA_FIRST_SYSTEM");
    const unsigned count = given ? static_cast<unsigned>(std::atoi(given)) : 4,
                   first = start ? static_cast<unsigned>(std::atoi(start)) : 1;
    Outcome sum, again;
    unsigned equal = 0, turn_together = 0;
    for (unsigned seed = first; seed < first + count; ++seed) {
        const Comparison free = compare(seed, true, sum);
        if (free.named == free.gone) {
            ++equal;
            continue;
        }
        // Theory moves one block at a time, but blocks may lean on each other and rotate together. Blocks named by theory must leave in any
        // case; without rotation no other block leaves.
        EXPECT_TRUE(std::ranges::includes(free.gone, free.named)) << "system " << seed << ": " << free.text();
        const Comparison straight = compare(seed, false, again);
        EXPECT_EQ(straight.named, straight.gone) << "system " << seed << " without turning";
        equal += straight.named == straight.gone;
        ++turn_together;
        std::printf("system %u: %s; without turning %s\n", seed, free.text().c_str(), straight.text().c_str());
    }
    std::printf(
        "%u systems: %zu free blocks, %zu named, %zu left their place; the same set in %u, in %u of these without turning only\n",
        count, sum.free, sum.named, sum.gone, equal, turn_together);
    EXPECT_EQ(equal, count);
    EXPECT_LE(turn_together, 1 + count / 50);
    EXPECT_GT(sum.named, count) << "systems in which nothing moves test nothing";
    EXPECT_GT(sum.free, sum.named);
}

} // namespace
} // namespace kaya
