// Networks of fractures: made one by one, drawn from laws, read from files, measured.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/slots.hpp"

namespace kaya::lang {

namespace {

/// The name of a group, and its slot if it follows. `group(struct)` is the name.
template <class Command, class Group> Parts<Command> group_of(Group group) {
    const auto name = Parts<std::string>()
                          .then(
                              text("name"), [](std::string & whole) -> auto& { return whole; })
                          .words(slot_words());
    const Lens<Command, std::string> lens{[group](Command& c) -> std::string& { return group(c); },
                                          [group](const Command& wanted, const Command&) {
                                              const std::string& there = group(const_cast<Command&>(wanted));
                                              return there.empty() ? nullptr : &there;
                                          }};
    return Parts<Command>().in(lens, name);
}

/// The words by which `fracture` commands choose fractures.
template <class Command> void add_choice(Entry<Command>& entry) {
    entry.keyword(
        {"dfn"}, text("name"), [](Command & c) -> auto& { return c.choice.network; },
        "fractures of this network; of all networks if not given");
    using Ids = std::array<std::int64_t, 2>;
    const auto first = integer("n").at_least(1), last = integer("m").at_least(1).optional();
    const auto one = [](Ids& ids, std::int64_t n) { ids = {n, n}; };
    const auto choice = [](auto part) {
        return [part](Command & c) -> auto& { return c.choice.*part; };
    };
    entry.keyword(
        {"ids"},
        Parts<Command>().in(made_at<Command, Ids>(choice(&FractureChoice::ids)),
                            Parts<Ids>()
                                .then(first, Through{one, [](const Ids& ids) { return std::optional(ids[0]); }})
                                .maybe(
                                    last, [](Ids & ids) -> auto& { return ids[1]; })),
        "fractures of this number, or from the first to the last");
    entry.keyword({"sizes"}, pair("diameter diameter").unit("length").at_least(0), choice(&FractureChoice::sizes),
                  "fractures whose diameter is between two limits; of a polygon that of the disc of its area");
    entry.keyword({"of-group"}, group_of<Command>(choice(&FractureChoice::group)),
                  "members of a group: name, slot=name, or name slot s");
}

/// The group and the rank of new fractures.
template <class Command> void add_group(Entry<Command>& entry) {
    entry.keyword({"group"}, group_of<Command>([](Command & c) -> auto& { return c.group; }),
                  "group of the fractures: name, slot=name, or name slot s");
    entry.keyword({"dominance", "dfn-dominance"}, integer("n").at_least(0).at_most(1e6), &Command::dominance,
                  "rank: fractures of a lower one are cut first; 0 if not given");
}

template <class Command> void add_box(Entry<Command>& entry, std::vector<Spelling> words, const char* help) {
    entry.keyword(std::move(words), tensor("x1 x2 y1 y2 z1 z2").unit("length"), &Command::box, help);
}

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

auto angle_at(std::size_t k) {
    return [k](FractureTemplate & made) -> auto& { return made.angles[k]; };
}
auto size_at(std::size_t k) {
    return [k](FractureTemplate & made) -> auto& { return made.sizes[k]; };
}

Parts<FractureTemplate> orientation() {
    using enum FractureTemplate::Orientation;
    const auto angle = real("angle").unit("degrees"), deviation = real("deviation").unit("degrees").at_least(0);
    const auto law = [](FractureTemplate::Orientation orientation) {
        return Parts<FractureTemplate>().set([orientation](FractureTemplate& made) {
            made.orientation = orientation;
            made.angles = {};
        });
    };
    const auto around_a_mean = law(fisher)
                                   .then(angle, angle_at(0))
                                   .then(angle, angle_at(1))
                                   .then(real("kappa").at_least(0).at_most(1e6), angle_at(2));
    const auto of_angles = law(gauss)
                               .then(angle, angle_at(0))
                               .then(deviation, angle_at(1))
                               .then(angle, angle_at(2))
                               .then(deviation, angle_at(3));
    return Parts<FractureTemplate>().one_of(
        text("uniform|fisher dip dd kappa|gauss dip deviation dd deviation").spec, "a law of orientations",
        {{"uniform", law(uniform)}, {"fisher", around_a_mean}, {"gauss", of_angles}});
}

Parts<FractureTemplate> sizes() {
    using enum FractureTemplate::Size;
    const auto exponent = real("exponent").at_least(0).at_most(20), mean = real("mean").unit("length").above(0),
               deviation = real("deviation").unit("length").at_least(0);
    const auto law = [](FractureTemplate::Size size) {
        return Parts<FractureTemplate>().set([size](FractureTemplate& made) {
            made.size = size;
            made.sizes = {};
        });
    };
    const auto one = [&](FractureTemplate::Size size, const Argument<double>& number) {
        return law(size).then(number, size_at(0));
    };
    const auto two = [&](FractureTemplate::Size size) {
        return law(size).then(mean, size_at(0)).then(deviation, size_at(1));
    };
    return Parts<FractureTemplate>().one_of(
        text("power-law exponent|log-normal mean deviation|gauss mean deviation|exponential mean|uniform").spec,
        "a law of sizes",
        {{"power-law", one(power_law, exponent)},
         {"log-normal", two(log_normal)},
         {"gauss", two(gauss)},
         {"exponential", one(exponential, mean)},
         {"uniform", law(uniform)}});
}

void add_limits(Entry<FractureTemplate>& entry, const char* word, const Argument<double>& limit,
                std::optional<std::array<double, 2>> FractureTemplate::*limits, const char* help) {
    using Limits = std::array<double, 2>;
    entry.keyword({word},
                  Parts<FractureTemplate>().in(made(limits), Parts<Limits>()
                                                                 .then(
                                                                     limit, [](Limits & l) -> auto& { return l[0]; })
                                                                 .then(
                                                                     limit, [](Limits & l) -> auto& { return l[1]; })),
                  help);
}

CommandSpec make_template() {
    Entry<FractureTemplate> entry({Spelling{"fracture", 6}}, {"template"});
    entry.then({"create"});
    entry.help("names the orientations and sizes from which fractures are drawn").place(&FractureTemplate::place);
    entry.argument(text("name").help("name of the template"), &FractureTemplate::name);
    entry.keyword(
        {"orientation"}, orientation(),
        "uniform on the sphere if not given; around a mean with Fisher's constant; or angles with normal distributions");
    entry.keyword({"size"}, sizes(), "law of the diameters; values outside of size-limits are drawn again");
    entry.keyword({"position"},
                  Parts<FractureTemplate>().one_of(text("uniform").spec, "a law of positions", {{"uniform", {}}}),
                  "centres are uniform in the box of fracture generate");
    const auto angle = real("angle").unit("degrees");
    add_limits(entry, "dip-limits", angle, &FractureTemplate::dip_limits,
               "least and greatest dip, 0 and 90 if not given");
    add_limits(entry, "dip-direction-limits", angle, &FractureTemplate::dip_direction_limits,
               "least and greatest dip direction, 0 and 360 if not given");
    add_limits(entry, "size-limits", real("diameter").unit("length").above(0), &FractureTemplate::size_limits,
               "least and greatest diameter, 1 and no limit if not given");
    entry.finish([](const Reader& reader, FractureTemplate& made) {
        if (!made.size)
            incomplete_line(reader, "a template needs a law of sizes", "write: size power-law 3 size-limits 1 50");
    });
    entry.right("fracture template create 'set-1' orientation fisher 30 120 50 size power-law 3 size-limits 2 40");
    entry.right("fracture template create bed orientation gauss 30 5 120 10 dip-limits 10 60 size log-normal 5 2");
    entry.wrong("fracture template create 'a'", "a template needs a law of sizes");
    entry.wrong("fracture template create 'a' size powerlow 3", "'powerlow' is not a law of sizes");
    entry.wrong("fracture template create 'a' orientation fisher 30 120 size uniform",
                "expected a number, found 'size'");
    entry.wrong("fracture template create 'a' size exponential 0", "mean must be greater than 0, not 0");
    return entry;
}

CommandSpec delete_template() {
    Entry<FractureTemplate> entry({Spelling{"fracture", 6}}, {"template"});
    entry.then({"delete"}).help("deletes a template of fractures");
    entry.start([](const Statement& statement, FractureTemplate& command) {
        command.remove = true;
        command.place = statement.words.front().place;
    });
    entry.argument(text("name").help("name of the template"), &FractureTemplate::name);
    entry.right("fracture template delete 'set-1'");
    entry.wrong("fracture template delete", "a word is missing after 'delete'");
    return entry;
}

template <class Command> void add_line(Entry<Command>& entry) {
    entry.keyword(
        {"begin"}, vector("x y z").unit("length"), [](Command & c) -> auto& { return c.line[0]; },
        "of the line of p10");
    entry.keyword(
        {"end"}, vector("x y z").unit("length"), [](Command & c) -> auto& { return c.line[1]; }, "of the line of p10");
}

template <class Command> void check_line(const Reader& reader, const Command& command, bool needed) {
    if (needed && !reader.wildcards() && command.line[0] == command.line[1])
        incomplete_line(reader, "p10 needs a line", "write: begin x y z end x y z");
}

CommandSpec generate_fractures() {
    Entry<FractureGenerate> entry({Spelling{"fracture", 6}}, {"generate"});
    entry.help("draws fractures from a template until there are enough").place(&FractureGenerate::place);
    entry.keyword({"template"}, text("name"), &FractureGenerate::source,
                  "name of the template; the last one if not given");
    entry.keyword({"dfn"}, text("name"), &FractureGenerate::network, "name of the network");
    entry.keyword({"fracture-count"}, integer("n").at_least(1).at_most(1e6), &FractureGenerate::count,
                  "number of fractures");
    entry.keyword({"mass-density", "p32"}, real("p32").unit("1/length").above(0), &FractureGenerate::area,
                  "until the fractures have this area per volume of the box");
    entry.keyword({"p10"}, real("p10").unit("1/length").above(0), &FractureGenerate::crossings,
                  "until a line crosses so many fractures per length");
    add_line(entry);
    add_box(entry, {"generation-box"}, "box of the centres, and of mass-density; that around the model if not given");
    entry.keyword({"seed"}, integer("n").at_least(0).at_most(1e9), &FractureGenerate::seed,
                  "other fractures of the same kind; 1 if not given");
    add_group(entry);
    entry.not_yet({"percolation", "connectivity", "fish-stop", "modify", "tolerance-box"}, "other ends of a network");
    entry.finish([](const Reader& reader, FractureGenerate& command) {
        const int ends = command.count.has_value() + command.area.has_value() + command.crossings.has_value();
        if (ends != 1)
            incomplete_line(reader, ends == 0 ? "nothing says how many fractures are wanted" : "a network has one end",
                            "write one of: fracture-count n, mass-density p32, p10 n begin x y z end x y z");
        check_line(reader, command, command.crossings.has_value());
    });
    entry.right("fracture generate template 'set-1' dfn 'faults' fracture-count 20");
    entry.right("fracture generate mass-density 0.5 generation-box 0 10 0 10 0 10 seed 7");
    entry.right("fracture generate dfn 'faults' p10 2 begin 0 0 0 end 0 0 10");
    entry.wrong("fracture generate template 'a'", "nothing says how many fractures are wanted");
    entry.wrong("fracture generate fracture-count 9 mass-density 1", "a network has one end");
    entry.wrong("fracture generate p10 2", "p10 needs a line");
    entry.wrong("fracture generate fracture-count 0", "fracture-count must be at least 1, not 0");
    return entry;
}

CommandSpec import_fractures() {
    Entry<FractureImport> entry({Spelling{"fracture", 6}}, {"import"});
    entry.help("adds the fractures in a file to a network").place(&FractureImport::place);
    entry.keyword({"from-file"}, text("file").help("lines of numbers"), &FractureImport::file, "name of the file");
    using enum FractureImport::Format;
    const auto format = [](FractureImport::Format which) {
        return Parts<FractureImport>().set(&FractureImport::format, which);
    };
    entry.keyword(
        {"format"},
        Parts<FractureImport>().one_of(
            text("discs|polygons|traces").spec, "a format of fractures",
            {{"discs", format(discs)}, {"polygons", format(polygons)}, {"traces", format(traces)}}),
        "what the lines are: discs, if not given: x, y, z, dip, dip direction and diameter; polygons: corners x, y, z, "
        "with an empty line after each polygon; traces: both ends, and the dip and dip direction if the fracture is not upright");
    entry.keyword({"dfn"}, text("name"), &FractureImport::network, "name of the network");
    add_group(entry);
    entry.not_yet({"from-geometry", "center", "clean", "offset", "make-disk", "make-planar", "truncate"},
                  "changes of fractures that are read");
    entry.finish([](const Reader& reader, FractureImport& command) {
        if (command.file.empty())
            incomplete_line(reader, "a file is missing", "write: fracture import from-file 'name'");
    });
    entry.right("fracture import from-file 'faults.txt' dfn 'faults'");
    entry.right("fracture import from-file 'faults.txt' format discs group main dominance 2");
    entry.wrong("fracture import", "a file is missing");
    entry.wrong("fracture import 'faults.txt'", "expected a keyword of fracture import, found the text 'faults.txt'");
    entry.wrong("fracture import from-file 'a' format fracman", "'fracman' is not a format of fractures");
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
    entry.not_yet({"percolation"}, "ends of clusters on sides of a box: fracture cluster makes groups of clusters");
    entry.finish([](const Reader& reader, FractureMeasure& command) {
        if (command.what == What::list)
            incomplete_line(reader, "nothing says what is measured",
                            "write one of: p10, mass-density, center-density, trace-mass-density");
        check_line(reader, command, command.what == What::crossings);
    });
    entry.right("fracture compute p10 begin 0 0 0 end 0 0 10");
    entry.right("fracture compute mass-density box 0 10 0 10 0 10 dfn 'faults'")
        .right("fracture compute center-density");
    entry.right("fracture compute trace-mass-density 'wall' sizes 0 99").right("fracture compute p20 'wall'");
    entry.wrong("fracture compute", "nothing says what is measured");
    entry.wrong("fracture compute p10 begin 0 0 0", "p10 needs a line");
    entry.wrong("fracture compute p21", "a word is missing after 'p21'");
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
    return {create_fracture(),   delete_fractures(),    copy_fractures(),  truncate_fractures(), group_fractures(),
            cluster_fractures(), make_template(),       delete_template(), generate_fractures(), import_fractures(),
            measure_fractures(), intersect_fractures(), list_fractures()};
}

} // namespace kaya::lang
