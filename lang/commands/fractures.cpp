// Fractures: made one by one, changed, measured.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/fracture_words.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

CommandSpec create_fracture() {
    Entry<FractureCommand> entry({Spelling{"fracture", 6}}, {"create"});
    entry.help("adds a disc to a network of fractures").place(&FractureCommand::place);
    entry.keyword({"position"}, vector("x y z").unit("length"), &FractureCommand::position,
                  "centre; the origin if not given");
    entry.keyword({"dip"}, real("dip").unit("degrees"), &FractureCommand::dip,
                  "angle below the horizontal, 0 if not given");
    entry.keyword({"dip-direction", "dd"}, real("dd").unit("degrees"), &FractureCommand::dip_direction,
                  "direction of dip, clockwise from +y seen from above, 0 if not given");
    entry.keyword({"size"}, real("d").unit("length").above(0).at_most(1e12), &FractureCommand::size,
                  "diameter, 1 if not given");
    entry.keyword({"dfn"}, text("name"), &FractureCommand::network, "name of the network");
    add_group(entry);
    entry.not_yet({"intersection-set"}, "sets of intersections: fracture intersections computes those of fractures");
    entry.right("fracture create position 0.5 0.5 0.5 dip 30 dip-direction 90 size 4 dfn 'faults'");
    entry.right("fracture create").right("fracture create size 3 dfn 'faults' group main slot rank dominance 1");
    entry.wrong("fracture create size 0", "size must be greater than 0, not 0");
    entry.wrong("fracture create dpi 30", "'dpi' is not a keyword of fracture create");
    entry.wrong("fracture create dominance -1", "dominance must be at least 0, not -1");
    return entry;
}

Entry<FractureChange> change_line(std::vector<Spelling> form, FractureChange::What what) {
    Entry<FractureChange> entry({Spelling{"fracture", 6}}, std::move(form));
    entry.start([what](const Statement& statement, FractureChange& command) {
        command.what = what;
        command.place = statement.words.front().place;
    });
    return entry;
}

CommandSpec delete_fractures() {
    auto entry = change_line({"delete"}, FractureChange::What::remove);
    entry.help("deletes fractures: of a network, of a size or group, outside of a box, or a part of them by chance");
    add_choice(entry);
    add_box(entry, {"outside"}, "fractures that do not reach this box");
    entry.keyword({"share"}, real("p").at_least(0).at_most(1), &FractureChange::share,
                  "probability that one of these fractures is deleted, 1 if not given");
    entry.keyword({"seed"}, integer("n").at_least(0).at_most(1e9), &FractureChange::seed,
                  "of share: another choice; 1 if not given");
    entry.right("fracture delete dfn 'faults'").right("fracture delete");
    entry.right("fracture delete sizes 0 2 dfn 'faults'").right("fracture delete outside 0 10 0 10 0 10");
    entry.right("fracture delete share 0.5 seed 3");
    entry.wrong("fracture delete 'faults'", "expected a keyword of fracture delete, found the text 'faults'");
    entry.wrong("fracture delete share 2", "share must be at most 1, not 2");
    return entry;
}

CommandSpec copy_fractures() {
    auto entry = change_line({"copy"}, FractureChange::What::copy);
    entry.help("copies fractures to another network, so that several become one");
    entry.keyword(
        {"from-dfn"}, text("name"), [](FractureChange& c, const std::string& name) { c.choice.network = name; },
        "the same as dfn");
    add_choice(entry);
    entry.keyword({"to-dfn"}, text("name"), &FractureChange::name, "the network that gets the copies");
    entry.finish([](const Reader& reader, FractureChange& command) {
        if (command.name.empty()) incomplete_line(reader, "the network of the copies is missing", "write: to-dfn name");
    });
    entry.right("fracture copy from-dfn 'faults' to-dfn 'all'").right("fracture copy sizes 0 99 to-dfn 'small'");
    entry.wrong("fracture copy from-dfn 'faults'", "the network of the copies is missing");
    return entry;
}

CommandSpec truncate_fractures() {
    auto entry = change_line({"truncate"}, FractureChange::What::truncate);
    entry.help("cuts fractures to a box: what lies outside is deleted, and discs that cross its sides become polygons");
    add_choice(entry);
    add_box(entry, {"box"}, "that around the model if not given");
    entry.keyword(
        {"sides"}, integer("n").at_least(3).at_most(64), &FractureChange::sides,
        "of the regular polygon, equal in area, that stands for a disc at a side of the box; 12 if not given");
    entry.right("fracture truncate box 0 10 0 10 0 10").right("fracture truncate dfn 'faults' sides 32");
    entry.wrong("fracture truncate box 0 1", "a number is missing after '1'");
    return entry;
}

