// Networks of fractures: drawn from templates, read from files and written.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/fracture_words.hpp"
#include "lang/commands/language.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

using FromTo = std::array<double, 2>;

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
            made.planes.clear();
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
    const auto measured = law(bootstrapped).then(text("file"), &FractureTemplate::planes);
    return Parts<FractureTemplate>().one_of(
        text("uniform|fisher dip dd kappa|gauss dip deviation dd deviation|bootstrapped file").spec,
        "a law of orientations",
        {{"uniform", law(uniform)}, {"fisher", around_a_mean}, {"gauss", of_angles}, {"bootstrapped", measured}});
}

Parts<FractureTemplate> sizes() {
    using enum FractureTemplate::Size;
    const auto exponent = real("exponent").at_least(0).at_most(20), mean = real("mean").unit("length").above(0),
               deviation = real("deviation").unit("length").at_least(0);
    const auto law = [](FractureTemplate::Size size) {
        return Parts<FractureTemplate>().set([size](FractureTemplate& made) {
            made.size = size;
            made.sizes = {};
            made.diameters.clear();
        });
    };
    const auto one = [&](FractureTemplate::Size size, const Argument<double>& number) {
        return law(size).then(number, size_at(0));
    };
    const auto two = [&](FractureTemplate::Size size) {
        return law(size).then(mean, size_at(0)).then(deviation, size_at(1));
    };
    const auto measured = law(bootstrapped).then(text("file"), &FractureTemplate::diameters);
    return Parts<FractureTemplate>().one_of(
        text("power-law exponent|log-normal mean deviation|gauss mean deviation|exponential mean|uniform|"
             "bootstrapped file")
            .spec,
        "a law of sizes",
        {{"power-law", one(power_law, exponent)},
         {"log-normal", two(log_normal)},
         {"gauss", two(gauss)},
         {"exponential", one(exponential, mean)},
         {"uniform", law(uniform)},
         {"bootstrapped", measured}});
}

void add_limits(Entry<FractureTemplate>& entry, const char* word, const Argument<double>& limit,
                std::optional<FromTo> FractureTemplate::*limits, const char* help) {
    entry.keyword({word},
                  Parts<FractureTemplate>().in(made(limits), Parts<FromTo>()
                                                                 .then(
                                                                     limit, [](FromTo & l) -> auto& { return l[0]; })
                                                                 .then(
                                                                     limit, [](FromTo & l) -> auto& { return l[1]; })),
                  help);
}

void check_order(const std::optional<FromTo>& limits, const char* what) {
    if (limits && (*limits)[0] > (*limits)[1])
        throw Diagnostic(fmt::format("the limits of {} are {:g} and {:g}: the first is the greater one", what,
                                     (*limits)[0], (*limits)[1]),
                         "give the least value first");
}

/// `scatters`: angles of the law are not all the same.
void check_dips(const FromTo& limits, bool scatters) {
    const double low = std::max(limits[0], 0.0), high = std::min(limits[1], 90.0);
    if (low > high)
        throw Diagnostic(
            fmt::format("a dip is 0 to 90 degrees, and its limits are {:g} and {:g}", limits[0], limits[1]),
            "correct dip-limits");
    if (low == high && scatters)
        throw Diagnostic(fmt::format("no fracture is drawn with a dip of exactly {:g}", low),
                         "give dip-limits some width, or orientation gauss with the deviation 0");
}

/// An arc from the first to the second: the first may be the greater one.
void check_directions(const FromTo& limits, bool scatters) {
    const double span = limits[1] - limits[0];
    if (!(span <= 360 && span > -360))
        throw Diagnostic(
            fmt::format("the limits of dip directions, {:g} and {:g}, are not an arc of at most 360 degrees", limits[0],
                        limits[1]),
            "give 0 360 for all directions, or 330 30 for those from 330 across north to 30");
    if (span == 0 && scatters)
        throw Diagnostic(fmt::format("no fracture is drawn with a dip direction of exactly {:g}", limits[0]),
                         "give dip-direction-limits some width, or orientation gauss with the deviation 0");
}

/// Normal distributions of the deviation 0 draw one dip.
void check_one_dip(const FractureTemplate& made) {
    const double dip = made.angles[0];
    const auto [low, high] = *made.dip_limits;
    if (made.angles[1] == 0 && dip >= 0 && dip <= 90 && (dip < low || dip > high))
        throw Diagnostic(
            fmt::format("all fractures have a dip of {:g}, and its limits are {:g} and {:g}", dip, low, high),
            "correct dip-limits, or give the dip a deviation");
}

/// Limits between which nothing can be drawn.
void check_limits(const FractureTemplate& made) {
    using enum FractureTemplate::Orientation;
    check_order(made.size_limits, "sizes");
    check_order(made.dip_limits, "dips");
    const bool measured = made.orientation == bootstrapped, normal = made.orientation == gauss;
    if (made.dip_limits) check_dips(*made.dip_limits, !measured && !(normal && made.angles[1] == 0));
    if (made.dip_limits && normal) check_one_dip(made);
    if (made.dip_direction_limits)
        check_directions(*made.dip_direction_limits, !measured && !(normal && made.angles[3] == 0));
}

