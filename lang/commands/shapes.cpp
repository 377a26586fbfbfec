// poly: commands that make blocks of a shape.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// Options of every kind of poly.
template <class Poly> void block_options(Entry<Poly>& entry) {
    const auto options = [](std::int64_t BlockOptions::*member) {
        return [member](Poly & poly) -> auto& { return poly.options.*member; };
    };
    entry.keyword({"region"}, integer("n").at_least(0), options(&BlockOptions::region),
                  "region number, 0 if not given");
    entry.keyword({"material", "mat"}, integer("n").at_least(1), options(&BlockOptions::material),
                  "material number, 1 if not given");
    entry.keyword({"constitutive", "cons"}, integer("n").at_least(1), options(&BlockOptions::constitutive),
                  "constitutive number, 1 if not given");
    entry.keyword(
        {"group"}, text("name"), [](Poly & poly) -> auto& { return poly.options.group; }, "group of the block");
    entry.options_before_form();
    entry.place(&Poly::place);
}

Argument<Vec3> corners(std::string_view help) { return vector("x y z ...").unit("length").help(help); }

CommandSpec poly_brick() {
    Entry<PolyBrick> entry({"poly"}, {"brick"});
    entry.help("makes a block with six faces along the axes");
    entry.argument(pair("x1 x2").unit("length").help("limits in x"),
                   Through{[](PolyBrick& brick, std::array<double, 2> x) { brick.x = brick.y = brick.z = x; },
                           [](const PolyBrick& brick) { return std::optional(brick.x); }});
    entry.argument(pair("y1 y2").unit("length").optional().help("limits in y; those of x if not given"), &PolyBrick::y);
    entry.argument(pair("z1 z2").unit("length").optional().help("limits in z; those of x if not given"), &PolyBrick::z);
    block_options(entry);
    entry.finish([](const Reader& reader, PolyBrick& brick) {
        if (reader.wildcards()) return;
        const auto check = [&](const char* axis, const std::array<double, 2>& limits) {
            if (limits[0] < limits[1]) return;
            Diagnostic d(fmt::format("the brick has no extent in {}: from {:g} to {:g}", axis, limits[0], limits[1]),
                         "the lower limit comes first and must be less than the upper one");
            throw d.at(brick.place);
        };
        check("x", brick.x);
        check("y", brick.y);
        check("z", brick.z);
    });
    entry.right("poly brick 0,1 0,1 0,1").right("poly brick -0.15,0.15 -0.10,0.10 -0.10,0.0");
    entry.right("poly brick (0,2)")
        .right("poly region 3 brick 0 1 0 1 0 1")
        .right("poly brick 0 1 0 1 0 1 group 'left wall'")
        .right("poly brick 0 1 0 1 0 1 mat=2 cons 1 reg 5");
    entry.wrong("poly", "a word is missing after 'poly'");
    entry.wrong("poly brik 0,1 0,1 0,1", "'brik' is not a kind of poly");
    entry.wrong("poly brick", "a number is missing after 'brick'");
    entry.wrong("poly brick 0 1 0 1 0", "a number is missing after '0'");
    entry.wrong("poly brick 0 one", "expected a number, found 'one'");
    entry.wrong("poly brick 1 0", "the brick has no extent in x: from 1 to 0");
    entry.wrong("poly brick 0 1 0 1 0 1 0 1", "expected a keyword of poly brick, found '0'");
    entry.wrong("poly brick 0 1 regoin 2", "'regoin' is not a keyword of poly brick");
    return entry;
}

CommandSpec poly_prism() {
    Entry<PolyPrism> entry({"poly"}, {"prism"});
    entry.help("joins two polygons with matching corners side by side; sides may be warped");
    const auto polygon = [&](std::vector<Spelling> words, std::vector<Vec3> PolyPrism::*member, std::string_view help) {
        entry.keyword(std::move(words), Parts<PolyPrism>().each(corners(help), member), help);
    };
    polygon({"a", "face1", "face-1"}, &PolyPrism::first, "corners of the first polygon, in order around it");
    polygon({"b", "face2", "face-2"}, &PolyPrism::second, "corners of the second, each opposite its partner");
    block_options(entry);
    entry.finish([](const Reader& reader, PolyPrism& prism) {
        if (prism.first.empty() || prism.second.empty())
            incomplete_line(reader, "a prism needs two polygons",
                            "write the corners of each in order: x y z  x y z  x y z ...");
    });
    entry.right("poly prism a 0,0,0 1,0,0 1,1,0 b 0,0,1 1,0,1 1,1,1");
    entry.right("poly region 2 prism a (0,0,0) (4,0,0) (4,1,0) (0,1,0) b (0,0,2) (4,0,2.2) (4,1,2.2) (0,1,2)");
    entry.right("poly prism a @v1 @v2 @v3 b @w1 @w2 @w3");
    entry.wrong("poly prism a 0 0 0 1 0 0 1 1 0", "a prism needs two polygons");
    entry.wrong("poly prism a 0 0 0 1 0 0 1 1 b 0 0 1", "expected a number, found 'b'");
    entry.wrong("poly prism 0 0 0 1 0 0", "expected a keyword of poly prism, found '0'");
    return entry;
}

