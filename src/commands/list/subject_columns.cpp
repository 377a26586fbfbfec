#include "commands/list/subject_columns.hpp"

#include "lang/commands/list_subjects.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <stdexcept>

namespace kaya {

namespace {

using Subjects = std::map<std::string_view, std::vector<ListColumn>>;
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

Subjects of_blocks(const Model& model) {
    const auto& blocks = model.blocks;
    const ListColumn fixed("fixed", [&](Row row) { return block_fixity_text(model, row); });
    const ListColumn kind("kind", [&](Row row) { return blocks.deformable[row] ? "deformable" : "rigid"; });
    const ListColumn points("points", [&](Row row) { return std::to_string(blocks.gridpoints[row].count); });
    const ListColumn zones("zones", [&](Row row) { return std::to_string(blocks.zones[row].count); });
    return {{"position", {{"centroid", "position"}, "volume"}},
            {"velocity", {"velocity", "rotational_velocity"}},
            {"unbalanced-force", {"force"}},
            {"moment", {"moment"}},
            {"apply", {"load", fixed}},
            {"condition", {kind, fixed, "hidden"}},
            {"details", {"region", "material", "constitutive", "mass", points, zones}},
            {"limits", {corner(model, "least", false), corner(model, "greatest", true)}}};
}

Subjects of_gridpoints(const Model& model) {
    const auto& points = model.gridpoints;
    const ListColumn fixed("fixed", [&](Row row) { return fixity_text(model, points.fixed[row], points.roller[row]); });
    return {{"position", {"position"}}, {"displacement", {"displacement"}},
            {"velocity", {"velocity"}}, {"force", {"force"}},
            {"mass", {"mass"}},         {"pore-pressure", {"pore_pressure"}},
            {"group", {"group"}},       {"apply", {"load", fixed}},
            {"reaction", {"reaction"}}};
}

Subjects of_zones(const Model& model) {
    const ListColumn volume("volume", [&](Row row) { return value_text(model, model.zones.volume[row]); }); // when made
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
            {"metric", {volume, "mass"}},
            {"group", {"group"}}};
}

Subjects of_contacts(const Model& model) {
    const auto& contacts = model.contacts;
    const ListColumn parts("touch", [&](Row row) { return contact_type_text(contacts.type[row]); });
    const ListColumn points("points", [&](Row row) { return std::to_string(contacts.sub_contacts[row].count); });
    return {{"type", {parts, points}},
            {"position", {"position", "area"}},
            {"orientation", {"normal"}},
            {"joint-set", {"joint_set"}},
            {"model", {{"jmat", "material"}, {"jmodel", "model"}}},
            {"group", {"group"}}};
}

Subjects subjects_of(const Model& model, What what) {
    switch (what) {
    case What::blocks: return of_blocks(model);
    case What::gridpoints: return of_gridpoints(model);
    case What::zones: return of_zones(model);
    case What::contacts: return of_contacts(model);
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

const char* contact_type_text(ContactType type) {
    static constexpr std::array names{"-",         "face-face",   "face-edge",    "face-vertex",
                                      "edge-edge", "edge-vertex", "vertex-vertex"};
    return names[static_cast<std::size_t>(type)];
}

std::string fixity_text(const Model& model, std::uint8_t fixed, std::int32_t roller) {
    static constexpr std::array names{"x", "y", "z", "rx", "ry", "rz"};
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
    for (std::size_t i = 0; i < names.size(); ++i)
        if ((fixed & (1u << i)) != 0) add(names[i]);
    const Roller& held = model.rollers[static_cast<std::size_t>(roller)];
    for (std::int32_t k = 0; k < held.count; ++k) add(value_text(model, held.direction[static_cast<std::size_t>(k)]));
    return text.empty() ? "-" : text;
}

std::string block_fixity_text(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    if (blocks.deformable[block]) return "-";
    return fixity_text(model, blocks.fixed[block], model.gridpoints.roller[blocks.gridpoints[block].first]);
}

std::vector<ListColumn> subject_columns(const Model& model, const lang::List& command,
                                        const std::vector<ListColumn>& usual) {
    if (command.subjects.empty()) return usual;
    const auto names = static_cast<std::ptrdiff_t>(names_of(*command.what));
    std::vector<ListColumn> columns(usual.begin(), usual.begin() + names);
    const Subjects subjects = subjects_of(model, *command.what);
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
