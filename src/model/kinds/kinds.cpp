#include "model/kinds/kinds.hpp"

#include "model/measure/joint_opening.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/overlap_rows.hpp"
#include "model/measure/structure_rows.hpp"

#include <algorithm>
#include <array>

namespace kaya {

namespace {

// --- pieces of the rows -----------------------------------------------------------------------------------------

template <auto table> std::size_t size(const Model& model) { return (model.*table).size(); }
template <auto table, auto column> Row owner(const Model& model, Row row) { return ((model.*table).*column)[row]; }
template <auto table> Column<std::int32_t>& groups(Model& model) { return (model.*table).group; }
template <auto column> Span in_block(const Model& model, Row block) { return (model.blocks.*column)[block]; }
template <auto table> std::int64_t number(const Model& model, Row row) { return (model.*table).number[row]; }
std::int64_t counted_from_one(const Model&, Row row) { return row + std::int64_t{1}; }

template <auto table> Identity identity(const Model& model, Row row) {
    const auto id = (model.*table).id[row];
    return {id.slot, id.generation};
}
template <auto table> Row find(const Model& model, const Identity& identity) {
    return (model.*table).ids.row({identity.slot, identity.generation});
}

Row itself(const Model&, Row row) { return row; }
Row nothing(const Model&, Row) { return no_row; }
std::size_t one(const Model&) { return 1; }
std::size_t no_rows(const Model&) { return 0; }
Vec3 nowhere(const Model&, Row) { return Vec3::Zero(); }

bool block_shown(const Model& model, Row block) { return model.blocks.hidden[block] == 0; }
template <auto block_of_it> bool shown(const Model& model, Row row) {
    return block_shown(model, block_of_it(model, row));
}
bool contact_shown(const Model& model, Row row) {
    return block_shown(model, model.contacts.block1[row]) && block_shown(model, model.contacts.block2[row]);
}
bool sub_contact_shown(const Model& model, Row row) { return contact_shown(model, model.sub_contacts.contact[row]); }

Row block_of_triangle(const Model& model, Row row) { return model.faces.block[model.triangles.face[row]]; }
Row block_of_sub_contact(const Model& model, Row row) { return model.contacts.block1[model.sub_contacts.contact[row]]; }

// Corners of faces: three rows for each triangle.
Row block_of_corner(const Model& model, Row row) { return block_of_triangle(model, row / 3); }
Row gridpoint_of_corner(const Model& model, Row row) { return model.triangles.gridpoints[row / 3][row % 3]; }
std::size_t corner_count(const Model& model) { return 3 * model.triangles.size(); }
/// Unloaded rows of an overlap lie where the joint is open, else with the first row that carries, which comes before them: the nearest sub-contact to a place where the
/// joint is closed carries something.
Vec3 place_of_sub_contact(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    const Row contact = subs.contact[row], first = model.contacts.sub_contacts[contact].first;
    if (!is_unloaded(model, contact, row)) return subs.position[row];
    const Row place = row - carriers;
    const bool open = has_left_place(model, place) && opening_on_faces(model, place) > 0;
    return open ? place_on_faces(model, place) : Vec3(subs.position[first]);
}

Vec3 place_of_corner(const Model& model, Row row) { return model.gridpoints.position[gridpoint_of_corner(model, row)]; }
Span corners_of_block(const Model& model, Row block) {
    const Span triangles = model.blocks.triangles[block];
    return {3 * triangles.first, 3 * triangles.count};
}

std::size_t cable_node_count(const Model& model) { return model.structures.cable_nodes.size(); }
Vec3 place_of_cable_node(const Model& model, Row row) { return model.structures.cable_nodes.position[row]; }
Identity cable_node_identity(const Model& model, Row row) {
    const auto& cables = model.structures.cables;
    const Row cable = model.structures.cable_nodes.cable[row];
    return {static_cast<std::uint32_t>(cables.number[cable]),
            static_cast<std::uint32_t>(row - cables.nodes[cable].first) + 1};
}
Row find_cable_node(const Model& model, const Identity& identity) {
    return node_of_cable(model, static_cast<std::int32_t>(identity.slot), static_cast<Row>(identity.generation) - 1);
}

// Nodes and elements of beams and liners are identified by the number of their structure and an index in it.
template <auto table> std::size_t member_rows(const Model& model) { return (model.structures.*table).size(); }
template <auto table, auto span> Identity member_identity(const Model& model, Row row) {
    const auto& members = model.structures.members;
    const Row member = (model.structures.*table).member[row];
    return {static_cast<std::uint32_t>(members.number[member]),
            static_cast<std::uint32_t>(row - (members.*span)[member].first) + 1};
}
template <auto table, auto span> Row find_in_member(const Model& model, const Identity& identity) {
    const Row member = member_of_number(model, static_cast<std::int32_t>(identity.slot));
    if (member == no_row) return no_row;
    const Span rows = (model.structures.members.*span)[member];
    const Row offset = static_cast<Row>(identity.generation) - 1;
    return offset >= 0 && offset < rows.count ? rows.first + offset : no_row;
}
Row block_of_member_node(const Model& model, Row row) { return rock_block(model, model.structures.member_nodes, row); }
template <auto table> Row block_of_element(const Model& model, Row row) {
    return block_of_member_node(model, (model.structures.*table).nodes[row][0]);
}
Vec3 place_of_member_node(const Model& model, Row row) { return model.structures.member_nodes.position[row]; }
template <auto table> Vec3 place_of_element(const Model& model, Row row) {
    const auto& nodes = (model.structures.*table).nodes[row];
    Vec3 sum = Vec3::Zero();
    for (const Row node : nodes) sum += place_of_member_node(model, node);
    return sum / static_cast<double>(nodes.size());
}

template <auto table> Vec3 position(const Model& model, Row row) { return (model.*table).position[row]; }

// --- kinds ------------------------------------------------------------------------------------------------------

constexpr auto block_of_gridpoint = owner<&Model::gridpoints, &Gridpoints::block>;
constexpr auto block_of_zone = owner<&Model::zones, &Zones::block>;
constexpr auto block_of_face = owner<&Model::faces, &Faces::block>;

// A row per kind.
// clang-format off
/// In the order of ObjectKind.
constexpr std::array<KindInfo, 14> all_kinds{{
    {.kind = ObjectKind::block, .name = "block", .noun = "block", .plural = "blocks", .file = "blocks",
     .count = size<&Model::blocks>, .block = itself, .place = block_centroid, .number = number<&Model::blocks>, .shown = block_shown,
     .groups = groups<&Model::blocks>, .identity = identity<&Model::blocks>, .find = find<&Model::blocks>,
     .history = 4, .missing = "blocks", .remedy = "make blocks before this history",
     .classic = "b", .modern = "block", .has_spares = true},
    {.kind = ObjectKind::gridpoint, .name = "gridpoint", .noun = "gridpoint", .plural = "gridpoints", .file = "gridpoints",
     .count = size<&Model::gridpoints>, .block = block_of_gridpoint, .place = position<&Model::gridpoints>, .number = counted_from_one,
     .shown = shown<block_of_gridpoint>, .in_block = in_block<&Blocks::gridpoints>,
     .history = 1, .missing = "gridpoints", .remedy = "make blocks before this history",
     .classic = "gp", .modern = "block.gp", .has_spares = true},
    {.kind = ObjectKind::zone, .name = "zone", .noun = "zone", .plural = "zones", .file = "zones",
     .count = size<&Model::zones>, .block = block_of_zone, .place = zone_centroid, .number = counted_from_one, .shown = shown<block_of_zone>,
     .groups = groups<&Model::zones>, .in_block = in_block<&Blocks::zones>,
     .history = 2, .missing = "zones", .remedy = "make zones (generate edge ...) before this history",
     .classic = "z", .modern = "block.zone", .has_properties = true, .has_spares = true},
    {.kind = ObjectKind::face, .name = "face", .noun = "face", .plural = "faces", .file = "faces",
     .count = size<&Model::faces>, .block = block_of_face, .place = face_centroid, .number = counted_from_one, .shown = shown<block_of_face>,
     .groups = groups<&Model::faces>, .in_block = in_block<&Blocks::faces>,
     .classic = "face", .modern = "block.face"},
    {.kind = ObjectKind::contact, .name = "contact", .noun = "contact", .plural = "contacts", .file = "contacts",
     .count = size<&Model::contacts>, .block = owner<&Model::contacts, &Contacts::block1>, .place = position<&Model::contacts>,
     .number = number<&Model::contacts>, .shown = contact_shown, .groups = groups<&Model::contacts>,
     .identity = identity<&Model::contacts>, .find = find<&Model::contacts>, .found_late = true,
     .classic = "c", .modern = "block.contact", .has_properties = true, .has_spares = true},
    {.kind = ObjectKind::sub_contact, .name = "sub_contact", .noun = "sub-contact", .plural = "sub-contacts", .file = "sub-contacts",
     .count = size<&Model::sub_contacts>, .block = block_of_sub_contact, .place = place_of_sub_contact,
     .number = number<&Model::sub_contacts>, .shown = sub_contact_shown, .groups = groups<&Model::sub_contacts>,
     .identity = identity<&Model::sub_contacts>, .find = find<&Model::sub_contacts>, .found_late = true,
     .history = 3, .missing = "sub-contacts", .remedy = "make blocks that touch before this history",
     .classic = "cx", .modern = "block.subcontact", .has_properties = true, .has_spares = true},
    {.kind = ObjectKind::corner, .name = "corner", .noun = "corner", .plural = "corners",
     .count = corner_count, .block = block_of_corner, .place = place_of_corner, .shown = shown<block_of_corner>, .in_block = corners_of_block},
    {.kind = ObjectKind::cable_node, .name = "cable_node", .noun = "cable node", .plural = "cable nodes", .file = "cable-nodes",
     .count = cable_node_count, .block = block_of_node, .place = place_of_cable_node, .number = counted_from_one, // seen through the rock
     .identity = cable_node_identity, .find = find_cable_node,
     .history = 6, .missing = "cables", .remedy = "make cables (structure cable ...) before this history"},
    {.kind = ObjectKind::structure_node, .name = "structure_node", .noun = "node of beams and liners", .plural = "nodes of beams and liners", .file = "structure-nodes",
     .count = member_rows<&Structures::member_nodes>, .block = block_of_member_node, .place = place_of_member_node, .number = counted_from_one,
     .identity = member_identity<&Structures::member_nodes, &Members::nodes>, .find = find_in_member<&Structures::member_nodes, &Members::nodes>,
     .history = 7, .missing = "beams and liners", .remedy = "make them (structure beam ..., structure liner ...) before this history"},
    {.kind = ObjectKind::beam_element, .name = "beam_element", .noun = "element of beams", .plural = "elements of beams", .file = "beam-elements",
     .count = member_rows<&Structures::beams>, .block = block_of_element<&Structures::beams>, .place = place_of_element<&Structures::beams>, .number = counted_from_one,
     .identity = member_identity<&Structures::beams, &Members::beams>, .find = find_in_member<&Structures::beams, &Members::beams>,
     .history = 8, .missing = "beams", .remedy = "make beams (structure beam ...) before this history"},
    {.kind = ObjectKind::liner_element, .name = "liner_element", .noun = "element of liners", .plural = "elements of liners", .file = "liner-elements",
     .count = member_rows<&Structures::liners>, .block = block_of_element<&Structures::liners>, .place = place_of_element<&Structures::liners>, .number = counted_from_one,
     .identity = member_identity<&Structures::liners, &Members::liners>, .find = find_in_member<&Structures::liners, &Members::liners>,
     .history = 9, .missing = "liners", .remedy = "make liners (structure liner ...) before this history"},
    {.kind = ObjectKind::triangle, .name = "triangle", .noun = "triangle", .plural = "triangles",
     .count = size<&Model::triangles>, .block = block_of_triangle, .place = triangle_centroid, .number = counted_from_one,
     .shown = shown<block_of_triangle>},
    {.kind = ObjectKind::global, .name = "model", .noun = "model", .plural = "models", .file = "model",
     .count = one, .block = nothing, .place = nowhere, .history = 0},
    {.kind = ObjectKind::function, .name = "function", .noun = "function", .plural = "functions",
     .count = no_rows, .block = nothing, .place = nowhere, .history = 5},
}};
// clang-format on

// --- relations --------------------------------------------------------------------------------------------------

template <ObjectKind kind> Span all(const Model& model, Row) { return {0, static_cast<Row>(count_of(model, kind))}; }
template <auto table, auto column> Span span(const Model& model, Row row) { return ((model.*table).*column)[row]; }

Span corners_of_face(const Model& model, Row face) {
    const Span triangles = model.faces.triangles[face];
    return {3 * triangles.first, 3 * triangles.count};
}
Row face_of_corner(const Model& model, Row corner) { return model.triangles.face[corner / 3]; }
/// Triangles of a face share corners; a list names each gridpoint once.
bool named_before(const Model& model, const Span& list, Row corner) {
    for (Row row = list.first; row < corner; ++row)
        if (gridpoint_of_corner(model, row) == gridpoint_of_corner(model, corner)) return true;
    return false;
}

std::vector<Row> corners_of_zone(const Model& model, Row zone) {
    const auto& rows = model.zones.gridpoints[zone];
    return {rows.begin(), rows.end()};
}

/// The next contact in which the first (1) or the second (2) block of this one takes part.
template <int side> Row contact_of_same_block(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    const Row block = side == 1 ? contacts.block1[contact] : contacts.block2[contact];
    const Row end = static_cast<Row>(contacts.size());
    Row after = contact + 1;
    while (after < end && contacts.block1[after] != block && contacts.block2[after] != block) ++after;
    return after < end ? after : no_row;
}

using enum ObjectKind;
// A row per relation.
// clang-format off
constexpr std::array<Relation, 15> all_relations{{
    {.from = global, .to = block, .list = all<block>, .first = {"block_head", "block.head"}, .next = {"b_next", "block.next"}, .array = "block.list"},
    {.from = global, .to = contact, .list = all<contact>, .first = {"contact_head", "block.contact.head"}, .next = {"c_next", "block.contact.next"},
     .array = "block.contact.list"},
    {.from = global, .to = sub_contact, .list = all<sub_contact>, .array = "block.subcontact.list"},
    {.from = global, .to = gridpoint, .list = all<gridpoint>, .array = "block.gp.list"},
    {.from = global, .to = zone, .list = all<zone>, .array = "block.zone.list"},
    {.from = global, .to = face, .list = all<face>, .array = "block.face.list"},
    {.from = block, .to = gridpoint, .list = span<&Model::blocks, &Blocks::gridpoints>, .owner = block_of_gridpoint, .first = {"b_gp", ""}, .next = {"gp_next", "block.gp.next"},
     .array = "block.gplist"},
    {.from = block, .to = zone, .list = span<&Model::blocks, &Blocks::zones>, .owner = block_of_zone, .first = {"b_zone", ""}, .next = {"z_next", "block.zone.next"},
     .array = "block.zonelist"},
    {.from = block, .to = face, .list = span<&Model::blocks, &Blocks::faces>, .owner = block_of_face, .first = {"b_face", ""}, .next = {"face_next", "block.face.next"},
     .array = "block.facelist"},
    {.from = contact, .to = sub_contact, .list = span<&Model::contacts, &Contacts::sub_contacts>, .owner = owner<&Model::sub_contacts, &SubContacts::contact>, .first = {"c_cx", ""},
     .next = {"cx_next", "block.subcontact.next"}, .array = "block.contact.subcontactlist"},
    {.from = face, .to = corner, .list = corners_of_face, .owner = face_of_corner, .skips = named_before, .first = {"face_vlist", ""}, .next = {"vl_next", ""}},
    {.from = zone, .to = gridpoint, .numbered = corners_of_zone, .first = {"z_gp", "block.zone.gp"}},
    {.from = face, .to = gridpoint, .numbered = face_gridpoints, .first = {"face_gp", "block.face.gp"}},
    {.from = contact, .to = contact, .one = contact_of_same_block<1>, .first = {"c_link1", ""}},
    {.from = contact, .to = contact, .one = contact_of_same_block<2>, .first = {"c_link2", ""}},
}};
// clang-format on

} // namespace

std::span<const KindInfo> kinds() { return all_kinds; }

const KindInfo& info_of(ObjectKind kind) { return all_kinds[static_cast<std::size_t>(kind)]; }

ObjectKind recorded_kind(std::int32_t history) {
    const auto found = std::ranges::find(all_kinds, history, &KindInfo::history);
    return history < 0 || found == all_kinds.end() ? ObjectKind::none : found->kind;
}

std::span<const Relation> relations() { return all_relations; }

} // namespace kaya
