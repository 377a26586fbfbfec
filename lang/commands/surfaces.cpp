// Surfaces, and cuts by them and by networks of fractures.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

constexpr const char* of_set = "name of the set; the current one if not given";

/// A line that begins with `geometry`.
Entry<GeometryCommand> geometry_line(std::vector<Spelling> form, GeometryCommand::Action action) {
    Entry<GeometryCommand> entry({Spelling{"geometry", 3}}, std::move(form));
    entry.start([action](const Statement& statement, GeometryCommand& command) {
        command.action = action;
        command.place = statement.words.front().place;
    });
    return entry;
}

CommandSpec choose_set() {
    auto entry = geometry_line({"set", "select"}, GeometryCommand::Action::choose);
    entry.help("names the set of surfaces that the next lines mean, and makes it if it is new");
    entry.argument(text("name").help("name of the set"), &GeometryCommand::set);
    entry.right("geometry set 'fault'").right("geometry select fault");
    entry.wrong("geometry set", "a word is missing after 'set'");
    return entry;
}

CommandSpec import_surface() {
    auto entry = geometry_line({"import"}, GeometryCommand::Action::import);
    entry.help("adds the faces in a file to a set");
    entry.argument(text("file").help("name with suffix, which selects the format"), &GeometryCommand::file);
    entry.keyword({"set"}, text("name"), &GeometryCommand::set, "name of the set; that of the file if not given");
    entry
        .keyword(
            {"format"}, text("format"), [](GeometryCommand&, const std::string&) {}, "kaya finds out by the suffix")
        .ignored();
    entry.right("geometry import 'fault.stl' set 'fault'").right("geometry import 'fault.dxf' format dxf");
    entry.wrong("geometry import", "a word is missing after 'import'");
    entry.wrong("geometry import 'a.stl' ste 'b'", "'ste' is not a keyword of geometry import");
    return entry;
}

CommandSpec export_surface() {
    auto entry = geometry_line({"export"}, GeometryCommand::Action::write);
    entry.help("writes the polygons of a set to a file");
    entry.argument(text("file").help("name with the suffix .stl, .obj, .ply or .json, which selects the format"),
                   &GeometryCommand::file);
    entry.keyword({"set"}, text("name"), &GeometryCommand::set, of_set);
    entry.right("geometry export 'wall.stl' set 'fault'").right("geometry export 'wall.obj'");
    entry.wrong("geometry export", "a word is missing after 'export'");
    entry.wrong("geometry export 'wall.stl' ste 'b'", "'ste' is not a keyword of geometry export");
    return entry;
}

CommandSpec create_polygon() {
    auto entry = geometry_line({"polygon"}, GeometryCommand::Action::polygon);
    entry.then({"create"}).help("adds a plane polygon to a set");
    entry.keyword({"by-positions", "by-position"},
                  Parts<GeometryCommand>().each(vector("x y z").unit("length"), &GeometryCommand::corners),
                  "the corners, in order around it");
    entry.keyword({"extrude"}, vector("dx dy dz").unit("length"), &GeometryCommand::extrude,
                  "closes a prism: adds the polygon moved by this, and the sides between them");
    entry.keyword({"set"}, text("name"), &GeometryCommand::set, of_set);
    entry.not_yet({"by-nodes", "by-edges"}, "polygons by numbers of nodes or edges: give by-positions");
    entry.not_yet({"group", "extra"}, "groups of polygons");
    entry.finish([](const Reader& reader, GeometryCommand& command) {
        if (command.corners.size() < 3)
            incomplete_line(reader, "a polygon needs three corners or more", "write: by-positions x y z  x y z  x y z");
    });
    entry.right("geometry polygon create by-positions 0 0 0.5 1 0 0.5 1 1 0.5 0 1 0.5");
    entry.right("geometry polygon create by-positions (0,0,0) (1,0,0) (0,1,0) extrude (0,0,1) set 'wedge'");
    entry.wrong("geometry polygon create by-positions 0 0 0 1 0 0", "a polygon needs three corners or more");
    entry.wrong("geometry polygon create by-postions 0 0 0",
                "'by-postions' is not a keyword of geometry polygon create");
    return entry;
}

