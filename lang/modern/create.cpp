// block create, block cut, block densify, block generate: making blocks.
#include "lang/commands/slots.hpp"
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya::lang {

namespace {

/// The group of the new block, before or after its shape.
template <class Poly> void group_option(Leaf<Poly>& leaf) {
    const auto name = [](Poly & poly) -> auto& { return poly.options.group; };
    const auto slot = [name](Reader& reader, Poly& poly) { read_keywords(reader, slot_words(), &name(poly)); };
    leaf.keyword({"group"}, Parts<Poly>().then(text("name"), name).check(slot).described(slot_words()),
                 "group of the new blocks");
    leaf.options_before_form();
}

CommandSpec create_brick() {
    Leaf<PolyBrick> leaf("block create brick", "poly brick");
    leaf.arguments_of_meaning().checks_of_meaning();
    group_option(leaf);
    leaf.right("block create brick 10 11 10 11 10 11", "poly brick 10 11 10 11 10 11");
    leaf.right("block create brick 10,12", "poly brick 10 12");
    leaf.right("bl cr br (10,12) (10,13) (10,14) group 'BOT'", "poly brick 10 12 10 13 10 14 group BOT");
    leaf.right("block create group 'a wall' brick 10 11", "poly brick 10 11 group 'a wall'");
    leaf.wrong("block create brik 0 1", "'brik' is not a kind of block create");
    leaf.wrong("block create brick", "a number is missing after 'brick'");
    leaf.wrong("block create brick 1 0", "the brick has no extent in x: from 1 to 0");
    leaf.wrong("block create brick 0 1 gruop 'a'", "'gruop' is not a keyword of block create brick");
    leaf.wrong("block create", "a word is missing after 'create'");
    return leaf;
}

CommandSpec create_prism() {
    Leaf<PolyPrism> leaf("block create prism", "poly prism");
    leaf.word("face-1", "a").word("face-2", "b").checks_of_meaning();
    leaf.no_effect_switch("nonplanar", "accepted, without effect");
    leaf.not_yet({"table-1", "table-2", "axis"}, "polygons in tables");
    group_option(leaf);
    leaf.right("block create prism face-1 10,0,0 11,0,0 11,1,0 face-2 10,0,1 11,0,1 11,1,1",
               "poly prism a 10,0,0 11,0,0 11,1,0 b 10,0,1 11,0,1 11,1,1");
    leaf.right("block create prism face-1 10 0 0 11 0 0 11 1 0 face-2 10 0 1 11 0 1 11 1 1 group 'b1'",
               "poly prism a 10 0 0 11 0 0 11 1 0 b 10 0 1 11 0 1 11 1 1 group b1");
    leaf.wrong("block create prism face-1 0 0 0 1 0 0 1 1 0", "a prism needs two polygons");
    leaf.wrong("block create prism face1 0 0 0", "'face1' is not a keyword of block create prism");
    return leaf;
}

CommandSpec create_polyhedron() {
    Leaf<PolyFace> leaf("block create polyhedron|poly", "poly face");
    leaf.start([](const Statement& statement, PolyFace& poly) { poly.place = statement.words.front().place; });
    leaf.word("face", "face", "corners of a face, in order around it").checks_of_meaning();
    const ArgumentSpec corner = vector("x y z").unit("length").spec;
    const auto after_a_face = [](Reader& reader, PolyFace& poly) {
        if (poly.faces.empty())
            throw Diagnostic("joint-set belongs to a face", "write it after the word face").at(reader.previous().place);
    };
    leaf.keyword({"joint-set", "joint-set-id"},
                 Parts<PolyFace>()
                     .check(after_a_face)
                     .in(last_of(&PolyFace::faces),
                         Parts<PolyFace::Face>().then(integer("k").at_least(0), &PolyFace::Face::joint_set)),
                 "joint set that made the face, 0 if not given");
    leaf.otherwise({corner}, [corner](Reader& reader, PolyFace& poly) {
        if (!reader.at_number() || poly.faces.empty()) return false;
        poly.faces.back().corners.push_back(reader.vector(corner));
        return true;
    });
    leaf.not_yet({"face-group"}, "groups of faces: give them with block face group");
    group_option(leaf);
    leaf.right("block create polyhedron face 10 0 0  11 0 0  10 1 0 face 10 0 0  10 0 1  11 0 0 ...\n"
               "     face 10 0 0  10 1 0  10 0 1 face 11 0 0  10 0 1  10 1 0",
               "poly face 10 0 0  11 0 0  10 1 0 face 10 0 0  10 0 1  11 0 0 &\n"
               "     face 10 0 0  10 1 0  10 0 1 face 11 0 0  10 0 1  10 1 0");
    leaf.right("block create group 's' poly face joint-set 3 10,0,0 11,0,0 10,1,0 face 10,0,0 10,0,1 11,0,0 &\n"
               "     face 10,0,0 10,1,0 10,0,1 face 11,0,0 10,0,1 10,1,0",
               "poly face id 3 10,0,0 11,0,0 10,1,0 face 10,0,0 10,0,1 11,0,0 &\n"
               "     face 10,0,0 10,1,0 10,0,1 face 11,0,0 10,0,1 10,1,0 group s");
    leaf.wrong("block create polyhedron face 0 0 0 1 0 0 0 1 0", "1 face does not close a polyhedron");
    leaf.wrong("block create polyhedron joint-set 1", "joint-set belongs to a face");
    leaf.wrong("block create polyhedron fcae 0 0 0", "'fcae' is not a keyword of block create polyhedron");
    return leaf;
}

CommandSpec create_tetrahedron() {
    Leaf<PolyTet> leaf("block create tetrahedron", "poly tet");
    leaf.values_of_meaning().checks_of_meaning();
    leaf.not_yet({"joint-set"}, "joint sets of the faces of a tetrahedron: write block create polyhedron");
    group_option(leaf);
    leaf.right("block create tetrahedron 10,0,0 11,0,0 10,1,0 10,0,1 group 'corner'",
               "poly tet 10,0,0 11,0,0 10,1,0 10,0,1 group corner");
    leaf.wrong("block create tetrahedron 0 0 0 1 0 0 0 1 0", "a tetrahedron has four corners, and 3 are given");
    return leaf;
}

CommandSpec create_drum() {
    Leaf<PolyDrum> leaf("block create drum", "poly drum");
    leaf.word("center-1", "center-1").word("center-2", "center-2").word("radius-1", "radius-1");
    leaf.word("radius-2", "radius-2").word("number-edges", "edges").checks_of_meaning();
    leaf.not_yet({"angle"}, "drums that are turned about their axis");
    group_option(leaf);
    leaf.right("block create drum center-1 10 0 0 center-2 10 0 1 radius-1 0.5 radius-2 0.4 number-edges 12",
               "poly drum end1 10 0 0 end2 10 0 1 radius 0.5 0.4 edges 12");
    leaf.wrong("block create drum center-1 0 0 0 radius-1 1", "a drum needs both ends and a radius");
    leaf.wrong("block create drum number-edges 2", "number-edges must be at least 3, not 2");
    return leaf;
}

CommandSpec tunnel_blocks() {
    Leaf<PolyTunnel> leaf("block create tunnel", "poly tunnel");
    leaf.word("blocks-radial", "radial").word("blocks-tangential", "tangential").word("blocks-axial", "axial");
    leaf.word("boundary", "boundary").word("dip", "dip").word("dip-direction", "dip-direction");
    leaf.word("length", "length").word("origin", "origin").word("radius", "radius").word("radius-ratio", "ratio");
    group_option(leaf);
    leaf.right("block create tunnel radius 2 length 0 5 blocks-radial 2 blocks-axial 3 radius-ratio 1.5",
               "poly tunnel radius 2 length 0 5 radial 2 axial 3 ratio 1.5");
    leaf.wrong("block create tunnel radius 0", "radius must be greater than 0, not 0");
    leaf.wrong("block create tunnel blocks-radial 0", "blocks-radial must be at least 1, not 0");
    return leaf;
}

/// Dip, dip direction and origin of a plane.
void through_points(JointSetCommand& jset, const Vec3& one, const Vec3& two, const Vec3& three, const Place& place) {
    Vec3 normal = (two - one).cross(three - one);
    const double size = normal.norm(), longest = std::max((two - one).norm(), (three - one).norm());
    if (!(size > 1e-9 * longest * longest))
        throw Diagnostic("the three points lie on a line", "give three points that span a plane").at(place);
    normal *= (normal.z() < 0 ? -1 : 1) / size;
    constexpr double degree = std::numbers::pi / 180;
    const double across = std::hypot(normal.x(), normal.y());
    const double direction = across > 1e-12 ? std::atan2(normal.x(), normal.y()) / degree : 0;
    jset.dip[0] = std::atan2(across, normal.z()) / degree;
    jset.dip_direction[0] = direction < 0 ? direction + 360 : direction;
    jset.origin = one;
}

CommandSpec cut_joint_set() {
    Leaf<JointSetCommand> leaf("block cut joint-set", "jset");
    for (const char* word : {"dip", "dip-direction", "spacing", "number", "origin", "persistence", "join"})
        leaf.word(word, word);
    leaf.word("jointset-id", "id").checks_of_meaning();
    const ArgumentSpec point = vector("x y z").unit("length").spec;
    leaf.special(
        {"three-points"}, {point, point, point},
        [point](Reader& reader, JointSetCommand& jset) {
            const Vec3 one = reader.vector(point), two = reader.vector(point), three = reader.vector(point);
            through_points(jset, one, two, three, reader.previous().place);
        },
        "three points of the first joint, in place of dip, dip-direction and origin");
    leaf.ranged(&JointSetCommand::range);
    leaf.right("block cut joint-set dip 90 dip-direction 90 origin 0.5 0 0", "jset dip 90 dd 90 origin 0.5 0 0");
    leaf.right("block cut joint-set dip 30 5 dip-direction 120 spacing 0.4 0.1 number 3 persistence 0.5 "
               "range position-z 0 1",
               "jset dip 30 5 dd 120 spacing 0.4 0.1 number 3 persistence 0.5 range z 0 1");
    leaf.right("block cut joint-set", "jset");
    leaf.right("block cut joint-set three-points (0.5,0,0) (0.5,1,0) (0.5,0,1)", "jset dip 90 dd 90 origin 0.5 0 0");
    leaf.right("block cut joint-set three-points 0 0 0.5 1 0 0.5 0 1 0.5 jointset-id 7", "jset origin 0 0 0.5 id 7");
    leaf.wrong("block cut joint-set three-points 0 0 0 1 1 1 2 2 2", "the three points lie on a line");
    leaf.wrong("block cut joint-set dip", "a number is missing after 'dip'");
    leaf.wrong("block cut joint-set sapcing 1", "'sapcing' is not a keyword of block cut joint-set");
    leaf.wrong("block cut", "a word is missing after 'cut'");
    return leaf;
}

CommandSpec cut_tunnel() {
    Leaf<TunnelCommand> leaf("block cut tunnel", "tunnel");
    leaf.word("face-1", "a").word("face-2", "b").word("radial", "radial").checks_of_meaning();
    leaf.not_yet({"table-1", "table-2", "axis", "x-local"}, "polygons in tables");
    leaf.not_yet({"group"}, "groups of what is cut: give them with block group");
    leaf.ranged(&TunnelCommand::range);
    leaf.right("block cut tunnel face-1 0.2 -1 0.2 0.8 -1 0.2 0.5 -1 0.8 face-2 0.2 2 0.2 0.8 2 0.2 0.5 2 0.8",
               "tunnel a 0.2 -1 0.2 0.8 -1 0.2 0.5 -1 0.8 b 0.2 2 0.2 0.8 2 0.2 0.5 2 0.8");
    leaf.wrong("block cut tunnel fcae-1 0 0 0", "'fcae-1' is not a keyword of block cut tunnel");
    return leaf;
}

CommandSpec densify_blocks() {
    Leaf<Densify> leaf("block densify");
    leaf.means("densify");
    leaf.help("cuts each block into equal parts along x, y and z");
    const ArgumentSpec part = integer("n").at_least(1).at_most(1000).spec;
    leaf.keyword({"segments"},
                 Parts<Densify>()
                     .argument(integer("nx").at_least(1).spec)
                     .argument(integer("ny").optional().spec)
                     .argument(integer("nz").optional().spec)
                     .by(
                         [part](Reader& reader, Densify& command) {
                             command.parts.fill(reader.integer(part));
                             for (std::size_t k = 1; k < 3 && reader.at_number(); ++k) {
                                 command.parts[k] = reader.integer(part);
                                 command.parts[2] = command.parts[k];
                             }
                         },
                         [](Parts<Densify>::Form form, const Densify& wanted) {
                             for (const std::int64_t n : wanted.parts) print_value(form.words, n);
                             form.after.parts = wanted.parts;
                             return Parts<Densify>::Forms{std::move(form)};
                         }),
                 "parts along x, y and z; one number: along each");
    leaf.action(
        {"join"}, [](Densify& command) { command.join = true; }, "the parts remain one body");
    leaf.not_yet({"maximum-length", "repeat", "gradient-limit", "tetrahedra", "hexahedra", "joint-set"},
                 "other ways to divide blocks: give segments");
    leaf.ranged(&Densify::range);
    leaf.finish([](const Reader& reader, Densify& command) {
        if (!reader.wildcards() && command.parts == std::array<std::int64_t, 3>{1, 1, 1})
            incomplete_line(reader, "block densify has no segments", "write for example: block densify segments 2 2 1");
    });
    leaf.right("block densify segments 2 1 3 join range position-z 0 1", "densify 2 1 3 join range z 0 1");
    leaf.right("block densify segments 2", "densify 2 2 2");
    leaf.wrong("block densify", "block densify has no segments");
    leaf.wrong("block densify segments 0", "segments must be at least 1, not 0");
    return leaf;
}

/// Blocks of a file; the suffix selects the format.
/// The name, with the suffix if it has none.
std::string with_suffix(const std::string& file, const char* suffix) {
    const bool has_suffix = file.find('.', file.find_last_of("/\\") + 1) != std::string::npos;
    return has_suffix ? file : file + suffix;
}

CommandSpec from_file(std::string_view words, const char* suffix) {
    Leaf<Import> leaf(words);
    leaf.help("makes blocks of the closed surfaces or blocks in a file");
    const auto add_suffix = [suffix](Reader&, Import& command) { command.file = with_suffix(command.file, suffix); };
    leaf.keyword({"filename"}, Parts<Import>().then(text("file"), &Import::file).check(add_suffix), "name of the file");
    leaf.no_effect("binary", "kaya finds out");
    leaf.not_yet({"break-angle"}, "merging faces that are nearly in one plane");
    leaf.finish([](const Reader& reader, Import& command) {
        if (command.file.empty()) incomplete_line(reader, "the name of the file is missing", "write: filename 'name'");
    });
    return leaf;
}

CommandSpec from_vrml() {
    CommandSpec spec = from_file("block generate from-vrml", ".wrl");
    spec.right = {{"block generate from-vrml filename 'stones.obj'", {}, "import stones.obj"}};
    spec.wrong = {{"block generate from-vrml", "the name of the file is missing"},
                  {"block generate from-vrml fielname 'a'", "'fielname' is not a keyword of block generate from-vrml"}};
    return spec;
}

CommandSpec import_grid() {
    CommandSpec spec = from_file("block import", ".3dgrid");
    spec.right = {{"block import filename 'stones.obj'", {}, "import stones.obj"}};
    spec.wrong = {{"block import", "the name of the file is missing"},
                  {"block import 'stones.obj'", "expected a keyword of block import, found the text 'stones.obj'"}};
    return spec;
}

/// `filename 'name'`, with this suffix if it has none.
void names_file(Leaf<Export>& leaf, const char* suffix, std::string_view help) {
    const auto add_suffix = [suffix](Reader&, Export& command) { command.file = with_suffix(command.file, suffix); };
    leaf.keyword({"filename"}, Parts<Export>().then(text("file"), &Export::file).check(add_suffix), help);
    leaf.no_effect("binary", "kaya writes text");
    leaf.finish([](const Reader& reader, Export& command) {
        if (command.file.empty()) incomplete_line(reader, "the name of the file is missing", "write: filename 'name'");
    });
}

CommandSpec export_grid() {
    Leaf<Export> leaf("block export", "export");
    names_file(leaf, ".3dgrid", "name with suffix, which selects the format; .3dgrid if not given");
    leaf.ranged(&Export::range);
    leaf.right("block export filename 'wall.3dgrid' range position-z 0 2", "export wall.3dgrid range z 0 2");
    leaf.right("block export filename 'wall'", "export wall.3dgrid")
        .right("block export filename 'wall.vtu'", "export wall.vtu");
    leaf.wrong("block export", "the name of the file is missing");
    return leaf;
}

CommandSpec to_flac3d() {
    Leaf<Export> leaf("block to-flac3d", "export");
    names_file(leaf, ".f3grid", "name of the file, with .f3grid if no suffix is given");
    leaf.no_effect("block-id", "groups of zones have the groups of their blocks");
    leaf.right("block to-flac3d filename 'wall'", "export wall.f3grid");
    leaf.wrong("block to-flac3d", "the name of the file is missing");
    return leaf;
}

} // namespace

Family create_family() {
    return {"block create",
            "making blocks",
            {create_brick(), create_prism(), create_polyhedron(), create_tetrahedron(), create_drum(), tunnel_blocks(),
             cut_joint_set(), cut_tunnel(), densify_blocks(), from_vrml(), import_grid(), export_grid(), to_flac3d()}};
}

} // namespace kaya::lang
