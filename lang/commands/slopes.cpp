// limit equilibrium: slip surfaces through a section of the model.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <utility>

namespace kaya::lang {

namespace {

using Limit = LimitEquilibrium;

void add_methods(Entry<Limit>& entry) {
    using enum Limit::Method;
    const auto method = [&](const char* word, Limit::Method which, std::string_view help) {
        entry.action(
            {word}, [which](Limit& c) { c.methods.push_back(which); }, help);
    };
    method("ordinary", ordinary, "slices without forces between them (Fellenius); circles only");
    method("bishop", bishop, "simplified Bishop; circles only");
    method("janbu", janbu, "simplified Janbu with its correction");
    method("spencer", spencer, "Spencer: all forces and moments, parallel forces between slices");
    method("morgenstern-price", morgenstern_price,
           "Morgenstern and Price, half-sine inclination of the forces between slices");
}

void add_surfaces(Entry<Limit>& entry) {
    entry.keyword({"circle"}, vector("s z r").unit("length"), &Limit::circle,
                  "this circle: distance and height of its centre, radius");
    using Point = std::array<double, 2>;
    const auto point = Parts<Point>()
                           .then(
                               real("s").unit("length"), [](Point & p) -> auto& { return p[0]; })
                           .then(
                               real("z").unit("length"), [](Point & p) -> auto& { return p[1]; });
    entry.keyword({"surface"}, Parts<Limit>().each_of(&Limit::surface, point),
                  "this polyline: pairs of distance and height; both ends on the ground");
    entry.action(
        {"circles"}, [](Limit& c) { c.search = Limit::Surfaces::circles; },
        "searches the weakest circle, as when no surface is given");
    entry.action(
        {"polylines"}, [](Limit& c) { c.search = Limit::Surfaces::polylines; }, "searches the weakest polyline");
    entry.keyword({"entry"}, pair("s1 s2").unit("length"), &Limit::entry,
                  "where the upper end of a searched surface may lie");
    entry.keyword({"exit"}, pair("s1 s2").unit("length"), &Limit::exit, "where its lower end may lie");
    entry.keyword({"depth"}, real("d").unit("length").at_least(0), &Limit::least_depth,
                  "least depth of a surface below the ground");
    entry.keyword({"corners"}, integer("n").at_least(3).at_most(40), &Limit::corners,
                  "corners that a searched polyline may have; 8 if not given");
}

CommandSpec limit() {
    Entry<Limit> entry({"limit"}, {"equilibrium"});
    entry.help("factors of safety of slip surfaces through a section of the model, by the method of slices");
    entry.place(&Limit::place);
    entry.keyword({"section", "origin"}, vector("x y z").unit("length"), &Limit::origin,
                  "a point of the section; the centre of the model if not given");
    entry.keyword({"direction"}, vector("dx dy dz"), &Limit::direction,
                  "horizontal direction in which distances along the section grow; 1 0 0 if not given");
    add_methods(entry);
    add_surfaces(entry);
    entry.keyword({"slices"}, integer("n").at_least(5).at_most(10000), &Limit::slices,
                  "number of slices; 50 if not given");
    entry.keyword({"crack"}, real("d").unit("length").at_least(0), &Limit::crack,
                  "depth of a tension crack, in which a surface ends");
    entry.keyword({"crack-water"}, real("h").unit("length").at_least(0), &Limit::crack_water,
                  "height of the water in the crack");
    entry.keyword({"seismic"}, real("k"), &Limit::seismic,
                  "horizontal acceleration over gravity, in the direction of sliding");
    entry.keyword({"ru"}, real("r").at_least(0).below(1), &Limit::pressure_ratio,
                  "pore pressure on the surface over the weight above it");
    entry.keyword({"water-table"}, integer("n").at_least(0), &Limit::water_table,
                  "table with the height of the water over the distance; else the water of the model");
    entry.keyword({"table"}, integer("n").at_least(0), &Limit::table,
                  "table that gets the surface: height over distance");
    entry.keyword({"file"}, text("file"), &Limit::file, "a picture of the section with its slip surface: .png or .svg");
    entry.finish([](const Reader& reader, Limit& c) {
        if (c.circle && !c.surface.empty())
            incomplete_line(reader, "circle and surface exclude each other", "write two commands");
        if (c.surface.size() == 1)
            incomplete_line(reader, "a surface needs two points or more",
                            "write for example: limit equilibrium surface 0 10 15 2 30 0");
        if ((c.circle || !c.surface.empty()) && (c.entry || c.exit))
            incomplete_line(reader, "entry and exit belong to a search", "leave circle or surface out");
        if (reader.wildcards()) return;
        if (c.circle && !((*c.circle)[2] > 0))
            incomplete_line(reader, "the radius must be greater than 0", "the numbers are: distance, height, radius");
        if (c.crack_water > c.crack)
            incomplete_line(reader, "the water in the crack is higher than the crack", "give the depth: crack d");
        for (std::size_t i = 1; i < c.surface.size(); ++i)
            if (!(c.surface[i][0] > c.surface[i - 1][0]))
                incomplete_line(reader, "the distances of a surface must grow from point to point",
                                "give its points in order along the section");
    });
    entry.right("limit equilibrium")
        .right("limit equilibrium bishop circle 29.6 53.5 28.5")
        .right("limit eq spencer polylines entry 50 70 exit 20 32");
    entry.right("limit equilibrium section 0 0.5 0 direction -1 0 0 crack 1 crack-water 1 seismic 0.1 slices 100");
    entry.right("limit equilibrium surface 30 25 42 27 55 35 ru 0.25 table 7 file 'section.svg'");
    entry.wrong("limit", "a word is missing after 'limit'");
    entry.wrong("limit equilibrium circle 1 2", "a number is missing after '2'");
    entry.wrong("limit equilibrium surface 0 10", "a surface needs two points or more");
    entry.wrong("limit equilibrium surface 0 10 0 5", "the distances of a surface must grow from point to point");
    entry.wrong("limit equilibrium circle 0 10 0", "the radius must be greater than 0");
    entry.wrong("limit equilibrium bishp", "'bishp' is not a keyword of limit equilibrium");
    entry.wrong("limit equilibrium crack-water 2", "the water in the crack is higher than the crack");
    return entry;
}

} // namespace

Family slopes() { return {"slopes", "limit equilibrium of slopes", {limit()}}; }

} // namespace kaya::lang
