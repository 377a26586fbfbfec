#include "lang/commands/list_subjects.hpp"

namespace kaya::lang {

namespace {

constexpr ListSubject of_blocks[] = {
    {"position", "centroid and volume"},
    {"velocity", "velocity and rotational velocity"},
    {"unbalanced-force", "sum of forces"},
    {"moment", "sum of moments"},
    {"apply", "applied load, held directions"},
    {"condition", "rigid or deformable, held directions, hidden or not"},
    {"details", "region, material, mass, numbers of gridpoints and zones"},
    {"limits", "least and greatest coordinates"},
};
constexpr ListSubject of_gridpoints[] = {
    {"position", "place"},
    {"displacement", "displacement"},
    {"velocity", "velocity"},
    {"force", "sum of forces"},
    {"mass", "mass"},
    {"pore-pressure", "pore pressure"},
    {"group", "group"},
    {"apply", "applied load, held directions"},
    {"reaction", "force that holds a gridpoint"},
};
constexpr ListSubject of_zones[] = {
    {"position", "centroid"},
    {"stress", "stresses"},
    {"strain", "volumetric and shear strain"},
    {"model", "zone model"},
    {"state", "state of the model"},
    {"property", "material, bulk and shear modulus"},
    {"pore-pressure", "pore pressure"},
    {"metric", "volume and mass"},
    {"group", "group"},
};
constexpr ListSubject of_faces[] = {
    {"position", "centroid, normal and area"},
    {"vertices", "number of vertices"},
    {"group", "group"},
};
constexpr ListSubject of_contacts[] = {
    {"type", "kinds of parts in contact, number of sub-contacts"},
    {"position", "place and area"},
    {"orientation", "normal, from the first block to the second"},
    {"joint-set", "joint set"},
    {"model", "joint model and material"},
    {"group", "group"},
};
constexpr ListSubject of_sub_contacts[] = {
    {"position", "place and area"},
    {"type", "kind"},
    {"orientation", "normal"},
    {"model", "joint model and material"},
    {"group", "group"},
    {"force", "normal force, shear force as a vector"},
    {"stress", "normal and shear stress, effective"},
    {"displacement-normal", "normal displacement"},
    {"displacement-shear", "shear displacement as a vector"},
    {"pore-pressure", "pore pressure"},
    {"state", "state of the joint model"},
};

} // namespace

std::span<const ListSubject> list_subjects(List::What what) {
    switch (what) {
    case List::What::blocks: return of_blocks;
    case List::What::gridpoints: return of_gridpoints;
    case List::What::zones: return of_zones;
    case List::What::faces: return of_faces;
    case List::What::contacts: return of_contacts;
    case List::What::sub_contacts: return of_sub_contacts;
    default: return {};
    }
}

} // namespace kaya::lang
