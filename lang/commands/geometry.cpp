// Commands that make zones, and commands that select blocks.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>
#include <limits>

namespace kaya::lang {

namespace {

Entry<FaceTriangulation> face_triangulation(std::vector<Spelling> form, FaceTriangulation::Style style) {
    Entry<FaceTriangulation> entry({"facetri"}, std::move(form));
    entry.start([style](const Statement& statement, FaceTriangulation& command) {
        command.style = style;
        command.place = statement.words.front().place;
    });
    entry.range(&FaceTriangulation::range);
    return entry;
}

/// Corners alone are places that are infinitely far apart.
Entry<FaceTriangulation> face_corners() {
    Entry<FaceTriangulation> entry({"facetri"}, {"corners"});
    entry.start([](const Statement& statement, FaceTriangulation& command) {
        command.style = FaceTriangulation::Style::edge;
        command.edge = std::numeric_limits<double>::infinity();
        command.place = statement.words.front().place;
    });
    entry.range(&FaceTriangulation::range);
    return entry;
}

/// All words of a field of edges, or none.
void check_field(const Reader& reader, const GenerateEdge& g) {
    std::string missing;
    const auto need = [&](const char* word, bool there) {
        if (!there) missing += (missing.empty() ? "" : ", ") + std::string(word);
    };
    need("center", g.center.has_value());
    need("edgelength-center", g.at_center.has_value());
    need("edgelength-distance", g.at_distance.has_value());
    need("distance", g.distance.has_value());
    const bool any = g.center || g.at_center || g.at_distance || g.distance;
    if (any && !missing.empty())
        incomplete_line(
            reader, fmt::format("edges that vary with the distance from a place lack {}", missing),
            "write for example: gen edge 2 center 0 0 0 edgelength-center 0.2 edgelength-distance 1 distance 5");
    if (!any && !g.edge)
        incomplete_line(reader, "a number is missing after 'edge'",
                        "expected: edge, a number, greater than 0 [length]");
}

CommandSpec generate_edge() {
    Entry<GenerateEdge> entry({"generate"}, {"edge", "edgelength"});
    entry.help(
        "fills blocks with zones, which makes them deformable: cells in blocks of six faces, tetrahedra in others");
    entry.argument(real("edge").unit("length").above(0).optional().help(
                       "average edge of a zone; with a center, far from it: edgelength-distance if not given"),
                   &GenerateEdge::edge);
    entry.keyword({"center", "centre"}, vector("x y z").unit("length"), &GenerateEdge::center,
                  "edges vary with the distance from this place");
    entry.keyword({Spelling{"edgelength-center", 12}, Spelling{"edgelength-centre", 12}},
                  real("edge").unit("length").above(0), &GenerateEdge::at_center, "edge there");
    entry.keyword({Spelling{"edgelength-distance", 12}}, real("edge").unit("length").above(0),
                  &GenerateEdge::at_distance, "edge at the distance, linearly up to there");
    entry.keyword(
        {"distance"}, real("distance").unit("length").above(0), &GenerateEdge::distance,
        "how far from the center that is; beyond it edges change on at the same rate, a quarter of the way at least");
    entry.range(&GenerateEdge::range).place(&GenerateEdge::place);
    entry.finish([](const Reader& reader, GenerateEdge& g) {
        if (!reader.wildcards()) check_field(reader, g);
    });
    entry.right("gen edge 1").right("gen edge 0.2 range region 1");
    entry.right("gen edge 2 center 0 0 0 edgelength-center 0.2 edgelength-distance 1 distance 5");
    entry.right("gen edge center 0 0 0 edgelength-center 0.2 edgelength-distance 1 distance 5 range region 1");
    entry.wrong("gen", "a word is missing after 'gen'");
    entry.wrong("gen edge", "a number is missing after 'edge'");
    entry.wrong("gen edge 0", "edge must be greater than 0, not 0");
    entry.wrong("gen edge -0.5", "edge must be greater than 0, not -0.5");
    entry.wrong("gen edge wide", "expected a number, found 'wide'");
    entry.wrong("gen egde 1", "'egde' is not a kind of generate");
    entry.wrong("gen edge 1 center 0 0 0", "edges that vary with the distance from a place lack edgelength-center, "
                                           "edgelength-distance, distance");
    entry.wrong("gen edge 1 edgelength-center 0.2 edgelength-distance 1 distance 5",
                "edges that vary with the distance from a place lack center");
    entry.wrong("gen edge 1 center 0 0 0 edgelength-center 0 edgelength-distance 1 distance 5",
                "edge must be greater than 0, not 0");
    entry.wrong("gen edge 1 center 0 0 0 edgelength-center 1 edgelength-distance 1 distance 0",
                "distance must be greater than 0, not 0");
    return entry;
}

CommandSpec generate_quad() {
    Entry<GenerateQuad> entry({"generate"}, {"quad", "hexahedra"});
    entry.help("cuts blocks of six faces with four corners in cells, each of six tetrahedral zones");
    entry.place(&GenerateQuad::place);
    Parts<GenerateQuad> parts, ratios;
    for (std::size_t k = 0; k < 3; ++k) {
        constexpr std::array part{"n1", "n2", "n3"}, ratio{"r1", "r2", "r3"};
        parts.then(
            integer(part[k]).at_least(1).at_most(1000), [k](GenerateQuad & g) -> auto& { return g.parts[k]; });
        ratios.then(
            real(ratio[k]).above(0), [k](GenerateQuad & g) -> auto& { return g.ratio[k]; });
    }
    parts.set(&GenerateQuad::given, true);
    entry.keyword({"ndivisions", "divisions"}, parts, "cells along the block's edges that are nearest to x, y and z");
    entry.keyword(
        {"ratio"}, ratios,
        "length of each cell over that of the one before it, in the direction of growing x, y and z; 1 if not given");
    entry.range(&GenerateQuad::range);
    entry.finish([](const Reader& reader, GenerateQuad& g) {
        if (!g.given)
            incomplete_line(reader, "generate quad does not say how many cells",
                            "write for example: generate quad ndiv 4 4 8");
    });
    entry.right("gen quad ndiv 4 4 8").right("generate quad ndiv 2 2 10 ratio 1 1 1.2 range region 1");
    entry.wrong("gen quad", "generate quad does not say how many cells");
    entry.wrong("gen quad ndiv 4 4", "a number is missing after '4'");
    entry.wrong("gen quad ndiv 4 4 0", "n3 must be at least 1, not 0");
    entry.wrong("gen quad ndiv 4 4 4 ratio 1 1 0", "r3 must be greater than 0, not 0");
    return entry;
}

} // namespace

Family geometry() {
    Family family{
        "geometry",
        "blocks, zones, and what is visible",
        {
            Entry<Hide>({"hide"})
                .help("hides blocks; most commands act on visible blocks only")
                .action(
                    {Spelling{"all", 3}}, [](Hide&) {}, "all blocks, as without a range")
                .range(&Hide::range)
                .right("hide range z 0 .1")
                .right("hide region 1")
                .right("hide all")
                .right("hide")
                .wrong("hide range", "the range is empty")
                .wrong("hide rnge z 0 1", "'rnge' is not a keyword of hide")
                .wrong("hide range z 1 0", "the lower limit 1 is greater than the upper limit 0")
                .wrong("hide range z", "a number is missing after 'z'")
                .wrong("hide range grup a", "'grup' is not a range element"),
            Entry<Seek>({"seek", "show"})
                .help("makes hidden blocks visible again")
                .action(
                    {Spelling{"all", 3}}, [](Seek&) {}, "all blocks, as without a range")
                .range(&Seek::range)
                .right("seek")
                .right("show range group wall")
                .right("show all")
                .right("seek range sphere center 0 0 0 radius 2")
                .wrong("seek range sphere center 0 0 0", "the sphere needs center and radius")
                .wrong("seek range sphere center 0 0", "a number is missing after '0'")
                .wrong("seek range sphere center 0 0 0 radius -1", "radius must be at least 0, not -1")
                .wrong("seek range cyl end1 0 0 0 radius 1", "the cylinder needs end1, end2 and radius"),
            Entry<Delete>({"delete"})
                .help("deletes blocks")
                .range(&Delete::range)
                .right("delete range plane dip 30 dd 90 origin 0 0 5 above")
                .right("delete region 2")
                .right("delete range mat 1 union region 3 not")
                .wrong("delete range plane dip 30", "the plane does not say which part is meant")
                .wrong("delete range not z 0 1", "'not' stands before the element that it negates"),
            Entry<NameRange>({"range"}, {"name", "nrange"})
                .help("gives a range phrase a name, used as: range nrange NAME")
                .argument(text("name").help("name of the range"), &NameRange::name)
                .range(&NameRange::range)
                .finish([](const Reader& reader, NameRange& named) {
                    if (named.range.elements.empty())
                        incomplete_line(reader, "the named range has no element",
                                        "write for example: range name top z 1 2");
                })
                .right("range name top z 0.9 1.1")
                .right("range name both nrange top bottom union")
                .right("range nrange top z 0.9 1.1")
                .wrong("range name top", "the named range has no element")
                .wrong("range z 0 1", "'z' is not a kind of range"),
            Entry<NameRange>({"range"}, {"delete"})
                .help("forgets a named range")
                .start([](const Statement&, NameRange& named) { named.remove = true; })
                .argument(text("name").help("name of the range"), &NameRange::name)
                .right("range delete top")
                .wrong("range delete", "a word is missing after 'delete'"),
            generate_edge(),
            generate_quad(),
            face_triangulation({"edge"}, FaceTriangulation::Style::edge)
                .help("puts sub-contacts on the faces of rigid blocks that far apart, in addition to those at corners")
                .argument(real("edge").unit("length").above(0).help("about how far apart"), &FaceTriangulation::edge)
                .right("facetri edge 0.1")
                .right("facetri edge 0.05 range group wall")
                .wrong("facetri", "a word is missing after 'facetri'")
                .wrong("facetri edge", "a number is missing after 'edge'")
                .wrong("facetri edge 0", "edge must be greater than 0, not 0")
                .wrong("facetri rad9", "'rad9' is not a kind of facetri"),
            face_triangulation({"radial"}, FaceTriangulation::Style::radial)
                .help("cuts the faces of rigid blocks in triangles from their centre to their corners")
                .right("facetri radial")
                .right("facetri radial range z 0 1")
                .wrong("facetri radial now", "'now' is not a keyword of facetri radial"),
            face_triangulation({"rad8", "radial-8"}, FaceTriangulation::Style::radial_8)
                .help(
                    "cuts the faces of rigid blocks in triangles from their centre to their corners and the middles of "
                    "their edges")
                .right("facetri rad8")
                .wrong("facetri rad8 range", "the range is empty"),
            face_corners()
                .help("puts sub-contacts at the corners of the joints of rigid blocks only, as 3DEC does")
                .right("facetri corners")
                .right("facetri corners range group arch")
                .wrong("facetri corners 4", "expected a keyword of facetri corners, found '4'"),
            face_triangulation({"off"}, FaceTriangulation::Style::fan)
                .help("undoes facetri: joints are continuous again")
                .right("facetri off")
                .wrong("facetri off now", "'now' is not a keyword of facetri off"),
        }};
    auto& commands = family.commands;
    auto cuts = cut_commands(), shapes = shape_commands(), selection = selection_commands(),
         surfaces = surface_commands(), fractures = fracture_commands();
    for (const auto& more : {selection, cuts, surfaces, fractures})
        commands.insert(commands.end(), more.begin(), more.end());
    commands.insert(commands.begin(), shapes.begin(), shapes.end());
    return family;
}

} // namespace kaya::lang
