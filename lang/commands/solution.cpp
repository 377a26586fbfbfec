// Commands that move the model in time.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/solve_control.hpp"

namespace kaya::lang {

namespace {

CommandSpec damp() {
    Entry<Damp> entry({"damp", "damping"});
    entry.help("how motion is damped");
    using enum Damp::Kind;
    // The last kind of a line counts.
    const auto begin = [](Damp::Kind kind) {
        return [kind](Damp& d) {
            d.kind = kind;
            d.value.reset();
            d.fraction = d.frequency = 0;
        };
    };
    const auto of_kind = [begin](Damp::Kind kind, const Argument<double>& value) {
        return Parts<Damp>().set(begin(kind)).maybe(value, &Damp::value);
    };
    for (const char* word : {"auto", "global"})
        entry.keyword({word}, of_kind(global, real("ratio").above(0).below(1).optional()),
                      "viscous damping that follows the kinetic energy: how strong, as the ratio in 3DEC; 0.5 if not "
                      "given");
    const auto factor = real("factor").at_least(0).at_most(1).optional();
    entry.keyword({"local"}, of_kind(local, factor),
                  "a force against the motion, a part of the unbalanced force; 0.8 if not given");
    entry.keyword({"combined"}, of_kind(combined, factor),
                  "local damping for motion that is mostly one way; 0.8 if not given");
    entry.action({"none", "off"}, begin(none), "no damping and no dashpots of contacts");
    entry.action(
        {"mass"}, [](Damp& d) { d.stiffness = false; }, "of Rayleigh damping: only the mass part");
    entry.action(
        {"stiffness"}, [](Damp& d) { d.mass = false; }, "of Rayleigh damping: only the stiffness part");
    entry.keyword(
        {"contact"}, real("fraction").at_least(0).below(1), &Damp::contact,
        "a dashpot at every contact, with that fraction of critical damping, in addition to the other damping of the line; alone it is the only damping, and 0 removes the dashpots");
    const auto numbers = Parts<Damp>()
                             .set(begin(rayleigh))
                             .then(real("fraction").at_least(0), &Damp::fraction)
                             .then(real("frequency").unit("1/time").at_least(0), &Damp::frequency);
    entry.keyword({"rayleigh"}, numbers, "the same as fraction and frequency alone");
    entry.values(numbers, [](Reader& reader, Damp& d) { return reader.at_number() && !d.kind; });
    entry.finish([](const Reader& reader, Damp& d) {
        if (!d.kind && !d.contact)
            incomplete_line(reader, "damp does not say how to damp",
                            "expected: auto, local, global, combined, contact, none, or fraction and frequency");
        if (d.fraction > 0 && d.frequency == 0 && !reader.wildcards())
            incomplete_line(reader, "a part of critical damping needs a frequency above 0",
                            "write for example: damp 0.05 1.5");
        if (!d.mass && !d.stiffness)
            incomplete_line(reader, "mass and stiff leave no part of the damping",
                            "give one of them, or none for both");
        if ((!d.mass || !d.stiffness) && d.kind != rayleigh)
            incomplete_line(reader, "mass and stiff belong to damping by fraction and frequency",
                            "write for example: damp 0.05 1.5 mass");
    });
    entry.right("damp auto")
        .right("damp global 0.7")
        .right("damp local")
        .right("DAMP LOCAL 0.8")
        .right("damp 0.05 1.5 mass")
        .right("damp 0.02 10")
        .right("damp 0 0")
        .right("damp combined 0.8")
        .right("damp none contact 0.1")
        .right("damp local contact 0.05")
        .right("damp none");
    entry.wrong("damp", "damp does not say how to damp");
    entry.wrong("damp 0.05", "a number is missing after '0.05'");
    entry.wrong("damp 0.05 0", "a part of critical damping needs a frequency above 0");
    entry.wrong("damp contact 1", "fraction must be less than 1, not 1");
    entry.wrong("damp local 2", "factor must be at most 1, not 2");
    entry.wrong("damp locla", "'locla' is not a keyword of damp");
    entry.wrong("damp local mass", "mass and stiff belong to damping by fraction and frequency");
    return entry;
}

constexpr const char* calm_help = "stops all motion each time after so many cycles; 0: never";

CommandSpec cycle() {
    Entry<CycleCommand> entry({"cycle", "step"});
    entry.help("runs a number of cycles or a span of time");
    entry.argument(integer("n").at_least(0).optional().help("number of cycles"), &CycleCommand::cycles);
    entry.keyword({"time"}, real("t").unit("time").at_least(0), &CycleCommand::time, "time to be covered");
    entry.keyword({"calm"}, integer("n").at_least(0), &CycleCommand::calm, calm_help);
    entry.finish([](const Reader& reader, CycleCommand& c) {
        if (!c.cycles && !c.time)
            incomplete_line(reader, "cycle has no number of cycles", "write for example: cycle 1000");
    });
    entry.right("cycle 1000")
        .right("step 10")
        .right("cyc 20000")
        .right("cycle time 0.5")
        .right("cycle 200 calm 20")
        .right("cycle @n");
    entry.wrong("cycle", "cycle has no number of cycles");
    entry.wrong("step 10.5", "step takes a whole number, not 10.5");
    entry.wrong("cycle -5", "cycle must be at least 0, not -5");
    entry.wrong("cycle many", "'many' is not a keyword of cycle");
    entry.wrong("cycle 10 20", "expected a keyword of cycle, found '20'");
    return entry;
}

/// One of the words after include and exclude.
Parts<Solve> reduced(std::vector<Solve::Reduced> Solve::*list) {
    using enum Solve::Reduced;
    std::vector<Parts<Solve>::Choice> choices;
    for (const auto& [word, which] :
         {std::pair("joints", joints), std::pair("zones", zones), std::pair("friction", friction),
          std::pair("cohesion", cohesion), std::pair("tension", tension), std::pair("joint-friction", joint_friction),
          std::pair("joint-cohesion", joint_cohesion), std::pair("joint-tension", joint_tension),
          std::pair("zone-friction", zone_friction), std::pair("zone-cohesion", zone_cohesion),
          std::pair("zone-tension", zone_tension)})
        choices.push_back({word, Parts<Solve>().set([list, which = which](Solve& s) { (s.*list).push_back(which); })});
    return Parts<Solve>().one_of(
        text(
            "joints|zones|friction|cohesion|tension|joint-friction|joint-cohesion|joint-tension|zone-friction|zone-cohesion|zone-tension")
            .spec,
        "a strength that fos reduces", std::move(choices));
}

CommandSpec solve() {
    return Entry<Solve>({"solve"})
        .help("cycles until the model is at rest or a limit is reached, whichever comes first")
        .keyword({"ratio", "ratio-average"}, real("r").above(0), &Solve::ratio,
                 "unbalanced over average force; 1e-5 if no limit is given")
        .keyword({"ratio-maximum", "maximum"}, real("r").above(0), &Solve::maximum_ratio,
                 "largest unbalanced over average force")
        .keyword({"ratio-local", "local"}, real("r").above(0), &Solve::local_ratio,
                 "largest ratio of unbalanced to acting force of one body")
        .keyword({"force"}, real("f").unit("force").at_least(0), &Solve::force, "largest unbalanced force")
        .keyword({"cycles", "steps"}, integer("n").at_least(1), &Solve::cycles, "number of cycles")
        .keyword({"time"}, real("t").unit("time").above(0), &Solve::time, "time to be covered")
        .keyword({"clock"}, real("m").unit("minutes").above(0), &Solve::clock, "minutes on the clock")
        .keyword({"cycles-total"}, integer("n").at_least(0), &Solve::total_cycles, "number of cycles of the model")
        .keyword({"time-total"}, real("t").unit("time").at_least(0), &Solve::total_time, "time of the model")
        .action(
            {"and"}, [](Solve& s) { s.all = true; }, "the run ends when all limits are reached, not at the first")
        .between()
        .action(
            {"or"}, [](Solve&) {}, "the run ends at the first limit, as always")
        .action(
            {"still"}, [](Solve& s) { s.still = true; },
            "a ratio or a force is accepted only when no body gains displacement any more; always on with fos")
        .action(
            {"elastic"}, [](Solve& s) { s.elastic = true; }, "first with unbreakable joints, then with the true ones")
        .action(
            {"only"}, [](Solve& s) { s.only = true; }, "with elastic: the true joints do not follow")
        .keyword({"calm"}, integer("n").at_least(0), &Solve::calm, calm_help)
        .action(
            {"fos", "factor"}, [](Solve& s) { s.factor_of_safety = true; },
            "computes the factor of safety by strength reduction; the model is left unchanged")
        .keyword({"bracket"}, pair("f1 f2").above(0), &Solve::bracket, "with fos: a stable factor and a failing one")
        .keyword({"resolution"}, real("f").above(0).below(1), &Solve::resolution,
                 "with fos: relative difference of the two factors at the end; 0.005 if not given")
        .keyword({"file"}, text("file"), &Solve::file, "with fos: file for the failed state")
        .keyword({"include"}, reduced(&Solve::included), "with fos: only this is divided; may stand several times")
        .keyword({"exclude"}, reduced(&Solve::excluded), "with fos: this is not divided; may stand several times")
        .action(
            {"keep"}, [](Solve& s) { s.keep = true; },
            "with fos: the model keeps the state at the end of the last failed trial")
        .action(
            {"associated"}, [](Solve& s) { s.associated = true; },
            "with fos: zones dilate as much as they have friction, as far as it is reduced; otherwise dilation stays what it is, but never above friction")
        .keyword(
            {"extrapolate"},
            Parts<Solve>().set(&Solve::extrapolate, true).maybe(on_off().optional(), &Solve::extrapolate),
            "with fos: estimates the factor on fine zones, with a band, by a second search whose zones share their strains with their neighbours; off: the factor is that of the mesh; not given: for Mohr-Coulomb zones that dilate as much as they have friction, without joints and structures")
        .place(&Solve::place)
        .finish([](const Reader& reader, Solve& s) {
            const std::string& last = reader.previous().folded;
            if (last == "and" || last == "or")
                incomplete_line(reader, fmt::format("a limit is missing after '{}'", last),
                                "write for example: solve ratio 1e-5 and cycles 1000");
            if (s.only && !s.elastic)
                incomplete_line(reader, "only belongs to elastic", "write for example: solve elastic only");
            if (!s.factor_of_safety && (s.bracket || !s.file.empty() || s.keep || s.associated || s.extrapolate ||
                                        !s.included.empty() || !s.excluded.empty()))
                incomplete_line(reader,
                                "bracket, file, include, exclude, keep, associated and extrapolate belong to fos",
                                "write for example: solve fos bracket 1 2");
            if (s.factor_of_safety &&
                (s.elastic || s.calm > 0 || s.force || s.time || s.clock || s.total_cycles || s.total_time || s.all))
                incomplete_line(
                    reader,
                    "fos goes with a ratio, cycles, bracket, resolution, file, include, exclude, keep, associated and extrapolate only",
                    "give other limits to a separate `solve` before");
            if (s.factor_of_safety && s.ratio.has_value() + s.maximum_ratio.has_value() + s.local_ratio.has_value() > 1)
                incomplete_line(reader, "fos takes one ratio", "write for example: solve fos ratio-local 1e-4");
            if (s.bracket && !reader.wildcards() && !((*s.bracket)[0] < (*s.bracket)[1]))
                incomplete_line(reader, "the stable factor must be below the failing one",
                                "write for example: solve fos bracket 1 2");
        })
        .right("solve")
        .right("solve ratio 1e-6 cyc 5000")
        .right("solve step 100")
        .right("solve elastic force 1e3")
        .right("solve elastic only ratio 1e-4")
        .right("solve ratio 1e-4 calm 100")
        .wrong("solve only", "only belongs to elastic")
        .right("solve ratio 1e-5 still")
        .right("solve ratio-local 1e-4 time 2 clock 10")
        .right("solve ratio 1e-4 and cycles 100")
        .right("solve cycles-total 2000 or time-total 1.5")
        .right("solve fos")
        .right("solve fos resolution 0.01 ratio 1e-4 cycles 2000 file 'failed.sav'")
        .right("solve fos exclude zones keep")
        .right("solve fos exclude joint-tension exclude zone-tension")
        .right("solve fos include joints include friction")
        .right("solve fos extrapolate")
        .right("solve fos extrapolate off")
        .right("solve fos associated ratio-local 1e-4")
        .wrong("solve fos ratio 1e-4 ratio-local 1e-3", "fos takes one ratio")
        .wrong("solve bracket 1 2", "bracket, file, include, exclude, keep, associated and extrapolate belong to fos")
        .wrong("solve fos exclude fricton", "'fricton' is not a strength that fos reduces")
        .wrong("solve fos bracket 2 1", "the stable factor must be below the failing one")
        .wrong(
            "solve fos force 1",
            "fos goes with a ratio, cycles, bracket, resolution, file, include, exclude, keep, associated and extrapolate only")
        .wrong("solve raito 1e-5", "'raito' is not a keyword of solve")
        .wrong("solve cycles 10 adn time 1", "'adn' is not a keyword of solve")
        .wrong("solve ratio 1e-5 and", "a limit is missing after 'and'")
        .wrong("solve ratio", "a number is missing after 'ratio'")
        .wrong("solve ratio 0", "ratio must be greater than 0, not 0")
        .wrong("solve 100", "expected a keyword of solve, found '100'");
}

CommandSpec mass_scale() {
    return Entry<MassScale>({"mscale"})
        .help("density scaling: inertial masses differ from weights, for a longer time step")
        .action(
            {"on", "full"}, [](MassScale& m) { m.on = true; },
            "all bodies, so that all allow the same time step; for static solution")
        .keyword({"partial"}, real("dt").unit("time").above(0), &MassScale::step,
                 "more mass for the bodies that allow a time step below dt only")
        .action(
            {"off"}, [](MassScale& m) { m.off = true; }, "true masses")
        .finish([](const Reader& reader, MassScale& m) {
            const int given = m.on + m.off + m.step.has_value();
            if (given == 0) incomplete_line(reader, "mscale has no mode", "expected: on, part dt or off");
            if (given > 1) incomplete_line(reader, "on, part and off exclude each other", "keep one of them");
        })
        .right("mscale on")
        .right("mscale part 1e-4")
        .right("mscale off")
        .wrong("mscale", "mscale has no mode")
        .wrong("mscale part", "a number is missing after 'part'")
        .wrong("mscale part 0", "dt must be greater than 0, not 0")
        .wrong("mscale on off", "on, part and off exclude each other")
        .wrong("mscale maybe", "'maybe' is not a keyword of mscale");
}

} // namespace

Family solution() {
    return {"solution",
            "cycles, damping, time step",
            {
                cycle(),
                solve(),
                solve_control(),
                damp(),
                mass_scale(),
                Entry<Fraction>({"fraction"})
                    .help("time step as a fraction of the largest stable one")
                    .argument(real("f").above(0).at_most(1), &Fraction::value)
                    .right("fraction 0.3")
                    .wrong("fraction", "a number is missing after 'fraction'")
                    .wrong("fraction 2", "fraction must be at most 1, not 2"),
            }};
}

} // namespace kaya::lang
