// Random decks from a seed: the time step never exceeds the bound, and a run that is saved and restored at any cycle continues with the
// same bits.
#include "commands/session/save_session.hpp"
#include "commands/session/session.hpp"

#include "base/diagnostic.hpp"
#include "mechanics/step/step_bounds.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/chance.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace kaya {
namespace {

using test::Chance;

/// Lines that are run in order, with cycles between them.
struct Part {
    std::string line;
    int cycles = 0;
};

std::string brick(Chance& c, double low) {
    const double x = c.between(-1, 1), y = c.between(-1, 1), z = c.between(low, low + 1);
    return fmt::format("poly brick {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}", x, x + c.scale(0.03, 2), y,
                       y + c.scale(0.03, 2), z, z + c.scale(0.03, 1));
}

std::string joint_law(Chance& c) {
    const double kn = c.scale(1e6, 1e10), ks = c.scale(1e6, 1e10);
    switch (c.below(5)) {
    case 0: return fmt::format("jmodel model elastic jkn {:.4g} jks {:.4g}", kn, ks);
    case 1:
        return fmt::format(
            "jmodel model barton-bandis jkn {:.4g} jks {:.4g} resfriction 20 jrco 8 jcso 100 sigmac 150 lo 0.1 ln 0.2",
            kn, ks);
    case 2:
        return fmt::format("jmodel model nonlinear jkn {:.4g} jks {:.4g} jen {:.2g} jes 0.3 fric 30", c.scale(1e5, 1e8),
                           c.scale(1e5, 1e8), c.between(0.1, 0.9));
    default:
        return fmt::format("jmodel model mohr jkn {:.4g} jks {:.4g} jfric {:.3g} jcoh {:.3g}", kn, ks, c.between(0, 50),
                           c.heads() ? 0 : 1e4);
    }
}

std::string change(Chance& c) {
    switch (c.below(6)) {
    case 0: return brick(c, 0.5);
    case 1: return fmt::format("damp contact {:.2g}", c.heads() ? 0 : c.between(0.01, 0.5));
    case 2:
        return fmt::format("jset dip {:.3g} dd {:.3g} spacing {:.3g} num 2 org 0 0 0.5{}", c.between(0, 90),
                           c.between(0, 360), c.between(0.2, 1), c.heads() ? " join" : "");
    case 3: return c.heads() ? "damp local" : "damp 0.05 20";
    case 4: return fmt::format("apply zload {:.4g} range id 2", -c.scale(1e2, 1e6));
    default: return joint_law(c);
    }
}

std::vector<Part> random_deck(std::uint64_t seed) {
    Chance c(seed);
    std::vector<Part> parts;
    const auto add = [&](const std::string& line, int cycles = 0) { parts.push_back({line, cycles}); };
    add(fmt::format("prop mat 1 dens {:.4g} bulk {:.4g} shear {:.4g}", c.scale(100, 5000), c.scale(1e7, 1e10),
                    c.scale(1e7, 1e10)));
    add(fmt::format("prop jmat 1 jkn {:.4g} jks {:.4g} jfric 30", c.scale(1e6, 1e10), c.scale(1e6, 1e10)));
    add("poly brick -3 3 -3 3 -1 0");
    add("fix range id 1");
    add("gravity 0 0 -9.81");
    const int bricks = 1 + c.below(5);
    for (int i = 0; i < bricks; ++i) add(brick(c, i == 0 ? 0 : 0.3 * i));
    if (c.heads(0.3)) add(fmt::format("gen edge {:.3g} range id 2", c.between(0.3, 1)));
    add(joint_law(c));
    if (c.heads(0.4)) add(fmt::format("damp contact {:.2g}", c.between(0.01, 0.5)));
    if (c.heads(0.3)) add("damp none");
    add("", 5 + c.below(30));
    for (int i = 0; i < 3; ++i) add(change(c), 5 + c.below(40));
    return parts;
}

class Run {
public:
    explicit Run(int threads = 1) : results_(std::tmpfile()), messages_(std::tmpfile()) {
        Options options;
        options.threads = threads;
        options.joint_folders = {KAYA_TEST_JOINTS};
        session_ = std::make_unique<Session>(options, results_, messages_);
    }
    ~Run() {
        session_.reset();
        std::fclose(results_);
        std::fclose(messages_);
    }
    /// False if the command is refused, as some random commands are.
    bool run(const std::string& line) {
        try {
            session_->deck.interpreter.run_text(line, "random.3dd");
        } catch (const Diagnostic&) { return false; }
        return true;
    }
    Session& session() { return *session_; }
    /// Of the model, and of scripts and ranges.
    std::pair<std::uint64_t, std::uint64_t> hashes() {
        return {state_hash(session_->engine.model), script_hash(*session_)};
    }

private:
    std::FILE* results_;
    std::FILE* messages_;
    std::unique_ptr<Session> session_;
};

/// The hashes after `cycles` more cycles of a run and of the same run restored from a file.
void expect_same_when_restored(Run& run, int cycles, const std::string& where) {
    const test::ScratchFolder folder;
    const auto file = folder / "save.h5";
    ASSERT_TRUE(run.run("save " + file)) << where;
    Run other;
    ASSERT_TRUE(other.run("restore " + file)) << where;
    for (int i = 0; i < cycles; ++i) {
        const bool went = run.run("cycle 1");
        EXPECT_EQ(other.run("cycle 1"), went) << where;
        if (!went) return;
        ASSERT_EQ(state_hash(run.session().engine.model), state_hash(other.session().engine.model))
            << where << ", " << i + 1 << " cycles after it was restored";
    }
}

/// By the bound of all bodies in their present state.
double largest_stable_step(const Model& model) {
    const Adjacency adjacency = make_adjacency(model);
    StepBounds bounds;
    bounds.update(model, adjacency);
    return bounds.limit(model, adjacency).stable;
}

/// Returns the number of checked cycles.
int check(std::uint64_t seed) {
    Run run;
    Chance c(seed + 1000000);
    int looked_at = 0, part_number = 0;
    for (const Part& part : random_deck(seed)) {
        const auto before = run.hashes();
        if (!part.line.empty() && !run.run(part.line)) {
            EXPECT_EQ(run.hashes(), before) << "seed " << seed << ": refused, and not without a trace: " << part.line;
        }
        for (int i = 0; i < part.cycles; ++i) {
            if (!run.run("cycle 1")) return looked_at; // no model to run, or a failing law
            ++looked_at;
            const double step = run.session().engine.model.clock.time_step,
                         stable = largest_stable_step(run.session().engine.model);
            EXPECT_LE(step, stable) << "seed " << seed << ", cycle " << run.session().engine.model.clock.cycle;
            if (step > stable) return looked_at;
        }
        if (part.cycles > 0 && c.heads(0.7)) expect_same_when_restored(run, 3, fmt::format("{}-{}", seed, part_number));
        ++part_number;
        if (testing::Test::HasFailure()) return looked_at;
    }
    return looked_at;
}

/// Runs the deck with density scaling, and restores it directly after cycles in which masses have changed: data noted of a contact before
/// must not be used. Returns the number of times.
int restore_after_changes_of_mass(std::uint64_t seed) {
    constexpr int most = 4; // of a deck
    Run run;
    int restored = 0;
    run.run("mscale on");
    for (const Part& part : random_deck(seed)) {
        if (!part.line.empty()) run.run(part.line);
        for (int i = 0; i < part.cycles && restored < most; ++i) {
            const auto before = run.session().engine.model.blocks.inertial_mass;
            if (!run.run("cycle 1")) return restored;
            if (i == 0 || run.session().engine.model.blocks.inertial_mass == before) continue;
            expect_same_when_restored(run, 3,
                                      fmt::format("{} scaled, cycle {}", seed, run.session().engine.model.clock.cycle));
            if (testing::Test::HasFailure()) return restored;
            ++restored;
        }
    }
    return restored;
}

/// The whole deck again with the given number of threads.
std::uint64_t final_hash(std::uint64_t seed, int threads) {
    Run run(threads);
    for (const Part& part : random_deck(seed)) {
        if (!part.line.empty()) run.run(part.line);
        for (int i = 0; i < part.cycles; ++i)
            if (!run.run("cycle 1")) break;
    }
    return state_hash(run.session().engine.model);
}

int number_from(const char* variable, int otherwise) {
    const char* given = std::getenv(variable);
    return given ? std::atoi(given) : otherwise;
}

// KAYA_RANDOM_DECKS sets their number, KAYA_FIRST_SEED the first seed; the slow test runs more.
TEST(RandomDecks, TheStepStaysBelowTheBoundAndARestoredRunGoesOnWithTheSameBits) {
    const int decks = number_from("KAYA_RANDOM_DECKS", 40), first = number_from("KAYA_FIRST_SEED", 1);
    int looked_at = 0;
    for (int seed = first; seed < first + decks; ++seed) {
        looked_at += check(static_cast<std::uint64_t>(seed));
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
    EXPECT_GT(looked_at, 30 * decks); // most decks run to their end
}

TEST(RandomDecks, ARunThatIsRestoredWhenMassesHaveChangedGoesOnWithTheSameBits) {
    const int decks = number_from("KAYA_RANDOM_DECKS", 40), first = number_from("KAYA_FIRST_SEED", 1);
    int restored = 0;
    for (int seed = first; seed < first + decks; ++seed) {
        restored += restore_after_changes_of_mass(static_cast<std::uint64_t>(seed));
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
    EXPECT_GE(restored, decks / 4); // masses change
}

TEST(RandomDecks, OneTwoAndFourThreadsGiveTheSameBits) {
    const int decks = number_from("KAYA_RANDOM_DECKS", 20), first = number_from("KAYA_FIRST_SEED", 1);
    for (int seed = first; seed < first + decks; ++seed) {
        const auto number = static_cast<std::uint64_t>(seed);
        const auto one = final_hash(number, 1);
        ASSERT_EQ(final_hash(number, 2), one) << "seed " << seed;
        ASSERT_EQ(final_hash(number, 4), one) << "seed " << seed;
    }
}

TEST(ScriptHash, SeesWhatScriptsAndRangesHold) {
    kaya::Run run;
    EXPECT_EQ(script_hash(run.session()), 0u);
    std::set<std::uint64_t> seen{0};
    for (const char* line : {"set @a = 1", "set @a = 2", "range name low z 0 1", "range name low z 0 2",
                             "table 1 0 0 1 1", "def f\n a = 1\nend", "lua\nb = 3\nendlua"}) {
        const auto of_model = state_hash(run.session().engine.model);
        ASSERT_TRUE(run.run(line)) << line;
        EXPECT_TRUE(seen.insert(script_hash(run.session())).second) << line;
        EXPECT_EQ(state_hash(run.session().engine.model), of_model) << line;
    }
}

} // namespace
} // namespace kaya