CommandSpec poly_face() {
    Entry<PolyFace> entry({"poly"}, {"face"});
    entry.help("makes any polyhedron from its faces");
    const auto corner = corners("corners of a face, in order around it");
    block_options(entry);
    // The word of the form opens the first face, the same word as a keyword each further one.
    entry.start([](const Statement& statement, PolyFace& poly) {
        poly.place = statement.words.front().place;
        poly.faces.resize(1);
    });
    using Face = PolyFace::Face;
    const auto last = last_of(&PolyFace::faces);
    auto next = next_of(&PolyFace::faces);
    next.wanted = [last, after = next.wanted](const PolyFace& wanted, const PolyFace& present) -> const Face* {
        const Face* before = last.wanted(wanted, present);
        const bool complete = before == nullptr || before->joint_set == present.faces.back().joint_set;
        return complete ? after(wanted, present) : nullptr; // `id` belongs to the last face
    };
    entry.keyword({"face"}, Parts<PolyFace>().in(next, Parts<Face>().each(corner, &Face::corners, 0)), "the next face");
    entry.keyword({"id"},
                  Parts<PolyFace>()
                      .in(last, Parts<Face>().then(integer("k").at_least(0), &Face::joint_set))
                      .check([corner](Reader& reader, PolyFace& poly) {
                          while (reader.at_number()) poly.faces.back().corners.push_back(reader.vector(corner.spec));
                      }),
                  "joint set that made the face, 0 if not given; stands before the corners");
    entry.values(
        Parts<PolyFace>().in(last, Parts<Face>().each(corner, &Face::corners)),
        [](Reader& reader, PolyFace& poly) { return reader.at_number() && poly.faces.back().corners.empty(); });
    entry.finish([](const Reader& reader, PolyFace& poly) {
        if (poly.faces.size() < 4)
            incomplete_line(reader,
                            fmt::format("{} face{} do{} not close a polyhedron", poly.faces.size(),
                                        poly.faces.size() == 1 ? "" : "s", poly.faces.size() == 1 ? "es" : ""),
                            "it takes at least four, each with its corners: face x y z  x y z  x y z ...");
        if (reader.wildcards()) return;
        for (std::size_t f = 0; f < poly.faces.size(); ++f)
            if (poly.faces[f].corners.size() < 3)
                throw Diagnostic(fmt::format("face {} has {} corner{}", f + 1, poly.faces[f].corners.size(),
                                             poly.faces[f].corners.size() == 1 ? "" : "s"),
                                 "a face needs at least three")
                    .at(poly.place);
    });
    entry.right("poly face 0 0 0  1 0 0  0 1 0  face 0 0 0  0 0 1  1 0 0 &\n"
                "     face 0 0 0  0 1 0  0 0 1  face 1 0 0  0 0 1  0 1 0");
    entry.right("poly reg 1 face id 3 0,0,0 1,0,0 0,1,0 face id 3 0,0,0 0,0,1 1,0,0 &\n"
                "     face 0,0,0 0,1,0 0,0,1 face 1,0,0 0,0,1 0,1,0 mat 2");
    entry.wrong("poly face 0 0 0 1 0 0 0 1 0", "1 face does not close a polyhedron");
    entry.wrong("poly face 0 0 0 1 0 face 1 0 0", "expected a number, found 'face'");
    entry.wrong("poly face 0 0 0 face 0 0 0 face 0 0 0 face 1 1 1", "face 1 has 1 corner");
    entry.wrong("poly face 0 0 0 1 0 0 0 1 0 fcae 0 0 0", "'fcae' is not a keyword of poly face");
    return entry;
}