CommandSpec make_template() {
    Entry<FractureTemplate> entry({Spelling{"fracture", 6}}, {"template"});
    entry.then({"create"});
    entry.help("names the orientations and sizes from which fractures are drawn").place(&FractureTemplate::place);
    entry.argument(text("name").help("name of the template"), &FractureTemplate::name);
    entry.keyword(
        {"orientation"}, orientation(),
        "uniform on the sphere if not given; around a mean with Fisher's constant; angles with normal distributions; "
        "or planes of a file, drawn with replacement");
    entry.keyword({"size"}, sizes(),
                  "law of the diameters, or a file to draw them from; values outside of size-limits are drawn again");
    entry.keyword({"position"},
                  Parts<FractureTemplate>().one_of(text("uniform").spec, "a law of positions", {{"uniform", {}}}),
                  "centres are uniform in the box of fracture generate");
    const auto angle = real("angle").unit("degrees");
    add_limits(entry, "dip-limits", angle, &FractureTemplate::dip_limits,
               "least and greatest dip, 0 and 90 if not given");
    add_limits(entry, "dip-direction-limits", angle, &FractureTemplate::dip_direction_limits,
               "dip directions from the first clockwise to the second, 0 and 360 if not given; 330 30 crosses north");
    add_limits(entry, "size-limits", real("diameter").unit("length").above(0), &FractureTemplate::size_limits,
               "least and greatest diameter; if not given 1 and no limit, of bootstrapped sizes none");
    entry.finish([](const Reader& reader, FractureTemplate& made) {
        if (!made.size)
            incomplete_line(reader, "a template needs a law of sizes", "write: size power-law 3 size-limits 1 50");
        if (reader.wildcards()) return;
        try {
            check_limits(made);
        } catch (Diagnostic& mistake) { throw mistake.at(made.place); }
    });
    entry.right("fracture template create 'set-1' orientation fisher 30 120 50 size power-law 3 size-limits 2 40");
    entry.right("fracture template create bed orientation gauss 30 5 120 10 dip-limits 10 60 size log-normal 5 2");
    entry.right(
        "fracture template create 'north' orientation fisher 70 0 20 dip-direction-limits 330 30 size uniform size-limits 2 5");
    entry.right("fracture template create wall orientation bootstrapped 'planes.txt' size bootstrapped 'sizes.txt'");
    entry.wrong("fracture template create 'a'", "a template needs a law of sizes");
    entry.wrong("fracture template create 'a' size powerlow 3", "'powerlow' is not a law of sizes");
    entry.wrong("fracture template create 'a' orientation fisher 30 120 size uniform",
                "expected a number, found 'size'");
    entry.wrong("fracture template create 'a' size exponential 0", "mean must be greater than 0, not 0");
    entry.right(
        "fracture template create 'a' orientation gauss 30 0 390 0 dip-limits 30 30 dip-direction-limits 30 30 size uniform size-limits 1 2");
    entry.right("fracture template create 'a' dip-direction-limits -180 180 size uniform size-limits 1 2");
    entry.wrong("fracture template create 'a' size exponential 3 dip-direction-limits 0 400",
                "the limits of dip directions, 0 and 400, are not an arc of at most 360 degrees");
    entry.wrong("fracture template create 'a' size exponential 3 dip-direction-limits 360 0",
                "the limits of dip directions, 360 and 0, are not an arc of at most 360 degrees");
    entry.wrong("fracture template create 'a' orientation uniform size exponential 3 dip-direction-limits 30 30",
                "no fracture is drawn with a dip direction of exactly 30");
    entry.wrong("fracture template create 'a' orientation fisher 30 40 5 size exponential 3 dip-direction-limits 30 30",
                "no fracture is drawn with a dip direction of exactly 30");
    entry.wrong(
        "fracture template create 'a' orientation gauss 30 0 120 5 size exponential 3 dip-direction-limits 30 30",
        "no fracture is drawn with a dip direction of exactly 30");
    entry.wrong("fracture template create 'a' size exponential 3 dip-limits 90 120",
                "no fracture is drawn with a dip of exactly 90");
    entry.wrong("fracture template create 'a' size exponential 3 dip-limits 100 120",
                "a dip is 0 to 90 degrees, and its limits are 100 and 120");
    entry.wrong("fracture template create 'a' size exponential 3 dip-limits -20 -10",
                "a dip is 0 to 90 degrees, and its limits are -20 and -10");
    entry.wrong("fracture template create 'a' orientation gauss 20 0 90 5 size exponential 3 dip-limits 40 50",
                "all fractures have a dip of 20, and its limits are 40 and 50");
    entry.wrong("fracture template create 'a' size exponential 3 dip-limits 60 40",
                "the limits of dips are 60 and 40: the first is the greater one");
    entry.wrong("fracture template create 'a' size exponential 3 size-limits 6 5",
                "the limits of sizes are 6 and 5: the first is the greater one");
    entry.wrong("fracture template create 'a' size bootstrapped", "a word is missing after 'bootstrapped'");
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
    entry.keyword({"percolation"}, real("p").above(0), &FractureGenerate::percolation,
                  "until the sum of pi^2 r^3 over the volume of the box is p");
    add_line(entry);
    add_box(entry, {"generation-box"},
            "box of the centres, of mass-density and of percolation; that around the model if not given");
    entry.keyword({"seed"}, integer("n").at_least(0).at_most(1e9), &FractureGenerate::seed,
                  "other fractures of the same kind; 1 if not given");
    add_group(entry);
    entry.not_yet({"connectivity", "fish-stop", "modify", "tolerance-box"}, "other ends of a network");
    entry.finish([](const Reader& reader, FractureGenerate& command) {
        const int ends = command.count.has_value() + command.area.has_value() + command.crossings.has_value() +
                         command.percolation.has_value();
        if (ends != 1)
            incomplete_line(
                reader, ends == 0 ? "nothing says how many fractures are wanted" : "a network has one end",
                "write one of: fracture-count n, mass-density p32, percolation p, p10 n begin x y z end x y z");
        check_line(reader, command, command.crossings.has_value());
    });
    entry.right("fracture generate template 'set-1' dfn 'faults' fracture-count 20");
    entry.right("fracture generate mass-density 0.5 generation-box 0 10 0 10 0 10 seed 7");
    entry.right("fracture generate dfn 'faults' p10 2 begin 0 0 0 end 0 0 10");
    entry.right("fracture generate percolation 2.5 generation-box 0 20 0 20 0 20");
    entry.wrong("fracture generate template 'a'", "nothing says how many fractures are wanted");
    entry.wrong("fracture generate fracture-count 9 mass-density 1", "a network has one end");
    entry.wrong("fracture generate percolation 1 mass-density 1", "a network has one end");
    entry.wrong("fracture generate p10 2", "p10 needs a line");
    entry.wrong("fracture generate fracture-count 0", "fracture-count must be at least 1, not 0");
    return entry;
}

