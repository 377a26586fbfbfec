// geometry, block cut geometry and dfn: surfaces, and cuts by them and by fractures.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

namespace {

CommandSpec choose_set() {
    Leaf<GeometryCommand> leaf("geometry set|select", "geometry set");
    leaf.arguments_of_meaning();
    leaf.right("geometry set 'fault'", "geometry set fault");
    leaf.wrong("geometry set", "a word is missing after 'set'");
    return leaf;
}

CommandSpec import_surface() {
    Leaf<GeometryCommand> leaf("geometry import", "geometry import");
    leaf.arguments_of_meaning().word("set", "set").word("format", "format");
    leaf.not_yet({"group", "merge", "offset", "position"}, "surfaces that are moved or named while they are read");
    leaf.right("geometry import 'fault.stl' set 'fault'", "geometry import fault.stl set fault");
    leaf.wrong("geometry import", "a word is missing after 'import'");
    return leaf;
}

CommandSpec export_surface() {
    Leaf<GeometryCommand> leaf("geometry export", "geometry export");
    leaf.arguments_of_meaning().word("set", "set");
    leaf.no_effect("binary", "kaya writes text");
    leaf.not_yet({"format", "nodes", "edges"}, "other formats than .stl, .obj, .ply and .json, points and lines");
    leaf.right("geometry export 'wall.stl' set 'fault'", "geometry export wall.stl set fault");
    leaf.wrong("geometry export", "a word is missing after 'export'");
    return leaf;
}

CommandSpec create_polygon() {
    Leaf<GeometryCommand> leaf("geometry polygon create", "geometry polygon create");
    leaf.word("by-positions|by-position", "by-positions").word("extrude", "extrude").word("set", "set");
    leaf.not_yet({"by-nodes", "by-edges"}, "polygons by numbers of nodes or edges: give by-positions");
    leaf.not_yet({"group", "extra"}, "groups of polygons");
    leaf.checks_of_meaning();
    leaf.right("geometry polygon create by-positions (0,0,0) (1,0,0) (0,1,0) extrude (0,0,1)",
               "geometry polygon create by-positions 0 0 0 1 0 0 0 1 0 extrude 0 0 1");
    leaf.wrong("geometry polygon create", "a polygon needs three corners or more");
    return leaf;
}

CommandSpec delete_set() {
    Leaf<GeometryCommand> leaf("geometry delete", "geometry delete");
    leaf.word("set", "set");
    leaf.right("geometry delete set 'fault'", "geometry delete set fault");
    leaf.wrong("geometry delete ste 'fault'", "'ste' is not a keyword of geometry delete");
    return leaf;
}

CommandSpec cut_geometry() {
    Leaf<CutPolygons> leaf("block cut geometry", "cut geometry");
    leaf.arguments_of_meaning().ranged(&CutPolygons::range);
    leaf.right("block cut geometry 'fault' range position-z 0 1", "cut geometry fault range z 0 1");
    leaf.wrong("block cut geometry", "a word is missing after 'geometry'");
    return leaf;
}

CommandSpec cut_fractures() {
    Leaf<CutFractures> leaf("block cut dfn name", "cut dfn");
    leaf.arguments_of_meaning().word("limited", "limited").word("sides", "sides").word("persistence", "persistence");
    leaf.word("tolerance", "tolerance").word("seed", "seed").ranged(&CutFractures::range);
    leaf.right("block cut dfn name 'faults'", "cut dfn faults");
    leaf.right("block cut dfn name 'faults' limited sides 8", "cut dfn faults limited sides 8");
    leaf.wrong("block cut dfn name", "a word is missing after 'name'");
    return leaf;
}

} // namespace

Family surface_family() {
    return {"geometry",
            "surfaces, for cuts",
            {choose_set(), import_surface(), export_surface(), create_polygon(), delete_set(), cut_geometry(),
             cut_fractures(),
             ignored_line("geometry edge|node create", "lines and points of surfaces", "only polygons cut blocks",
                          "geometry edge create by-positions 0 0 0 1 0 0")}};
}

} // namespace kaya::lang
