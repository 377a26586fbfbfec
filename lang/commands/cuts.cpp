// Commands that cut blocks.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// A value and the half width of its scatter.
void with_deviation(Entry<JointSetCommand>& entry, std::vector<Spelling> words, const Argument<double>& value,
                    const Argument<double>& deviation, std::array<double, 2> JointSetCommand::*member,
                    std::string_view help) {
    const auto part = [member](std::size_t k) {
        return [ member, k ](JointSetCommand & set) -> auto& { return (set.*member)[k]; };
    };
    entry.keyword(std::move(words), Parts<JointSetCommand>().then(value, part(0)).maybe(deviation, part(1)), help);
}

CommandSpec joint_set() {
    Entry<JointSetCommand> entry({"jset"});
    entry.help("cuts visible blocks by a set of parallel joints");
    const auto deviation = real("deviation").unit("degrees").at_least(0).optional();
    with_deviation(entry, {"dip"}, real("dip").unit("degrees"), deviation, &JointSetCommand::dip,
                   "angle below the horizontal and half width of its scatter, 0 if not given");
    with_deviation(entry, {"dd", "dip-direction"}, real("dd").unit("degrees"), deviation,
                   &JointSetCommand::dip_direction,
                   "direction of dip, clockwise from +y seen from above, and its scatter");
    with_deviation(entry, {"spacing"}, real("spacing").unit("length").at_least(0),
                   real("deviation").unit("length").at_least(0).optional(), &JointSetCommand::spacing,
                   "distance between joints and its scatter");
    entry.keyword({"number"}, integer("n").at_least(1).at_most(1e6), &JointSetCommand::number,
                  "of joints, 1 if not given; the first passes through the origin, the others lie on both sides");
    entry.keyword({"origin", "org"}, vector("x y z").unit("length"), &JointSetCommand::origin,
                  "a point of the first joint");
    entry.keyword({Spelling{"persistence", 1}}, real("p").at_least(0).at_most(1), &JointSetCommand::persistence,
                  "probability that a block on a joint is cut, 1 if not given");
    entry.keyword(
        {"tolerance"}, real("distance").unit("length").at_least(0), &JointSetCommand::tolerance,
        "a block is not cut where that would leave an edge shorter than this, or a corner nearer to the joint; 0 if not given");
    entry.keyword({"id"}, integer("n").at_least(1).at_most(2000000000), &JointSetCommand::id,
                  "number of the set, which its faces keep; counts up if not given");
    entry.keyword({"seed"}, integer("n").at_least(0), &JointSetCommand::seed,
                  "chooses another scatter; the same seed gives the same joints");
    entry.action(
        {"join"}, [](JointSetCommand& set) { set.join = true; }, "the pieces of a block remain one body");
    entry.range(&JointSetCommand::range);
    entry.place(&JointSetCommand::place);
    entry.finish([](const Reader& reader, JointSetCommand& set) {
        if (!reader.wildcards() && set.number > 1 && set.spacing[0] == 0)
            throw Diagnostic(fmt::format("{} joints need a spacing, and it is 0", set.number),
                             "give a spacing above 0, or number 1")
                .at(set.place);
    });
    entry.right("jset dip 45 dd 90").right("jset dip 60,5 dd 270,10 spacing 2,0.3 num 20 org 0,0,10 id 2");
    entry.right("jset dip 30 dd 90 join");
    entry.right("jset dip 80 spacing 1 number 5 persistence 0.7 seed 3 range region 1");
    entry.right("jset dip 60 5 dd 270 10 spacing 2 num 20 tolerance 0.1");
    entry.wrong("jset tolerance -1", "distance must be at least 0, not -1");
    entry.wrong("jset dip", "a number is missing after 'dip'");
    entry.wrong("jset dip 45 num 0", "num must be at least 1, not 0");
    entry.wrong("jset dip 45 num 1000000000", "num must be at most 1e+06, not 1e+09");
    entry.wrong("jset spacing 0 num 5", "5 joints need a spacing, and it is 0");
    entry.wrong("jset persistence 2", "persistence must be at most 1, not 2");
    entry.wrong("jset pid 45", "'pid' is not a keyword of jset");
    return entry;
}

