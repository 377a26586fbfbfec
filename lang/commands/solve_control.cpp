#include "lang/commands/solve_control.hpp"

#include "lang/commands/builder.hpp"
#include "lang/commands/directions.hpp"

namespace kaya::lang {

CommandSpec solve_control() {
    const auto along = direction(vector("dx dy dz").spec);
    const auto variable = text("@name");
    return Entry<SolveControl>({"solve"}, {Spelling{"control", 4}})
        .help("pushes the model past its peak: scales loads such that they move at a given speed, or drives a boundary")
        .keyword({"gravity"}, Parts<SolveControl>().in(made(&SolveControl::gravity), along),
                 "scales the part of gravity along this direction; the part normal to it stays")
        .keyword(
            {"scale"},
            Parts<SolveControl>()
                .argument(variable.spec)
                .by([=](Reader& reader, SolveControl& c) { c.variable = reader.symbol(variable.spec); },
                    [](Parts<SolveControl>::Form form, const SolveControl& wanted) {
                        if (wanted.variable.empty()) return Parts<SolveControl>::Forms{};
                        form.words.push_back({"@" + wanted.variable});
                        form.after.variable = wanted.variable;
                        return Parts<SolveControl>::Forms{std::move(form)};
                    }),
            "sets this variable of FISH, which scales the loads, or drives the boundary, that were given with `hist @name`")
        .keyword({"speed"}, real("v").unit("velocity").above(0), &SolveControl::speed, "of the displacement, at most")
        .keyword({"damped"}, real("share").above(0).below(1), &SolveControl::damped,
                 "the run goes slower while damping takes more than this of the work; 0.02 if not given")
        .keyword({"to"}, real("d").unit("length").above(0), &SolveControl::to, "displacement at which the run ends")
        .keyword({"point"}, vector("x y z").unit("length"), &SolveControl::point,
                 "the displacement is that of the body at this place, and of the loads if not given")
        .keyword({"along"}, Parts<SolveControl>().in(made(&SolveControl::along), along),
                 "of point: the direction of its displacement")
        .keyword({"below"}, real("share").at_least(0).below(1), &SolveControl::below,
                 "the run ends when the load falls to this share of its peak; 0 if not given")
        .keyword({"every"}, integer("n").at_least(1).at_most(1e9), &SolveControl::every,
                 "cycles between rows of the curve, 50 if not given; loads are means of these cycles")
        .keyword({"file"}, text("file"), &SolveControl::file, "of the curve, as CSV")
        .keyword({"plot"}, text("file"), &SolveControl::picture,
                 "a picture of the load over the displacement: .png, .svg or .pdf")
        .keyword({"reactions"}, text("file"), &SolveControl::reactions,
                 "a picture of the sum of all reactions over the displacement")
        .keyword({"energies"}, text("file"), &SolveControl::energies,
                 "a picture of what is stored, lost and damped over the displacement")
        .keyword({"table"}, integer("n").at_least(1), &SolveControl::table, "that gets the load over the displacement")
        .place(&SolveControl::place)
        .finish([](const Reader& reader, SolveControl& c) {
            if (!c.gravity && c.variable.empty())
                incomplete_line(reader, "solve control has no load to scale",
                                "write for example: solve control gravity 1 0 0 speed 0.01 to 0.1");
            if (!(c.speed > 0) || !(c.to > 0))
                incomplete_line(reader, "solve control needs the speed of the displacement and its end",
                                "write for example: solve control gravity 1 0 0 speed 0.01 to 0.1");
            if (c.point.has_value() != c.along.has_value())
                incomplete_line(reader, "point and along belong together",
                                "write for example: point 0 0 5 along 1 0 0");
        })
        .right("solve control gravity 1 0 0 speed 0.01 to 0.02")
        .right("solve control gravity 0 1 0 speed 0.01 to 0.02 below 0.8 every 20 file 'push.csv' table 5")
        .right("solve control scale @push speed 0.01 to 0.02")
        .right("solve control scale @drive speed 0.01 to 0.02 plot 'push.svg'")
        .right("solve control scale @drive speed 0.01 to 0.02 reactions 'reactions.svg' energies 'energies.svg'")
        .right("solve control gravity 1 0 0 speed 0.01 to 0.02 point 0.5 0.5 2 along 1 0 0")
        .wrong("solve control", "solve control has no load to scale")
        .wrong("solve control gravity 1 0 0", "solve control needs the speed of the displacement and its end")
        .wrong("solve control gravity 0 0 0 speed 1 to 1", "(0, 0, 0) is not a direction")
        .wrong("solve control gravity 1 0 0 speed 0 to 1", "speed must be greater than 0, not 0")
        .wrong("solve control gravity 1 0 0 speed 1 to 1 below 1", "share must be less than 1, not 1")
        .wrong("solve control gravity 1 0 0 speed 1 to 1 point 0 0 0", "point and along belong together")
        .wrong("solve control scale push speed 1 to 1", "expected a name with @, found 'push'")
        .wrong("solve control gravity 1 0 0 spede 1 to 1", "'spede' is not a keyword of solve control");
}

} // namespace kaya::lang
