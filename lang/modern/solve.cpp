// model solve, model factor-of-safety.
#include "lang/modern/leaf.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace kaya::lang {

namespace {

/// The limits that a process word may stand before: `model solve dynamic time 10`.
void limits(Leaf<Solve>& leaf) {
    leaf.word("ratio|ratio-average", "ratio").word("ratio-local", "ratio-local").word("ratio-maximum", "ratio-maximum");
    leaf.word("unbalanced-maximum", "force").word("cycles", "cycles").word("time", "time").word("clock", "clock");
    leaf.word("elastic", "elastic").word("only", "only").word("calm", "calm");
    leaf.word("and", "and").word("or", "or").word("cycles-total", "cycles-total").word("time-total", "time-total");
    leaf.no_effect("dynamic|mechanical", "the limits that follow are those of motion, the only process");
    // The target of every gridpoint is the one that 3DEC has unless a deck changes it.
    constexpr double target = 1e-4;
    const auto multiple = real("c").above(0);
    leaf.keyword(
        {"convergence"}, multiple,
        [](Solve& solve, double value) {
            solve.local_ratio = std::max(value * target, std::numeric_limits<double>::denorm_min());
        },
        "local ratio as a multiple of 1e-4");
    leaf.not_yet({"cycles-super", "time-total-zone", "unbalanced-average"}, "other limits: see cycles and time");
    leaf.not_yet({"fish-halt", "fish-call"}, "functions of FISH that end a run");
    leaf.not_yet({"thermal", "fluid", "creep"}, "heat, flow and creep");
}

CommandSpec model_solve() {
    Leaf<Solve> leaf("model solve", "solve");
    limits(leaf);
    leaf.checks_of_meaning();
    leaf.wrong("model solve ratio 1e-5 or", "a limit is missing after 'or'");
    leaf.right("model solve", "solve").right("model solve ratio 1e-4 cycles 50", "solve ratio 1e-4 cycles 50");
    leaf.right("model solve ratio-local 1e-3 or time 2", "solve ratio-local 1e-3 time 2");
    leaf.right("model solve unb-max 10 cycles 20", "solve force 10 cycles 20");
    leaf.right("model solve dynamic time 0.01", "solve time 0.01");
    leaf.right("model solve convergence 1 or cycles 20", "solve ratio-local 1e-4 cycles 20");
    leaf.wrong("model solve convergence 0", "convergence must be greater than 0, not 0");
    leaf.right("model solve elastic only ratio 1e-3 cycles 20", "solve elastic only ratio 1e-3 cycles 20");
    leaf.right("model solve cycles 20 calm 5", "solve cycles 20 calm 5");
    leaf.wrong("model solve raito 1e-5", "'raito' is not a keyword of model solve");
    leaf.wrong("model solve ratio", "a number is missing after 'ratio'");
    leaf.wrong("model solve ratio 0", "ratio must be greater than 0, not 0");
    leaf.wrong("model solve 100", "expected a keyword of model solve, found '100'");
    leaf.right("model solve ratio-local 1e-3 and cycles 20", "solve ratio-local 1e-3 and cycles 20");
    leaf.right("model solve cycles-total 20 or time-total 0.5", "solve cycles-total 20 or time-total 0.5");
    leaf.wrong("model solve fluid time 1", "'model solve fluid' is known, but kaya does not support it yet");
    return leaf;
}

/// `exclude` or `include`, and the name of a strength.
Parts<Solve> strengths(std::array<Solve::Reduced, 3> excluded) {
    const auto named = [](auto effect) {
        std::vector<Parts<Solve>::Choice> choices;
        for (std::size_t i = 0; i < 3; ++i)
            choices.push_back({std::array{"friction", "cohesion", "tension"}[i], Parts<Solve>().set(effect(i))});
        return Parts<Solve>().one_of(text("friction|cohesion|tension").spec, "a strength that fos reduces",
                                     std::move(choices));
    };
    const auto drop = [excluded](std::size_t i) {
        return [word = excluded[i]](Solve& s) { s.excluded.push_back(word); };
    };
    const auto nothing = [](std::size_t) { return [](Solve&) {}; };
    return Parts<Solve>().one_of(text("exclude|include").spec, "include or exclude",
                                 {{"exclude", named(drop)}, {"include", named(nothing)}});
}

CommandSpec factor_of_safety() {
    Leaf<Solve> leaf("model factor-of-safety", "solve");
    leaf.means("solve fos").help("computes the factor of safety by strength reduction; the model is left unchanged");
    leaf.start([](const Statement& statement, Solve& solve) {
        solve.place = statement.words.front().place;
        solve.factor_of_safety = true;
    });
    leaf.word("bracket", "bracket").word("resolution", "resolution").word("filename", "file");
    leaf.word("ratio", "ratio").word("ratio-average", "ratio").word("ratio-local", "ratio-local");
    leaf.word("ratio-maximum", "ratio-maximum").word("step-limit", "cycles").word("associated", "associated");
    using enum Solve::Reduced;
    leaf.keyword({"zone", "block-zone", "3dec-zone"}, strengths({zone_friction, zone_cohesion, zone_tension}),
                 "a strength of zones that is not divided; those that are included are divided in any case");
    leaf.keyword({"joint"}, strengths({joint_friction, joint_cohesion, joint_tension}),
                 "a strength of joints that is not divided; those that are included are divided in any case");
    leaf.not_yet({"include", "exclude", "zone-joint", "interface"},
                 "a choice of strengths: write zone exclude cohesion, or joint exclude cohesion");
    leaf.not_yet({"bracket-limit", "characteristic-steps", "convergence", "perturbation", "list"},
                 "details of the search");
    leaf.checks_of_meaning();
    leaf.right("model factor-of-safety", "solve fos");
    leaf.right("model factor-of-safety resolution 0.01 ratio 1e-4 step-limit 2000",
               "solve fos resolution 0.01 ratio 1e-4 cycles 2000");
    leaf.right("model factor-of-safety associated ratio-local 1e-3 step-limit 2000",
               "solve fos associated ratio-local 1e-3 cycles 2000");
    leaf.right("model factor-of-safety zone exclude tension joint exclude tension joint include friction",
               "solve fos exclude zone-tension exclude joint-tension");
    leaf.wrong("model factor-of-safety zone exclude dilation", "'dilation' is not a strength that fos reduces");
    leaf.wrong("model factor-of-safety bracket 2 1", "the stable factor must be below the failing one");
    return leaf;
}

} // namespace

Family model_family() {
    Family family{"model", "the model as a whole", model_commands()};
    family.commands.push_back(model_solve());
    family.commands.push_back(factor_of_safety());
    for (CommandSpec& command : model_history_commands()) family.commands.push_back(std::move(command));
    return family;
}

} // namespace kaya::lang