CommandSpec poly_tet() {
    Entry<PolyTet> entry({"poly"}, {"tet", "tetrahedron"});
    entry.help("makes a tetrahedron from its four corners, in any order");
    const auto corner = Parts<PolyTet>().next(vector("x y z").unit("length").help("a corner"), &PolyTet::corners);
    entry.values(corner, [](Reader& reader, PolyTet& tet) { return reader.at_number() && tet.corners.size() < 4; },
                 {vector("x1 y1 z1 ... x4 y4 z4").unit("length").spec});
    for (const char* word : {"a", "b", "c", "d"}) entry.keyword({word}, corner, "the same");
    block_options(entry);
    entry.finish([](const Reader& reader, PolyTet& tet) {
        if (!reader.wildcards() && tet.corners.size() != 4)
            incomplete_line(reader, fmt::format("a tetrahedron has four corners, and {} are given", tet.corners.size()),
                            "write: x1 y1 z1 x2 y2 z2 x3 y3 z3 x4 y4 z4");
    });
    entry.right("poly tet 0,0,0 1,0,0 0,1,0 0,0,1").right("poly region 4 tet @a @b @c @d");
    entry.right("poly tet a 0,0,0 b 1,0,0 c 0,1,0 d 0,0,1");
    entry.wrong("poly tet 0 0 0 1 0 0 0 1 0", "a tetrahedron has four corners, and 3 are given");
    entry.wrong("poly tet 0 0 0 1 0 0 0 1 0 0 0 1 1 1 1", "expected a keyword of poly tet, found '1'");
    return entry;
}

CommandSpec poly_cube() {
    Entry<PolyCube> entry({"poly"}, {"cube"});
    entry.help("makes a cube with its faces along the axes");
    entry.argument(real("edge").unit("length").above(0).help("length of its edges"), &PolyCube::edge);
    entry.keyword({"center", "centre"}, vector("x y z").unit("length"), &PolyCube::centre,
                  "its centre, the origin if not given");
    block_options(entry);
    entry.right("poly cube 2").right("poly cube 0.5 center 1,0,0.25 region 3");
    entry.wrong("poly cube", "a number is missing after 'cube'");
    entry.wrong("poly cube 0", "edge must be greater than 0, not 0");
    return entry;
}

CommandSpec poly_drum() {
    Entry<PolyDrum> entry({"poly"}, {"drum"});
    entry.help("makes a round column with flat sides, or a cone");
    entry.keyword({"end1", "end-1", "center1", "center-1", "a"}, vector("x y z").unit("length"), &PolyDrum::end1,
                  "centre of one end");
    entry.keyword({"end2", "end-2", "center2", "center-2", "b"}, vector("x y z").unit("length"), &PolyDrum::end2,
                  "centre of the other");
    const auto radius1 = real("radius1").unit("length").at_least(0);
    const auto radius2 = real("radius2").unit("length").at_least(0).optional();
    const auto first = [](const PolyDrum& drum) { return drum.radius1; };
    entry.keyword({"radius"},
                  Parts<PolyDrum>()
                      .then(radius1, Through{[](PolyDrum& drum, double r) { drum.radius1 = drum.radius2 = r; }, first})
                      .maybe(radius2, &PolyDrum::radius2),
                  "of both ends, or of each; 0 makes a cone");
    entry.keyword({"radius1", "radius-1"}, radius1,
                  Through{[](PolyDrum& drum, double r) {
                              drum.radius1 = r;
                              if (!drum.radius2) drum.radius2 = r;
                          },
                          first},
                  "of the first end");
    entry.keyword({"radius2", "radius-2"}, real("radius2").unit("length").at_least(0), &PolyDrum::radius2,
                  "of the other");
    const auto edges = integer("n").at_least(3).at_most(10000);
    entry.keyword({"edges", "sides"}, edges, &PolyDrum::sides, "flat sides, 8 if not given");
    // Without words: both ends, both radii, the number of sides.
    const auto end = vector("x y z").unit("length").spec;
    entry.otherwise({vector("x1 y1 z1").unit("length").spec, vector("x2 y2 z2").unit("length").spec, radius1.spec,
                     radius2.spec, integer("n").optional().spec},
                    [=](Reader& reader, PolyDrum& drum) {
                        if (!reader.at_number() || drum.radius1) return false;
                        if (!drum.end1) return drum.end1 = reader.vector(end), true;
                        if (!drum.end2) return drum.end2 = reader.vector(end), true;
                        drum.radius1 = drum.radius2 = reader.real(radius1.spec);
                        if (reader.at_number()) drum.radius2 = reader.real(radius2.spec);
                        if (reader.at_number()) drum.sides = reader.integer(edges.spec);
                        return true;
                    });
    block_options(entry);
    entry.finish([](const Reader& reader, PolyDrum& drum) {
        if (!drum.end1 || !drum.end2 || !drum.radius1)
            incomplete_line(reader, "a drum needs both ends and a radius",
                            "give the centres of its ends, x y z each, and r");
    });
    entry.right("poly drum end1 0,0,0 end2 0,0,3 radius 0.5");
    entry.right("poly drum end1 0 0 0 end2 0 0 1 radius 0.5 0.4 edges 12 region 2");
    entry.right("poly drum (0,0,0) (0,0,1) 0.5 0.45 12 reg 2")
        .right("poly drum center-1 0 0 0 center-2 0 0 1 radius-1 0.5");
    entry.wrong("poly drum end1 0 0 0 radius 1", "a drum needs both ends and a radius");
    entry.wrong("poly drum edges 2", "edges must be at least 3, not 2");
    entry.wrong("poly drum raduis 1", "'raduis' is not a keyword of poly drum");
    return entry;
}