CommandSpec tunnel() {
    Entry<TunnelCommand> entry({"tunnel"});
    entry.help("cuts visible blocks along the outline of a tunnel; no block is removed");
    const auto polygon = [&](const char* word, std::vector<Vec3> TunnelCommand::*member, std::string_view help) {
        entry.keyword({word}, Parts<TunnelCommand>().each(vector("x y z ...").unit("length"), member), help);
    };
    polygon("a", &TunnelCommand::first, "corners of the outline at one end, in order around it");
    polygon("b", &TunnelCommand::second, "corners at the other end, each opposite its partner");
    entry.keyword({"path"}, Parts<TunnelCommand>().each(vector("x y z ...").unit("length"), &TunnelCommand::path),
                  "the outline a is moved along these points, from the first one, near it, to the last; in place of b");
    entry.keyword({"region"}, integer("n").at_least(1), &TunnelCommand::region,
                  "region number of the blocks inside; unchanged if not given");
    entry.action(
        {"radial"}, [](TunnelCommand& command) { command.radial = true; },
        "cuts the blocks around from the axis through each corner, too");
    entry.action(
        {"join"}, [](TunnelCommand& command) { command.join = true; },
        "the pieces of a block inside remain one body, and those outside");
    entry.range(&TunnelCommand::range);
    entry.place(&TunnelCommand::place);
    entry.finish([](const Reader& reader, TunnelCommand& command) {
        if (command.first.empty() || command.second.empty() == command.path.empty())
            incomplete_line(reader, "a tunnel needs two polygons, or one and a path",
                            "write: tunnel a x y z ... b x y z ..., or: tunnel a x y z ... path x y z ...");
        if (command.radial && (command.join || !command.path.empty()))
            throw Diagnostic("radial joints are for a tunnel between two polygons, whose pieces are not joined",
                             "leave out radial")
                .at(command.place);
    });
    entry.right("tunnel region 2 a 4,0,4 6,0,4 6,0,6 4,0,6 b 4,10,4 6,10,4 6,10,6 4,10,6");
    entry.right("tunnel radial a 4,0,4 6,0,4 5,0,6 b 4,9,4 6,9,4 5,9,6 range region 1");
    entry.right("tunnel join region 2 a 4,0,4 6,0,4 6,0,6 4,0,6 path 5,0,5 5,6,5 9,9,5");
    entry.wrong("tunnel a 4 0 4 6 0 4 5 0 6", "a tunnel needs two polygons, or one and a path");
    entry.wrong("tunnel a 4 0 4 6 0 4 5 0 6 path 5 0 5 5 9 5 radial",
                "radial joints are for a tunnel between two polygons, whose pieces are not joined");
    entry.wrong("tunnel 4 0 4", "expected a keyword of tunnel, found '4'");
    return entry;
}

CommandSpec cut_ground() {
    Entry<CutGround> entry({"cut"}, {"ground"});
    entry.help("cuts visible blocks along a ground surface; no block is removed");
    entry.argument(
        text("file").help("of the surface: .asc, .pit, a surface file as `import` reads it, or lines of x y z"),
        &CutGround::file);
    entry.keyword({"shift"}, vector("dx dy dz").unit("length"), &CutGround::shift, "moves the surface first");
    entry.keyword({"id"}, integer("n").at_least(1).at_most(1e9), &CutGround::id,
                  "joint set number of the faces; the next free one if not given");
    entry.keyword({"region"}, integer("n").at_least(1), &CutGround::region, "region number of the blocks below");
    entry.range(&CutGround::range);
    entry.place(&CutGround::place);
    entry.right("cut ground 'hill.xyz'").right("cut ground 'hill.xyz' shift 0 0 -0.2 region 3 id 7 range group wall");
    entry.wrong("cut", "a word is missing after 'cut'");
    entry.wrong("cut ground", "a word is missing after 'ground'");
    entry.wrong("cut ground 'hill.xyz' shfit 0 0 1", "'shfit' is not a keyword of cut ground");
    entry.wrong("cut ground 'hill.xyz' shift 0 0", "a number is missing after '0'");
    return entry;
}