CommandSpec combine_fractures() {
    using Joining = FractureChange::Joining;
    auto entry = change_line({"combine"}, FractureChange::What::combine);
    entry.help("turns fractures that nearly lie in the plane of a larger one into its direction");
    entry.keyword({"angle"}, real("angle").unit("degrees").at_least(0).at_most(90), &FractureChange::angle,
                  "greatest angle between both planes");
    entry.keyword({"distance"}, real("d").unit("length").at_least(0), &FractureChange::distance,
                  "greatest distance of the centre of the smaller fracture from the plane of the larger one");
    entry.action(
        {"collapse"}, [](FractureChange& c) { c.joining = Joining::collapse; },
        "also moves them into the plane of the larger one");
    entry.action(
        {"merge"}, [](FractureChange& c) { c.joining = Joining::merge; },
        "moves those that overlap the larger one in its plane, and makes one fracture of both");
    entry.action(
        {"merge-convex"}, [](FractureChange& c) { c.joining = Joining::hull; },
        "moves those that overlap the larger one in its plane, and makes the convex hull of both");
    entry.keyword({"sides"}, integer("n").at_least(3).at_most(64), &FractureChange::sides,
                  "of merge-convex: of the regular polygon, equal in area, that stands for a disc; 12 if not given");
    add_choice(entry);
    entry.finish([](const Reader& reader, FractureChange& command) {
        if (!command.angle || !command.distance)
            incomplete_line(reader, "combine needs an angle and a distance", "write: angle 10 distance 0.5");
        if (command.sides && command.joining != Joining::hull)
            incomplete_line(reader, "sides belongs to merge-convex", "write: merge-convex sides 24");
    });
    entry.right("fracture combine angle 10 distance 0.5")
        .right("fracture combine angle 5 distance 1 merge dfn 'faults'");
    entry.right("fracture combine angle 5 distance 1 collapse sizes 0 9")
        .right("fracture combine angle 5 distance 1 merge-convex sides 32");
    entry.wrong("fracture combine angle 10", "combine needs an angle and a distance");
    entry.wrong("fracture combine angle 5 distance 1 merge sides 32", "sides belongs to merge-convex");
    entry.wrong("fracture combine angle 91 distance 1", "angle must be at most 90, not 91");
    return entry;
}

CommandSpec group_fractures() {
    auto entry = change_line({"group"}, FractureChange::What::group);
    entry.help("puts fractures into a group");
    entry.argument(text("name").help("name of the group; `slot=name` names its slot as well"), &FractureChange::name);
    add_slot(
        entry, [](FractureChange & command) -> auto& { return command.name; });
    entry.action(
        {Spelling{"remove", 3}}, [](FractureChange& command) { command.out = true; },
        "takes the fractures out of the group; without a slot out of all groups of this name");
    add_choice(entry);
    entry.right("fracture group large sizes 5 100").right("fracture group main slot rank dfn 'faults' remove");
    entry.wrong("fracture group", "a word is missing after 'group'");
    return entry;
}

CommandSpec cluster_fractures() {
    auto entry = change_line({"cluster"}, FractureChange::What::cluster);
    entry.help("puts fractures that are connected by intersections into the groups cluster-1, the one of most "
               "fractures, cluster-2, ...");
    entry.keyword({"group-slot", "slot"}, text("slot"), &FractureChange::name, "of the groups, cluster if not given");
    add_choice(entry);
    entry.not_yet({"intersection-set"}, "sets of intersections");
    entry.right("fracture cluster").right("fracture cluster group-slot net dfn 'faults'");
    entry.wrong("fracture cluster 'faults'", "expected a keyword of fracture cluster, found the text 'faults'");
    return entry;
}