CommandSpec poly_tunnel() {
    Entry<PolyTunnel> entry({"poly"}, {"tunnel"});
    entry.help("makes rings of blocks around a round hole, within a square outline");
    entry.keyword({"dip"}, real("dip").unit("degrees"), &PolyTunnel::dip, "of the axis, 0 if not given");
    entry.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &PolyTunnel::dip_direction,
                  "direction of the axis, clockwise from +y seen from above");
    entry.keyword({"origin", "org"}, vector("x y z").unit("length"), &PolyTunnel::origin, "a point of the axis");
    entry.keyword({"radius"}, real("r").unit("length").above(0), &PolyTunnel::radius, "of the hole, 1 if not given");
    entry.keyword({"length"}, pair("begin end").unit("length"), &PolyTunnel::length,
                  "along the axis from the origin, -10 10 if not given");
    const auto blocks = [&](const char* word, std::int64_t PolyTunnel::*member, std::string_view help) {
        entry.keyword({word}, integer("n").at_least(1).at_most(10000), member, help);
    };
    blocks("radial", &PolyTunnel::radial, "blocks from the wall to the outline, 1 if not given");
    blocks("tangential", &PolyTunnel::tangential, "blocks in each 45 degrees, 1 if not given");
    blocks("axial", &PolyTunnel::axial, "blocks along the axis, 1 if not given");
    entry.keyword({"boundary"}, real("b").above(0), &PolyTunnel::boundary,
                  "from the wall to the outline in radii, 4 if not given");
    entry.keyword({"ratio"}, real("ratio").above(0), &PolyTunnel::ratio,
                  "thickness of each ring over that of the ring inside it, 1 if not given");
    Keywords<PolyTunnel> cores;
    cores.action(
        {"off"}, [](PolyTunnel& tunnel) { tunnel.core = false; }, "the hole stays empty");
    cores.keyword({"region"}, integer("n").at_least(0), &PolyTunnel::core_region,
                  "region number of the core, that of the rings if not given");
    cores.keyword({"group"}, text("name"), &PolyTunnel::core_group, "group of the core");
    entry.keyword({"core"},
                  Parts<PolyTunnel>().one_of(std::move(cores).list(),
                                             {.name = "off, region or group", .kind = ArgumentKind::text},
                                             "a word of the core", {"off", "region", "group"}),
                  "the rock in the hole, one block for each along the axis");
    block_options(entry);
    entry.right("poly tunnel").right("poly tunnel radius 2 length 0 5 radial 4 tangential 2 axial 3 ratio 1.5");
    entry.right("poly region 1 tunnel dip 10 dd 90 org 0 0 -20 radius 3 boundary 6").right("poly tunnel core off");
    entry.right("poly tunnel radius 2 core region 2 core group excavation");
    entry.wrong("poly tunnel core", "a word is missing after 'core'");
    entry.wrong("poly tunnel core rgion 2", "'rgion' is not a word of the core");
    entry.wrong("poly tunnel radius 0", "radius must be greater than 0, not 0");
    entry.wrong("poly tunnel radial 0", "radial must be at least 1, not 0");
    entry.wrong("poly tunnel length 5", "a number is missing after '5'");
    return entry;
}

