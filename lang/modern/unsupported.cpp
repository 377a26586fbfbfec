// Modern commands that kaya knows by name only: a deck that uses one gets a message with its line.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

namespace {

struct Known {
    const char* words;
    const char* about;
};

constexpr Known known[] = {
    {"model thermal", "heat"},
    {"model fluid", "flow of water"},
    {"model creep", "creep"},
    {"model results", "files of results"},
    {"model mechanical timestep maximum", "a limit of the time step: see timestep fix"},
    {"model mechanical substep", "substeps"},
    {"block create group", "groups of new blocks: name the shape after the group"},
    {"block create wall", "blocks that are walls"},
    {"block cut dfn id", "networks by number: give the name"},
    {"block cut set", "options of cuts"},
    {"block cut jointset-id", "the number of the next joint set: give it to block cut joint-set"},
    {"block generate from-geometry", "blocks of surfaces"},
    {"block generate from-topography", "blocks below a topography: write cut ground"},
    {"block generate voronoi", "Voronoi blocks"},
    {"block relax", "excavation in steps"},
    {"block merge-start", "tetrahedra that become zones of one block"},
    {"block merge-finish", "tetrahedra that become zones of one block"},
    {"block to-pfc", "files for PFC"},
    {"block to-udec", "files for UDEC"},
    {"block makewall", "blocks that are walls"},
    {"block join-by-contact", "contacts that join parts of blocks: see block contact join"},
    {"block skip-join-update", "joined blocks"},
    {"block ratio", "kinds of ratios: name the ratio in model solve"},
    {"block fragment", "pieces that joints hold together"},
    {"block analyze-stability", "isolated blocks: write list stability"},
    {"block trace", "paths of places"},
    {"block dynamic free-field", "free fields at the sides of a model"},
    {"block thermal", "heat"},
    {"block fluid", "flow of water"},
    {"block finite-element", "blocks of finite elements"},
    {"block contact property-distribution", "scattered properties of joints"},
    {"block contact material-table property", "joint models of new contacts by number"},
    {"block contact apply", "pore pressures of joints: write block insitu pore-pressure"},
    {"block contact persistence", "bridges of rock in joints"},
    {"block contact area-minimum", "the least area of a sub-contact"},
    {"block contact compute-stiffness", "stiffness of joints from zones"},
    {"block contact compute", "measures of joints"},
    {"block contact vertex-vertex", "contacts of corners"},
    {"block contact safe-delete", "contacts that are deleted"},
    {"block face apply-remove", "loads that are taken away: apply the opposite"},
    {"block face merge", "faces that become one"},
    {"block gridpoint group", "groups of gridpoints"},
    {"block gridpoint trace", "paths of gridpoints"},
    {"block zone generate-new", "a second way to make zones: write block zone generate edgelength"},
    {"block zone generate high-order-tetra", "zones of higher order"},
    {"block zone generate rezone", "zones that are made again"},
    {"block zone generate fix", "gridpoints that zones must have"},
    {"block zone size", "sizes of zones by range"},
    {"block zone cmodel list", "zone models"},
    {"block zone property-distribution", "scattered properties of zones"},
    {"block zone volume-minimum-delete", "small zones that are deleted"},
    {"block zone fluid", "flow of water"},
    {"block zone thermal", "heat"},
    {"structure cable|beam|liner delete", "structures of one kind that are deleted: write structure delete"},
    {"structure cable|beam|liner group", "groups of structures"},
    {"structure cable|beam|liner hide", "hidden structures"},
    {"structure cable|beam|liner initialize", "forces of structures"},
    {"structure cable|beam|liner import", "structures from files"},
    {"structure cable|beam|liner refine", "structures that are divided further"},
    {"structure cable|beam|liner cmodel", "other laws of structures"},
    {"structure cable|beam|liner apply",
     "loads on structures, and tension of cables: write structure cable ... tension"},
    {"structure cable|beam|liner history", "histories of structures: FISH reads their fields"},
    {"structure pile", "piles"},
    {"structure shell", "shells"},
    {"structure geogrid", "geogrids"},
    {"structure hybrid", "bolts with dowels"},
    {"structure link", "links of structures"},
    {"sel", "structures of older versions: write structure cable"},
    {"flowknot", "flow in joints"},
    {"flowplane", "flow in joints"},
    {"fblock", "faces of blocks as blocks"},
    {"feblock", "blocks of finite elements"},
    {"fracture joint-set", "sets of fractures: write block cut joint-set"},
    {"fracture", "other commands of networks of fractures"},
    {"geometry generate", "shapes of surfaces: write geometry polygon create"},
    {"geometry", "other commands of surfaces: set, import, export, polygon create and delete run"},
    {"data", "data of the user"},
    {"project", "projects"},
    {"trace", "paths of places"},
    {"fish debug", "the debugger of FISH"},
    {"fish trace", "variables that are followed"},
    {"fish result", "files of results"},
};

} // namespace

Family unsupported_family() {
    Family family{"not supported yet", "known by name; a deck that uses them gets an error", {}};
    for (const Known& row : known) family.commands.push_back(unsupported_line(row.words, row.about));
    return family;
}

} // namespace kaya::lang
