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
    entry.argument(text("file").help(".stl, .dxf, .obj, .ply, .wrl or .ts"), &GeometryCommand::file);
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

CommandSpec create_polygon() {
    auto entry = geometry_line({"polygon"}, GeometryCommand::Action::polygon);
    entry.then({"create"}).help("adds a plane polygon to a set");
    ArgumentSpec corner = vector("x y z").unit("length").spec;
    corner.repeated = true;
    entry.special(
        {"by-positions", "by-position"}, {corner},
        [corner](Reader& reader, GeometryCommand& command) {
            do command.corners.push_back(reader.vector(corner));
            while (reader.at_number());
        },
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

Entry<CutPolygons> cut_line(const char* form, bool fractures) {
    Entry<CutPolygons> entry({"cut"}, {form});
    entry.start([fractures](const Statement& statement, CutPolygons& command) {
        command.fractures = fractures;
        command.place = statement.words.front().place;
    });
    entry.argument(text("name").help(fractures ? "name of the network" : "name of the set"), &CutPolygons::set);
    entry.keyword({"id"}, integer("n").at_least(1).at_most(1e9), &CutPolygons::id,
                  "joint set number of the faces; the next free one if not given");
    entry.action(
        {"join"}, [](CutPolygons& command) { command.join = true; }, "the pieces of a block remain one body");
    entry.range(&CutPolygons::range);
    return entry;
}

CommandSpec cut_geometry() {
    auto entry = cut_line("geometry", false);
    entry.help("cuts visible blocks by the plane of each polygon of a set, where the polygon passes through the block");
    entry.right("cut geometry 'fault'").right("cut geometry 'fault' id 7 join range z 0 1");
    entry.wrong("cut geometry", "a word is missing after 'geometry'");
    entry.wrong("cut geometry 'fault' di 7", "'di' is not a keyword of cut geometry");
    return entry;
}

CommandSpec cut_fractures() {
    auto entry = cut_line("dfn", true);
    entry.help(
        "cuts visible blocks by the plane of each fracture of a network, where the disc passes through the block");
    entry.right("cut dfn 'faults'");
    entry.wrong("cut dfn", "a word is missing after 'dfn'");
    return entry;
}

} // namespace

std::vector<CommandSpec> surface_commands() {
    return {choose_set(), import_surface(), create_polygon(), delete_set(), cut_geometry(), cut_fractures()};
}

} // namespace kaya::lang