CommandSpec import_file() {
    Entry<Import> entry({"import"});
    entry.help("makes blocks of the closed surfaces, cells or zones in a file");
    entry.argument(text("file").help("name with suffix, which selects the format"), &Import::file);
    const auto options = [](std::int64_t BlockOptions::*member) {
        return [member](Import & command) -> auto& { return command.options.*member; };
    };
    entry.keyword({"region"}, integer("n").at_least(0), options(&BlockOptions::region),
                  "region number of blocks to which the file gives none");
    entry.keyword({"material", "mat"}, integer("n").at_least(1), options(&BlockOptions::material),
                  "material number of blocks to which the file gives none, 1 if not given");
    entry.keyword({"constitutive", "cons"}, integer("n").at_least(1), options(&BlockOptions::constitutive),
                  "constitutive number, 1 if not given");
    entry.action(
        {"skip"}, [](Import& command) { command.stop = false; },
        "leaves out bodies that are wrong, with a warning each");
    entry.action(
        {"stop"}, [](Import& command) { command.stop = true; }, "makes no block if a body is wrong");
    entry.keyword({"mend"}, real("d").unit("length").above(0), &Import::mend,
                  "joins corners, and corners and edges, nearer than this; drops narrower faces");
    entry.keyword({"holes"}, real("d").unit("length").above(0), &Import::holes,
                  "closes holes of surfaces that are no wider than this");
    entry.keyword({"simplify"}, integer("n").at_least(4), &Import::simplify,
                  "reduces surfaces of more triangles to this number");
    entry.keyword({"deviation"}, real("d").unit("length").above(0), &Import::deviation,
                  "reduces the triangles of surfaces as long as they move no farther than this");
    entry.keyword({"convex"}, integer("n").at_least(1), &Import::convex,
                  "replaces concave bodies by this number of convex parts, which enclose them");
    entry.keyword({"scale"}, real("s").above(0), &Import::scale, "factor of all coordinates, 0.001 for millimetres");
    Keywords<Import> axes;
    axes.action(
        {"x"}, [](Import& command) { command.up = 'x'; }, "x, y and z of the file become z, x and y");
    axes.action(
        {"y"}, [](Import& command) { command.up = 'y'; }, "y of the file becomes z, and z becomes -y");
    axes.action(
        {"z"}, [](Import& command) { command.up = 'z'; }, "as it is");
    entry.keyword({"up"},
                  Parts<Import>().one_of(std::move(axes).list(), {.name = "x, y or z", .kind = ArgumentKind::text},
                                         "an axis", {"x", "y", "z"}),
                  "axis of the file that points up, z if not given");
    entry.place(&Import::place);
    entry.right("import 'vault.stl'")
        .right("import wall.3dgrid mat 2")
        .right("import stones.obj region 3")
        .right("import rock.msh")
        .right("import rock.vtu")
        .right("import dome.obj scale 0.001 up y stop")
        .right("import scan.ply mend 0.002 holes 0.5")
        .right("import scan.ply simplify 500 deviation 0.01")
        .right("import stones.obj convex 3");
    entry.wrong("import", "a word is missing after 'import'");
    entry.wrong("import a.stl regoin 2", "'regoin' is not a keyword of import");
    entry.wrong("import a.stl mend 0", "mend must be greater than 0, not 0");
    entry.wrong("import a.stl simplify 3", "simplify must be at least 4, not 3");
    entry.wrong("import a.stl convex 0", "convex must be at least 1, not 0");
    entry.wrong("import a.stl deviation 0", "deviation must be greater than 0, not 0");
    entry.wrong("import a.stl up w", "'w' is not an axis");
    return entry;
}

CommandSpec export_file() {
    Entry<Export> entry({"export"});
    entry.help("writes visible blocks, their zones or their surfaces to a file");
    entry.argument(text("file").help("name with suffix, which selects the format"), &Export::file);
    entry.range(&Export::range);
    entry.place(&Export::place);
    entry.right("export wall.3dgrid").right("export 'left half.3dgrid' range x 0 5");
    entry.right("export wall.stl").right("export wall.vtu range region 2");
    entry.wrong("export", "a word is missing after 'export'");
    return entry;
}

} // namespace

std::vector<CommandSpec> shape_commands() {
    return {poly_brick(), poly_prism(),  poly_face(),   poly_tet(),   poly_cube(),
            poly_drum(),  poly_tunnel(), import_file(), export_file()};
}

} // namespace kaya::lang
