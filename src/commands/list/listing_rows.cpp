// Lists of objects: one line for each row of a table that the range picks.
#include "commands/world/joint_values.hpp"
#include "commands/list/listing.hpp"
#include "commands/session/new_contacts.hpp"
#include "commands/list/subject_columns.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "model/edit/excavation.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/block_box.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/overlap_rows.hpp"

#include <array>
#include <fmt/format.h>
#include <map>

namespace kaya {

namespace {

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

/// Visible rows in range. None is an answer, not a mistake.
std::vector<Row> shown_rows(Session& session, const lang::List& command, ObjectKind kind) {
    if (info_of(kind).found_late) find_joints(session);
    auto rows = select(session.engine.model, kind, session.test_of(kind, command.range));
    if (std::ranges::none_of(session.engine.model.blocks.hidden, [](auto hidden) { return hidden != 0; })) return rows;
    const std::size_t all = select(session.engine.model, kind, session.test_of(kind, command.range), true).size();
    if (const std::size_t hidden = all - rows.size(); hidden > 0)
        session.note_once(
            fmt::format("the list leaves out {} of {} {}: they are hidden", hidden, all, info_of(kind).plural),
            session.deck.in_words("seek shows them", "block hide off shows them"));
    return rows;
}

/// A line for each row, up to the longest table; the rest is counted.
std::string rows_text(const Model& model, const Units& units, const std::vector<Row>& rows, ObjectKind kind,
                      const std::vector<ListColumn>& columns) {
    RowTable table(model, units, kind, columns);
    for (const Row row : rows) {
        if (table.size() == longest_table) break;
        table.add(row);
    }
    std::string text = table.text();
    if (rows.size() > longest_table)
        text += fmt::format("\n... and {} more {}; a range picks which are shown", rows.size() - longest_table,
                            info_of(kind).plural);
    return text;
}

std::string none_text(const lang::List& command, ObjectKind kind) {
    return fmt::format("no {}{}", info_of(kind).plural, command.range.place ? " in range" : "");
}

/// The table of all rows in range.
std::string rows_text(Session& session, const lang::List& command, ObjectKind kind,
                      const std::vector<ListColumn>& columns) {
    const std::vector<Row> rows = shown_rows(session, command, kind);
    if (rows.empty()) return none_text(command, kind);
    return rows_text(session.engine.model, session.deck.units, rows, kind, subject_columns(command, columns));
}

std::string blocks_text(const Model& model, const Units& units, const std::vector<Row>& rows,
                        const lang::List& command) {
    const auto& blocks = model.blocks;
    if (rows.empty()) return none_text(command, ObjectKind::block);
    const auto fixed = [&](Row row) -> std::string {
        if (blocks.deformable[row]) return "-";
        return fixity_text(model, blocks.fixed[row], model.gridpoints.roller[blocks.gridpoints[row].first]);
    };
    const std::vector<ListColumn> usual = {
        {"block", "id"},
        {"kind", [&](Row row) { return blocks.deformable[row] ? "deformable" : "rigid"; }},
        "region",
        {"mat", "material"},
        {"cons", "constitutive"},
        "group",
        {"centroid", "position"},
        "volume",
        {"points", [&](Row row) { return std::to_string(blocks.gridpoints[row].count); }},
        {"zones", [&](Row row) { return std::to_string(blocks.zones[row].count); }},
        {"fixed", fixed}};
    const std::vector<ListColumn> others = {
        {"least", [&](Row row) { return value_text(model, block_box(model, row).low); }},
        {"greatest", [&](Row row) { return value_text(model, block_box(model, row).high); }}};
    return rows_text(model, units, rows, ObjectKind::block, subject_columns(command, usual, others));
}

const JointProperties* properties_of(const Model& model, Row contact) {
    const Row row = model.contacts.properties[contact];
    return row == no_row ? nullptr : &model.joint_properties[row];
}

/// The names of the bits that are set.
std::string state_text(const Session& session, Row contact, std::uint32_t state) {
    const JointProperties* properties = properties_of(session.engine.model, contact);
    const JointModel* joint = properties == nullptr ? nullptr : session.engine.joints.find(properties->model);
    if (joint == nullptr || state == 0) return "-";
    std::string text;
    for (std::size_t i = 0; i < joint->states.size(); ++i)
        if ((state & (1u << i)) != 0) text += fmt::format("{}{}", text.empty() ? "" : " ", joint->states[i]);
    return text.empty() ? "-" : text;
}

} // namespace

std::string list_blocks(Session& session, const lang::List& command) {
    return blocks_text(session.engine.model, session.deck.units, shown_rows(session, command, ObjectKind::block),
                       command);
}

std::string list_excavated(Session& session, const lang::List& command) {
    const Model kept = excavated_model(session.engine.model);
    if (kept.blocks.empty()) return "no excavated blocks";
    const auto test =
        range_test(kept, session.deck.ranges, command.range, ObjectKind::block, session.range_extras(true));
    return blocks_text(kept, session.deck.units, select(kept, ObjectKind::block, test), command);
}

std::string list_gridpoints(Session& session, const lang::List& command) {
    const auto& points = session.engine.model.gridpoints;
    const auto fixed = [&](Row row) {
        return fixity_text(session.engine.model, points.fixed[row], points.roller[row]);
    };
    return rows_text(session, command, ObjectKind::gridpoint,
                     {{"gridpoint", "id"}, "block", "position", "displacement", "velocity", "force", {"fixed", fixed}});
}

std::string list_boundary(Session& session, const lang::List& command) {
    const auto& points = session.engine.model.gridpoints;
    const auto held_at = [&](Row row) {
        const Row block = points.block[row];
        return session.engine.model.blocks.deformable[block] ? points.fixed[row]
                                                             : session.engine.model.blocks.fixed[block];
    };
    std::vector<Row> rows = shown_rows(session, command, ObjectKind::gridpoint);
    std::erase_if(rows,
                  [&](Row row) { return held_at(row) == 0 && points.roller[row] == 0 && points.load[row].isZero(); });
    if (rows.empty()) return "no boundary conditions";
    const auto held = [&](Row row) { return fixity_text(session.engine.model, held_at(row), points.roller[row]); };
    return rows_text(session.engine.model, session.deck.units, rows, ObjectKind::gridpoint,
                     {{"gridpoint", "id"}, "block", "position", {"held", held}, "velocity", "load"});
}

std::string list_zones(Session& session, const lang::List& command) {
    const auto& zones = session.engine.model.zones;
    return rows_text(session, command, ObjectKind::zone,
                     {{"zone", "id"},
                      "block",
                      {"centroid", "position"},
                      {"volume", [&](Row row) { return number_text(zones.volume[row]); }}, // when made
                      {"sxx", "xx_stress"},
                      {"syy", "yy_stress"},
                      {"szz", "zz_stress"},
                      {"sxy", "xy_stress"},
                      {"sxz", "xz_stress"},
                      {"syz", "yz_stress"}});
}

std::string list_faces(Session& session, const lang::List& command) {
    return rows_text(session, command, ObjectKind::face,
                     {{"face", "id"}, "block", "position", "normal", "area", {"jset", "joint_set"}, "group"});
}

std::string list_stresses(Session& session, const lang::List& command) {
    const auto stress_of = [&](Row row) { return principal_stresses(session.engine.model, row); };
    const auto shear = [&](Row row) {
        const Vec3 s = stress_of(row);
        return number_text(0.5 * (s[2] - s[0]));
    };
    return rows_text(session, command, ObjectKind::zone,
                     {{"zone", "id"},
                      "block",
                      {"centroid", "position"},
                      {"s1", "principal_stress_1"},
                      {"s2", "principal_stress_2"},
                      {"s3", "principal_stress_3"},
                      {"mean", [&](Row row) { return number_text(stress_of(row).mean()); }},
                      {"shear", shear}});
}

std::string list_contacts(Session& session, const lang::List& command) {
    const auto& contacts = session.engine.model.contacts;
    return rows_text(session, command, ObjectKind::contact,
                     {{"contact", "id"},
                      "block1",
                      "block2",
                      {"touch", [&](Row row) { return contact_type_text(contacts.type[row]); }},
                      "position",
                      "normal",
                      "area",
                      {"points", [&](Row row) { return std::to_string(contacts.sub_contacts[row].count); }},
                      {"jmat", "material"},
                      {"jmodel", "model"}});
}

/// Own values of one sub-contact: `list subcontacts 7`.
std::string history_text(Session& session, std::int64_t number) {
    const auto& points = session.engine.model.sub_contacts;
    const auto found = std::ranges::find(points.number, static_cast<std::int32_t>(number));
    if (found == points.number.end()) return {};
    const auto row = static_cast<std::size_t>(found - points.number.begin());
    const JointProperties* properties = properties_of(session.engine.model, points.contact[row]);
    const JointModel* joint = properties == nullptr ? nullptr : session.engine.joints.find(properties->model);
    if (joint == nullptr) return {};
    TextTable table({"own value", "value", "unit", "meaning"});
    for (const auto& value : joint_values(*joint))
        if (const auto own = value.of(session.engine.model, static_cast<Row>(row)))
            table.add({value.name, number_text(*own), value.unit, value.help});
    return table.size() == 0 ? std::string() : fmt::format("\n{}", table.text());
}

std::string list_sub_contacts(Session& session, const lang::List& command) {
    const auto& points = session.engine.model.sub_contacts;
    const auto state = [&](Row row) { return state_text(session, points.contact[row], points.state[row]); };
    const std::string rows = rows_text(session, command, ObjectKind::sub_contact,
                                       {{"sub-contact", "id"},
                                        "contact",
                                        "position",
                                        "area",
                                        {"nforce", "normal_force"},
                                        {"sforce", "shear_force"},
                                        {"ndis", "normal_displacement"},
                                        {"sdis", "shear_displacement"},
                                        {"state", state}});
    return command.number ? rows + history_text(session, *command.number) : rows;
}

std::string list_states(Session& session, const lang::List& command) {
    const auto& model = session.engine.model;
    struct Share {
        std::size_t count = 0;
        double area = 0;
    };
    std::map<std::pair<std::string, std::string>, Share> shares;
    for (const Row row : shown_rows(session, command, ObjectKind::sub_contact)) {
        const Row contact = model.sub_contacts.contact[row];
        const JointProperties* properties = properties_of(model, contact);
        Share& share = shares[{properties == nullptr ? "-" : properties->model,
                               state_text(session, contact, model.sub_contacts.state[row])}];
        ++share.count;
        share.area += pressed_area(model, row);
    }
    if (shares.empty()) return command.range.place ? "no sub-contacts in range" : "no sub-contacts";
    TextTable table({"jmodel", "state", "points", "area"});
    for (const auto& [name, share] : shares)
        table.add({name.first, name.second, std::to_string(share.count), number_text(share.area)});
    return table.text();
}

} // namespace kaya
