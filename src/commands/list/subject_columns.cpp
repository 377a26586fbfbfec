#include "commands/list/subject_columns.hpp"

#include "lang/commands/list_subjects.hpp"

#include <algorithm>
#include <map>

namespace kaya {

namespace {

using Columns = std::vector<ListColumn>;
using Subjects = std::map<std::string_view, Columns>;
using What = lang::List::What;

/// The least or greatest coordinates of a block's gridpoints.
ListColumn corner(const Model& model, const char* title, bool greatest) {
    return {title, [&model, greatest](Row row) {
                const auto points = model.blocks.gridpoints[row];
                Vec3 corner = model.gridpoints.position[points.first];
                for (Row p = points.first; p < points.end(); ++p) {
                    const Vec3& at = model.gridpoints.position[p];
                    corner = greatest ? Vec3(corner.cwiseMax(at)) : Vec3(corner.cwiseMin(at));
                }
                return value_text(model, corner);
            }};
}

const ListColumn& column_of(const Columns& usual, std::string_view heading) {
    return *std::ranges::find(usual, heading, &ListColumn::heading);
}

Subjects of_blocks(const Model& model, const Columns& usual) {
    const ListColumn &fixed = column_of(usual, "fixed"), &kind = column_of(usual, "kind"),
                     &points = column_of(usual, "points"), &zones = column_of(usual, "zones");
    return {{"position", {{"centroid", "position"}, "volume"}},
            {"velocity", {"velocity", "rotational_velocity"}},
            {"unbalanced-force", {"force"}},
            {"moment", {"moment"}},
            {"apply", {"load", fixed}},
            {"condition", {kind, fixed, "hidden"}},
            {"details", {"region", "material", "constitutive", "mass", points, zones}},
            {"limits", {corner(model, "least", false), corner(model, "greatest", true)}}};
}

Subjects of_gridpoints(const Columns& usual) {
    return {{"position", {"position"}}, {"displacement", {"displacement"}},
            {"velocity", {"velocity"}}, {"force", {"force"}},
            {"mass", {"mass"}},         {"pore-pressure", {"pore_pressure"}},
            {"group", {"group"}},       {"apply", {"load", column_of(usual, "fixed")}},
            {"reaction", {"reaction"}}};
}

Subjects of_zones(const Columns& usual) {
    return {{"position", {{"centroid", "position"}}},
            {"stress",
             {{"sxx", "xx_stress"},
              {"syy", "yy_stress"},
              {"szz", "zz_stress"},
              {"sxy", "xy_stress"},
              {"sxz", "xz_stress"},
              {"syz", "yz_stress"}}},
            {"strain", {"volumetric_strain", "shear_strain"}},
            {"model", {"model"}},
            {"state", {"state"}},
            {"property", {"material", "bulk", "shear"}},
            {"pore-pressure", {"pore_pressure"}},
            {"metric", {column_of(usual, "volume"), "mass"}},
            {"group", {"group"}}};
}

Subjects of_contacts(const Columns& usual) {
    return {{"type", {column_of(usual, "touch"), column_of(usual, "points")}},
            {"position", {"position", "area"}},
            {"orientation", {"normal"}},
            {"joint-set", {"joint_set"}},
            {"model", {{"jmat", "material"}, {"jmodel", "model"}}},
            {"group", {"group"}}};
}

Subjects subjects_of(const Model& model, What what, const Columns& usual) {
    switch (what) {
    case What::blocks: return of_blocks(model, usual);
    case What::gridpoints: return of_gridpoints(usual);
    case What::zones: return of_zones(usual);
    case What::contacts: return of_contacts(usual);
    case What::faces:
        return {{"position", {"position", "normal", "area"}}, {"vertices", {"vertex_count"}}, {"group", {"group"}}};
    case What::sub_contacts:
        return {{"position", {"position", "area"}},
                {"type", {"type"}},
                {"orientation", {"normal"}},
                {"model", {{"jmat", "material"}, {"jmodel", "model"}}},
                {"group", {"group"}},
                {"force", {{"nforce", "normal_force"}, {"sforce", "shear_force_vector"}}},
                {"stress", {{"nstress", "normal_stress"}, {"sstress", "shear_stress"}}},
                {"displacement-normal", {{"ndis", "normal_displacement"}}},
                {"displacement-shear", {{"sdis", "shear_displacement_vector"}}},
                {"pore-pressure", {"pore_pressure"}}};
    default: return {};
    }
}

/// How many of the usual columns say which object a line is about.
std::size_t names_of(What what) {
    if (what == What::contacts) return 3;
    return what == What::blocks ? 1 : 2;
}

} // namespace

std::vector<ListColumn> subject_columns(const Model& model, const lang::List& command, const Columns& usual) {
    if (command.subjects.empty()) return usual;
    const auto names = static_cast<std::ptrdiff_t>(names_of(*command.what));
    Columns columns(usual.begin(), usual.begin() + names);
    const Subjects subjects = subjects_of(model, *command.what, usual);
    for (const std::string& subject : command.subjects) {
        // A subject that is not here is the usual column of the same name.
        const auto found = subjects.find(subject);
        const auto& wanted = found != subjects.end() ? found->second : usual;
        for (const ListColumn& column : wanted) {
            if (found == subjects.end() && column.heading != subject) continue;
            const bool there = std::ranges::count(columns, column.heading, &ListColumn::heading) > 0;
            if (!there) columns.push_back(column);
        }
    }
    return columns;
}

} // namespace kaya