CommandSpec delete_set() {
    auto entry = geometry_line({"delete"}, GeometryCommand::Action::remove);
    entry.help("deletes a set of surfaces");
    entry.keyword({"set"}, text("name"), &GeometryCommand::set, of_set);
    entry.right("geometry delete").right("geometry delete set 'fault'");
    entry.wrong("geometry delete 'fault'", "expected a keyword of geometry delete, found the text 'fault'");
    return entry;
}

CommandSpec cut_geometry() {
    Entry<CutPolygons> entry({"cut"}, {"geometry"});
    entry.help("cuts visible blocks by the plane of each polygon of a set, where the polygon passes through the block");
    entry.place(&CutPolygons::place);
    entry.argument(text("name").help("name of the set"), &CutPolygons::set);
    entry.keyword({"id"}, integer("n").at_least(1).at_most(1e9), &CutPolygons::id,
                  "joint set number of the faces; the next free one if not given");
    entry.action(
        {"join"}, [](CutPolygons& command) { command.join = true; }, "the pieces of a block remain one body");
    entry.range(&CutPolygons::range);
    entry.right("cut geometry 'fault'").right("cut geometry 'fault' id 7 join range z 0 1");
    entry.wrong("cut geometry", "a word is missing after 'geometry'");
    entry.wrong("cut geometry 'fault' di 7", "'di' is not a keyword of cut geometry");
    return entry;
}

CommandSpec cut_fractures() {
    Entry<CutFractures> entry({"cut"}, {"dfn"});
    entry.help("cuts visible blocks by each fracture of a network that passes through them, over the whole block or up "
               "to the rim of the fracture");
    entry.place(&CutFractures::place);
    entry.argument(text("name").help("name of the network"), &CutFractures::network);
    entry.action(
        {"limited"}, [](CutFractures& command) { command.limited = true; },
        "the cut ends with the fracture; the rock beyond stays one body");
    entry.keyword(
        {"sides"}, integer("n").at_least(3).at_most(64), &CutFractures::sides,
        "of the regular polygon, equal in area, that stands for a disc which ends in a block; 12 if not given");
    entry.keyword({Spelling{"persistence", 1}}, real("p").at_least(0).at_most(1), &CutFractures::persistence,
                  "probability that a block on a fracture is cut, 1 if not given");
    entry.keyword(
        {"tolerance"}, real("distance").unit("length").at_least(0), &CutFractures::tolerance,
        "a block is not cut where that would leave an edge shorter than this, or a corner nearer to the cut; 0 if not given");
    entry.keyword({"seed"}, integer("n").at_least(0).at_most(1e9), &CutFractures::seed,
                  "of persistence: another choice of blocks");
    entry.keyword(
        {"id"}, integer("n").at_least(1).at_most(1e9), &CutFractures::id,
        "joint set number of the first fracture, the next fracture has the next number; numbers that are free if not given");
    entry.action(
        {"join"}, [](CutFractures& command) { command.join = true; }, "the pieces of a block remain one body");
    entry.range(&CutFractures::range);
    entry.right("cut dfn 'faults'").right("cut dfn 'faults' limited sides 8 tolerance 0.01");
    entry.right("cut dfn 'faults' persistence 0.7 seed 3 id 20 join range z 0 1");
    entry.wrong("cut dfn", "a word is missing after 'dfn'");
    entry.wrong("cut dfn 'faults' limited sides 2", "sides must be at least 3, not 2");
    entry.wrong("cut dfn 'faults' persistence 2", "persistence must be at most 1, not 2");
    return entry;
}

} // namespace

std::vector<CommandSpec> surface_commands() {
    return {choose_set(), import_surface(), export_surface(), create_polygon(),
            delete_set(), cut_geometry(),   cut_fractures()};
}

} // namespace kaya::lang
