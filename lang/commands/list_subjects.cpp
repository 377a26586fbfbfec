#include "lang/commands/list_subjects.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

constexpr ListedColumn field(std::string_view name) { return {name, name}; }
constexpr ListedColumn field(std::string_view heading, std::string_view name) { return {heading, name}; }
constexpr ListedColumn computed(std::string_view heading) { return {heading, {}}; }

constexpr ListSubject of_blocks[] = {
    {"position", "centroid and volume", {field("centroid", "position"), field("volume")}},
    {"velocity", "velocity and rotational velocity", {field("velocity"), field("rotational_velocity")}},
    {"unbalanced-force", "sum of forces", {field("force")}},
    {"moment", "sum of moments", {field("moment")}},
    {"apply", "applied load, held directions", {field("load"), computed("fixed")}},
    {"condition",
     "rigid or deformable, held directions, hidden or not",
     {computed("kind"), computed("fixed"), field("hidden")}},
    {"details",
     "region, material, mass, numbers of gridpoints and zones",
     {field("region"), field("material"), field("constitutive"), field("mass"), computed("points"), computed("zones")}},
    {"limits", "least and greatest coordinates", {computed("least"), computed("greatest")}},
};
constexpr ListSubject of_gridpoints[] = {
    {"position", "place", {field("position")}},
    {"displacement", "displacement", {field("displacement")}},
    {"velocity", "velocity", {field("velocity")}},
    {"force", "sum of forces", {field("force")}},
    {"mass", "mass", {field("mass")}},
    {"pore-pressure", "pore pressure", {field("pore_pressure")}},
    {"group", "group", {field("group")}},
    {"apply", "applied load, held directions", {field("load"), computed("fixed")}},
    {"reaction", "force that holds a gridpoint", {field("reaction")}},
};
constexpr ListSubject of_zones[] = {
    {"position", "centroid", {field("centroid", "position")}},
    {"stress",
     "stresses",
     {field("sxx", "xx_stress"), field("syy", "yy_stress"), field("szz", "zz_stress"), field("sxy", "xy_stress"),
      field("sxz", "xz_stress"), field("syz", "yz_stress")}},
    {"strain", "volumetric and shear strain", {field("volumetric_strain"), field("shear_strain")}},
    {"model", "zone model", {field("model")}},
    {"state", "state of the model", {field("state")}},
    {"property", "material, bulk and shear modulus", {field("material"), field("bulk"), field("shear")}},
    {"pore-pressure", "pore pressure", {field("pore_pressure")}},
    {"metric", "volume and mass", {computed("volume"), field("mass")}},
    {"group", "group", {field("group")}},
};
constexpr ListSubject of_faces[] = {
    {"position", "centroid, normal and area", {field("position"), field("normal"), field("area")}},
    {"vertices", "number of vertices", {field("vertex_count")}},
    {"group", "group", {field("group")}},
};
constexpr ListSubject of_contacts[] = {
    {"type", "kinds of parts in contact, number of sub-contacts", {computed("touch"), computed("points")}},
    {"position", "place and area", {field("position"), field("area")}},
    {"orientation", "normal, from the first block to the second", {field("normal")}},
    {"joint-set", "joint set", {field("joint_set")}},
    {"model", "joint model and material", {field("jmat", "material"), field("jmodel", "model")}},
    {"group", "group", {field("group")}},
};
constexpr ListSubject of_sub_contacts[] = {
    {"position", "place and area", {field("position"), field("area")}},
    {"type", "kind", {field("type")}},
    {"orientation", "normal", {field("normal")}},
    {"model", "joint model and material", {field("jmat", "material"), field("jmodel", "model")}},
    {"group", "group", {field("group")}},
    {"force",
     "normal force, shear force as a vector",
     {field("nforce", "normal_force"), field("sforce", "shear_force_vector")}},
    {"stress",
     "normal and shear stress, effective",
     {field("nstress", "normal_stress"), field("sstress", "shear_stress")}},
    {"displacement-normal", "normal displacement", {field("ndis", "normal_displacement")}},
    {"displacement-shear", "shear displacement as a vector", {field("sdis", "shear_displacement_vector")}},
    {"pore-pressure", "pore pressure", {field("pore_pressure")}},
    {"state", "state of the joint model", {computed("state")}},
};

constexpr ListedObjects lists[] = {
    {List::What::blocks, 1, of_blocks},     {List::What::gridpoints, 2, of_gridpoints},
    {List::What::zones, 2, of_zones},       {List::What::faces, 2, of_faces},
    {List::What::contacts, 3, of_contacts}, {List::What::sub_contacts, 2, of_sub_contacts}};

} // namespace

const ListedObjects* listed_objects(List::What what) {
    const auto* const found = std::ranges::find(lists, what, &ListedObjects::what);
    return found == std::end(lists) ? nullptr : found;
}

std::span<const ListSubject> list_subjects(List::What what) {
    const ListedObjects* const objects = listed_objects(what);
    return objects ? objects->subjects : std::span<const ListSubject>{};
}

} // namespace kaya::lang