CommandSpec cut_surface() {
    Entry<CutSurface> entry({"cut"}, {"surface"});
    entry.help("cuts visible blocks along the surface of an ore body, or an open surface that may overhang");
    entry.argument(text("file").help("of closed surfaces, or of one open surface, as `import` reads it"),
                   &CutSurface::file);
    entry.keyword({"shift"}, vector("dx dy dz").unit("length"), &CutSurface::shift, "moves the surface first");
    entry.keyword({"id"}, integer("n").at_least(1).at_most(1e9), &CutSurface::id,
                  "joint set number of the faces; the next free one if not given");
    entry.keyword({"region"}, integer("n").at_least(1), &CutSurface::region,
                  "region number of the blocks inside of closed surfaces, or of the pieces below an open one");
    entry.action(
        {"join"}, [](CutSurface& command) { command.join = true; }, "the pieces of a block remain one body");
    entry.range(&CutSurface::range);
    entry.place(&CutSurface::place);
    entry.right("cut surface 'ore.stl'")
        .right("cut surface 'ore.stl' shift 0 0 -0.2 region 3 id 7 join range group wall");
    entry.wrong("cut surface", "a word is missing after 'surface'");
    entry.wrong("cut surface 'ore.stl' shfit 0 0 1", "'shfit' is not a keyword of cut surface");
    return entry;
}

CommandSpec densify() {
    Entry<Densify> entry({"densify", "density"});
    entry.help("cuts each block into equal parts along x, y and z");
    const auto parts = [&](std::string_view name, std::size_t k, std::string_view help) {
        entry.argument(
            integer(name).at_least(1).at_most(1000).help(help), [k](Densify & command) -> auto& {
                return command.parts[k];
            });
    };
    parts("nx", 0, "parts along x");
    parts("ny", 1, "parts along y");
    parts("nz", 2, "parts along z");
    entry.action(
        {"join"}, [](Densify& command) { command.join = true; }, "the parts remain one body");
    entry.range(&Densify::range);
    entry.place(&Densify::place);
    entry.right("densify 2 2 1").right("densify 1 1 4 join range group column");
    entry.wrong("densify 2 2", "a number is missing after '2'");
    entry.wrong("densify 0 1 1", "nx must be at least 1, not 0");
    return entry;
}

CommandSpec join() {
    Entry<Join> entry({"join"});
    entry.help("joins blocks with faces in contact into one body, or separates them");
    entry.action(
        {"on"}, [](Join& join) { join.on = true; }, "joins, the default");
    entry.action(
        {"off"}, [](Join& join) { join.on = false; }, "separates the bodies of these blocks");
    entry.range(&Join::range);
    entry.place(&Join::place);
    entry.right("join").right("join on range group arch").right("join off range x 0 1");
    entry.wrong("join oof", "'oof' is not a keyword of join");
    return entry;
}

CommandSpec join_contact() {
    Entry<JoinContact> entry({"join_contact", "join-contact"});
    entry.help("joins the two blocks of each contact in the range");
    entry.range(&JoinContact::range);
    entry.place(&JoinContact::place);
    entry.right("join_contact range jset 2").right("join_contact range plane dip 0 dd 0 org 0 0 1 distance 0.01");
    entry.wrong("join_contact on", "'on' is not a keyword of join_contact");
    return entry;
}

} // namespace

std::vector<CommandSpec> cut_commands() {
    return {joint_set(), tunnel(), cut_ground(), cut_surface(), densify(), join(), join_contact()};
}

} // namespace kaya::lang
