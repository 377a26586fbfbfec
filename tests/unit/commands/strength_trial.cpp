// Trials of solve fos: what they answer depends on start, factor and rule alone.
#include "running.hpp"

#include "commands/stability/model_on_trial.hpp"
#include "commands/stability/strength_trial.hpp"
#include "model/whole/state_hash.hpp"

#include <cmath>
#include <numbers>

namespace kaya {
namespace {

constexpr TrialRule quick{.window = 2.0 / 3, .ends_with_bolts = true, .settles_between = false};
constexpr TrialRule from_start{.window = 5, .ends_with_bolts = false, .settles_between = true};

std::uint64_t hash_of(Model model) { return state_hash(model); }

/// A block on a plane that dips by 30 degrees; gravity is turned. The factor of safety is tan phi / tan 30.
class StrengthTrials : public Running {
protected:
    StrengthTrials() {
        session().engine.joints.set_path({KAYA_TEST_JOINTS});
        run("prop mat 1 density 2500\npoly brick -15 25 0 10 -5 0\nfix range z -5 -1\npoly brick 0 10 0 10 0 5\n"
            "prop jmat 1 jkn 1e10 jks 1e10 jfric 40\ndamp local 0.8\nmscale on\ngravity 4.905 0 -8.4957");
        session().engine.cycle->prepare();
        before_ = state_hash(model());
    }

    /// Calls use(bench), and then gives the model back.
    template <class Use> void with_bench(Use use) {
        const lang::Solve command;
        const Asked asked(command);
        check_for_trials(session(), asked, {});
        Progress progress(session().program.output, model(), {});
        ModelOnTrial on_trial(session(), asked);
        const std::int64_t span = characteristic_span(session(), progress, {1e-5}, {});
        use(TrialBench{session(), asked, on_trial.initial(), {1e-5}, span, progress});
    }

    std::uint64_t before_ = 0;
    const double exact_ = std::tan(40 * std::numbers::pi / 180) / std::tan(30 * std::numbers::pi / 180);
};

TEST_F(StrengthTrials, AnswerByTheFactor) {
    with_bench([&](const TrialBench& bench) {
        for (const TrialRule& rule : {quick, from_start}) {
            EXPECT_TRUE(run_trial(bench, bench.initial, 0.99 * exact_, rule).stands);
            EXPECT_FALSE(run_trial(bench, bench.initial, 1.01 * exact_, rule).stands);
        }
    });
}

TEST_F(StrengthTrials, DoNotDependOnThoseBefore) {
    with_bench([&](const TrialBench& bench) {
        const auto end = [&](const ReducedModel& start, double factor) {
            return hash_of(run_trial(bench, start, factor, quick).end.model);
        };
        const Trial stable = run_trial(bench, bench.initial, 1.2, quick);
        const auto failed = end(bench.initial, 2), further = end(stable.end, 1.3);
        EXPECT_EQ(end(bench.initial, 1.2), hash_of(stable.end.model));
        EXPECT_EQ(end(stable.end, 1.3), further);
        EXPECT_EQ(end(bench.initial, 2), failed);
        EXPECT_EQ(stable.end.factor, 1.2);
    });
}

TEST_F(StrengthTrials, BeginInMotionWithoutLosingTheAnswer) {
    with_bench([&](const TrialBench& bench) {
        const Trial failed = run_trial(bench, bench.initial, 1.6, quick);
        ASSERT_FALSE(failed.stands);
        ASSERT_TRUE(failed.mode);
        EXPECT_FALSE(failed.mode->topples());
        const auto sliding = slide_on(bench, failed.end);
        ASSERT_TRUE(sliding);
        ASSERT_TRUE(sliding->slipping);
        EXPECT_GT(sliding->factor, failed.end.factor);
        EXPECT_TRUE(run_trial(bench, *sliding, 0.99 * exact_, from_start).stands);
        EXPECT_FALSE(run_trial(bench, *sliding, 1.01 * exact_, from_start).stands);
    });
}

TEST_F(StrengthTrials, LeaveTheModelAsItWas) {
    with_bench([&](const TrialBench& bench) { run_trial(bench, bench.initial, 2, quick); });
    EXPECT_EQ(state_hash(model()), before_);
}

TEST_F(StrengthTrials, AreRefusedWithoutDamping) {
    const Asked asked{lang::Solve{}};
    model().settings.damping = Damping::none;
    EXPECT_THROW(check_for_trials(session(), asked, {}), Diagnostic);
}

} // namespace
} // namespace kaya