struct FormatWord {
    std::string_view word;
    FractureLines format;
};
template <class Command>
void add_format(Entry<Command>& entry, const std::vector<FormatWord>& formats, const char* help) {
    std::vector<typename Parts<Command>::Choice> choices;
    static constexpr bool reads = std::is_same_v<Command, FractureImport>;
    for (const FormatWord& format : formats)
        choices.push_back({format.word, Parts<Command>().set(&Command::format, format.format)});
    const auto words = text(reads ? "discs|polygons|traces|fracman" : "discs|polygons|fracman").spec;
    entry.keyword({"format"}, Parts<Command>().one_of(words, "a format of fractures", std::move(choices)), help);
}

CommandSpec import_fractures() {
    Entry<FractureImport> entry({Spelling{"fracture", 6}}, {"import"});
    entry.help("adds the fractures in a file to a network").place(&FractureImport::place);
    entry.keyword({"from-file"}, text("file").help("lines of numbers"), &FractureImport::file, "name of the file");
    add_format<FractureImport>(
        entry,
        {{"discs", FractureLines::discs},
         {"polygons", FractureLines::polygons},
         {"traces", FractureLines::traces},
         {"fracman", FractureLines::fracman}},
        "what the lines are: discs, if not given: x, y, z, dip, dip direction and diameter; polygons: corners x, y, z, "
        "with an empty line after each polygon; traces: both ends, and the dip and dip direction if the fracture is not "
        "upright; fracman: text with the suffix .fab, whose sets become groups of the slot set");
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
    entry.wrong("fracture import from-file 'a' format rockmass", "'rockmass' is not a format of fractures");
    return entry;
}

CommandSpec export_fractures() {
    Entry<FractureExport> entry({Spelling{"fracture", 6}}, {"export"});
    entry.help("writes fractures to a text file that import reads").place(&FractureExport::place);
    entry.keyword({"file"}, text("file"), &FractureExport::file, "name of the file");
    add_format<FractureExport>(
        entry,
        {{"discs", FractureLines::discs}, {"polygons", FractureLines::polygons}, {"fracman", FractureLines::fracman}},
        "discs, if not given; polygons and fracman: corners, of discs those of a polygon");
    entry.keyword({"sides"}, integer("n").at_least(3).at_most(64), &FractureExport::sides,
                  "of the regular polygon, equal in area, that is written for a disc; 12 if not given");
    add_choice(entry);
    entry.not_yet({"property-file", "template-file", "intersect-with-plane"}, "other files of networks");
    entry.finish([](const Reader& reader, FractureExport& command) {
        if (command.file.empty()) incomplete_line(reader, "a file is missing", "write: fracture export file 'name'");
    });
    entry.right("fracture export file 'new.txt'").right("fracture export file 'new.txt' format polygons dfn 'faults'");
    entry.right("fracture export file 'new.fab' format fracman sides 32 sizes 0 9");
    entry.wrong("fracture export", "a file is missing");
    entry.wrong("fracture export file 'a' format traces", "'traces' is not a format of fractures");
    return entry;
}

} // namespace

std::vector<CommandSpec> network_commands() {
    return {make_template(), delete_template(), generate_fractures(), import_fractures(), export_fractures()};
}

} // namespace kaya::lang