CommandSpec measure_fractures() {
    using What = FractureMeasure::What;
    Entry<FractureMeasure> entry({Spelling{"fracture", 6}}, {"compute"});
    entry.help("prints how dense fractures are").place(&FractureMeasure::place);
    entry.action(
        {"p10"}, [](FractureMeasure& m) { m.what = What::crossings, m.set.clear(); },
        "fractures that a line crosses, over its length");
    entry.action(
        {"mass-density", "p32"}, [](FractureMeasure& m) { m.what = What::area, m.set.clear(); },
        "area of fractures in a box over its volume");
    entry.action(
        {"center-density"}, [](FractureMeasure& m) { m.what = What::number, m.set.clear(); },
        "centres in a box over its volume");
    const auto of_traces = [&](std::vector<Spelling> words, What what, const char* help) {
        entry.keyword(
            std::move(words),
            Parts<FractureMeasure>().set(&FractureMeasure::what, what).then(text("set"), &FractureMeasure::set), help);
    };
    of_traces({"trace-mass-density", "p21"}, What::trace_area,
              "length of traces on the polygons of a set of `geometry` over their area");
    of_traces({"trace-center-density", "p20"}, What::trace_number,
              "middles of traces on the polygons of a set over their area");
    of_traces({"average-trace-length"}, What::trace_length, "mean length of the traces on the polygons of a set");
    add_line(entry);
    add_box(entry, {"box"}, "that around the model if not given");
    add_choice(entry);
    entry.action(
        {"percolation"}, [](FractureMeasure& m) { m.what = What::percolation, m.set.clear(); },
        "percolation parameter: pi^2 r^3, summed over the fractures in a box, over its volume");
    entry.keyword({"option"}, integer("i").at_least(0).at_most(2), &FractureMeasure::option,
                  "of percolation: fractures that cross the sides of the box are left out (0, if not given), have the "
                  "area inside (1), or a radius in proportion to the area inside (2)");
    entry.finish([](const Reader& reader, FractureMeasure& command) {
        if (command.what == What::list)
            incomplete_line(reader, "nothing says what is measured",
                            "write one of: p10, mass-density, center-density, percolation, trace-mass-density");
        check_line(reader, command, command.what == What::crossings);
        if (command.option && command.what != What::percolation && !reader.wildcards())
            incomplete_line(reader, "option belongs to percolation", "write: fracture compute percolation option 1");
    });
    entry.right("fracture compute p10 begin 0 0 0 end 0 0 10");
    entry.right("fracture compute mass-density box 0 10 0 10 0 10 dfn 'faults'")
        .right("fracture compute center-density");
    entry.right("fracture compute trace-mass-density 'wall' sizes 0 99").right("fracture compute p20 'wall'");
    entry.right("fracture compute percolation option 2 box 0 10 0 10 0 10");
    entry.wrong("fracture compute", "nothing says what is measured");
    entry.wrong("fracture compute p10 begin 0 0 0", "p10 needs a line");
    entry.wrong("fracture compute p21", "a word is missing after 'p21'");
    entry.wrong("fracture compute mass-density option 1", "option belongs to percolation");
    entry.wrong("fracture compute percolation option 3", "option must be at most 2, not 3");
    return entry;
}

CommandSpec list_fractures() {
    Entry<FractureMeasure> entry({Spelling{"fracture", 6}}, {"list"});
    entry.help("lists fractures: number, centre, dip, dip direction, diameter, dominance, joint set, groups")
        .place(&FractureMeasure::place);
    entry.action(
        {"intersection"}, [](FractureMeasure& m) { m.what = FractureMeasure::What::intersections; },
        "the lines on which two of the fractures meet");
    add_choice(entry);
    entry.right("fracture list").right("fracture list dfn 'faults'").right("fracture list intersection of-group a");
    entry.wrong("fracture list 'faults'", "expected a keyword of fracture list, found the text 'faults'");
    return entry;
}

CommandSpec intersect_fractures() {
    Entry<FractureMeasure> entry({Spelling{"fracture", 6}}, {"intersections"});
    entry.then({"compute"})
        .help("prints how many pairs of fractures meet, the length of their lines, and how many "
              "clusters they connect");
    entry.start([](const Statement& statement, FractureMeasure& m) {
        m.what = FractureMeasure::What::intersection_sums;
        m.place = statement.words.front().place;
    });
    add_choice(entry);
    entry.not_yet({"with-geometry", "intersection-set", "group-slot"}, "sets of intersections");
    entry.right("fracture intersections compute").right("fracture intersections compute dfn 'faults'");
    entry.wrong("fracture intersections", "a word is missing after 'intersections'");
    return entry;
}

} // namespace

std::vector<CommandSpec> fracture_commands() {
    std::vector<CommandSpec> commands{create_fracture(),   delete_fractures(), copy_fractures(),   truncate_fractures(),
                                      combine_fractures(), group_fractures(),  cluster_fractures()};
    for (CommandSpec& command : network_commands()) commands.push_back(std::move(command));
    for (CommandSpec& command : std::vector{measure_fractures(), intersect_fractures(), list_fractures()})
        commands.push_back(std::move(command));
    return commands;
}

} // namespace kaya::lang
