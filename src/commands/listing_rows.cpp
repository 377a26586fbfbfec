// Lists of objects: one line for each row of a table that the range picks.
#include "commands/joint_values.hpp"
#include "commands/listing.hpp"

#include "mechanics/contact_properties.hpp"
#include "model/excavation.hpp"
#include "model/groups.hpp"
#include "model/measure.hpp"

#include <array>
#include <fmt/format.h>
#include <map>

namespace kaya {

namespace {

std::string numbers(const Vec3& v) {
    return fmt::format("{}, {}, {}", number_text(v[0]), number_text(v[1]), number_text(v[2]));
}

std::string fixity_text(const Model& model, std::uint8_t fixed, std::int32_t roller) {
    static constexpr std::array names{"x", "y", "z", "rx", "ry", "rz"};
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
    for (std::size_t i = 0; i < names.size(); ++i)
        if ((fixed & (1u << i)) != 0) add(names[i]);
    const Roller& held = model.rollers[static_cast<std::size_t>(roller)];
    for (std::int32_t k = 0; k < held.count; ++k) add(numbers(held.direction[static_cast<std::size_t>(k)]));
    return text.empty() ? "-" : text;
}

/// Visible rows in range. None is an answer, not a mistake.
std::vector<Row> shown_rows(Session& session, const lang::List& command, ObjectKind kind) {
    if (info_of(kind).found_late) find_contacts(session.model, session.joints);
    return select(session.model, kind, session.test_of(kind, command.range));
}

/// A line for each row, up to the longest table; the rest is counted.
template <class Line> std::string rows_text(const std::vector<Row>& rows, const lang::List& command, ObjectKind kind,
                                            std::vector<std::string> headings, Line line) {
    if (rows.empty()) return fmt::format("no {}{}", info_of(kind).plural, command.range.place ? " in range" : "");
    TextTable table(std::move(headings));
    for (const Row row : rows) {
        if (table.size() == longest_table) break;
        table.add(line(row));
    }
    std::string text = table.text();
    if (rows.size() > longest_table)
        text += fmt::format("\n... and {} more {}; a range picks which are shown", rows.size() - longest_table,
                            info_of(kind).plural);
    return text;
}

template <class Line> std::string rows_text(Session& session, const lang::List& command, ObjectKind kind,
                                            std::vector<std::string> headings, Line line) {
    return rows_text(shown_rows(session, command, kind), command, kind, std::move(headings), line);
}

std::string blocks_text(const Model& model, const std::vector<Row>& rows, const lang::List& command) {
    const auto& blocks = model.blocks;
    return rows_text(
        rows, command, ObjectKind::block,
        {"block", "kind", "region", "mat", "cons", "group", "centroid", "volume", "points", "zones", "fixed"},
        [&](Row row) -> std::vector<std::string> {
            return {std::to_string(blocks.number[row]),
                    blocks.deformable[row] ? "deformable" : "rigid",
                    std::to_string(blocks.region[row]),
                    std::to_string(blocks.material[row]),
                    std::to_string(blocks.constitutive[row]),
                    blocks.group[row] == 0 ? "-" : model.group_names[blocks.group[row]],
                    numbers(blocks.centroid[row]),
                    number_text(blocks.volume[row]),
                    std::to_string(blocks.gridpoints[row].count),
                    std::to_string(blocks.zones[row].count),
                    blocks.deformable[row]
                        ? "-"
                        : fixity_text(model, blocks.fixed[row], model.gridpoints.roller[blocks.gridpoints[row].first])};
        });
}

const char* contact_type_text(ContactType type) {
    static constexpr std::array names{"-",         "face-face",   "face-edge",    "face-vertex",
                                      "edge-edge", "edge-vertex", "vertex-vertex"};
    return names[static_cast<std::size_t>(type)];
}

const JointProperties* properties_of(const Model& model, Row contact) {
    const Row row = model.contacts.properties[contact];
    return row == no_row ? nullptr : &model.joint_properties[row];
}

/// The names of the bits that are set.
std::string state_text(const Session& session, Row contact, std::uint32_t state) {
    const JointProperties* properties = properties_of(session.model, contact);
    const JointModel* joint = properties == nullptr ? nullptr : session.joints.find(properties->model);
    if (joint == nullptr || state == 0) return "-";
    std::string text;
    for (std::size_t i = 0; i < joint->states.size(); ++i)
        if ((state & (1u << i)) != 0) text += fmt::format("{}{}", text.empty() ? "" : " ", joint->states[i]);
    return text.empty() ? "-" : text;
}

} // namespace

std::string list_blocks(Session& session, const lang::List& command) {
    return blocks_text(session.model, shown_rows(session, command, ObjectKind::block), command);
}

std::string list_excavated(Session& session, const lang::List& command) {
    const Model kept = excavated_model(session.model);
    if (kept.blocks.empty()) return "no excavated blocks";
    const auto test = range_test(kept, session.ranges, command.range, ObjectKind::block, session.range_extras(true));
    return blocks_text(kept, select(kept, ObjectKind::block, test), command);
}

std::string list_gridpoints(Session& session, const lang::List& command) {
    const auto& points = session.model.gridpoints;
    return rows_text(session, command, ObjectKind::gridpoint,
                     {"gridpoint", "block", "position", "displacement", "velocity", "force", "fixed"},
                     [&](Row row) -> std::vector<std::string> {
                         return {std::to_string(row + 1),
                                 std::to_string(session.model.blocks.number[points.block[row]]),
                                 numbers(points.position[row]),
                                 numbers(points.displacement[row]),
                                 numbers(gridpoint_velocity(session.model, row)),
                                 numbers(points.force[row]),
                                 fixity_text(session.model, points.fixed[row], points.roller[row])};
                     });
}

std::string list_boundary(Session& session, const lang::List& command) {
    const auto& points = session.model.gridpoints;
    TextTable table({"gridpoint", "block", "position", "held", "velocity", "load"});
    std::size_t more = 0;
    for (const Row row : shown_rows(session, command, ObjectKind::gridpoint)) {
        const Row block = points.block[row];
        const bool rigid = !session.model.blocks.deformable[block];
        const std::uint8_t held = rigid ? session.model.blocks.fixed[block] : points.fixed[row];
        if (held == 0 && points.roller[row] == 0 && points.load[row].isZero()) continue;
        if (table.size() == longest_table) {
            ++more;
            continue;
        }
        table.add({std::to_string(row + 1), std::to_string(session.model.blocks.number[block]),
                   numbers(points.position[row]), fixity_text(session.model, held, points.roller[row]),
                   numbers(gridpoint_velocity(session.model, row)), numbers(points.load[row])});
    }
    if (table.size() == 0) return "no boundary conditions";
    return table.text() +
           (more == 0 ? "" : fmt::format("\n... and {} more gridpoints; a range picks which are shown", more));
}

std::string list_zones(Session& session, const lang::List& command) {
    const auto& zones = session.model.zones;
    return rows_text(session, command, ObjectKind::zone,
                     {"zone", "block", "centroid", "volume", "sxx", "syy", "szz", "sxy", "sxz", "syz"},
                     [&](Row row) -> std::vector<std::string> {
                         std::vector<std::string> words{
                             std::to_string(row + 1), std::to_string(session.model.blocks.number[zones.block[row]]),
                             numbers(zone_centroid(session.model, row)), number_text(zones.volume[row])};
                         for (int k = 0; k < 6; ++k) words.push_back(number_text(zones.stress[row][k]));
                         return words;
                     });
}

std::string list_faces(Session& session, const lang::List& command) {
    const auto& model = session.model;
    return rows_text(session, command, ObjectKind::face,
                     {"face", "block", "position", "normal", "area", "jset", "group"},
                     [&](Row row) -> std::vector<std::string> {
                         const Vec3 area = face_area_vector(model, row);
                         const std::int32_t group = group_of(model, ObjectKind::face, row);
                         return {std::to_string(row + 1),
                                 std::to_string(model.blocks.number[model.faces.block[row]]),
                                 numbers(face_centroid(model, row)),
                                 numbers(area.normalized()),
                                 number_text(area.norm()),
                                 std::to_string(model.faces.joint_set[row]),
                                 group == 0 ? "-" : model.group_names[group]};
                     });
}

std::string list_stresses(Session& session, const lang::List& command) {
    const auto& model = session.model;
    return rows_text(session, command, ObjectKind::zone,
                     {"zone", "block", "centroid", "s1", "s2", "s3", "mean", "shear"},
                     [&](Row row) -> std::vector<std::string> {
                         const Vec3 s = principal_stresses(model, row);
                         return {std::to_string(row + 1),
                                 std::to_string(model.blocks.number[model.zones.block[row]]),
                                 numbers(zone_centroid(model, row)),
                                 number_text(s[0]),
                                 number_text(s[1]),
                                 number_text(s[2]),
                                 number_text(s.mean()),
                                 number_text(0.5 * (s[2] - s[0]))};
                     });
}

std::string list_contacts(Session& session, const lang::List& command) {
    const auto& model = session.model;
    const auto& contacts = model.contacts;
    return rows_text(session, command, ObjectKind::contact,
                     {"contact", "block1", "block2", "touch", "position", "normal", "area", "points", "jmat", "jmodel"},
                     [&](Row row) -> std::vector<std::string> {
                         const JointProperties* properties = properties_of(model, row);
                         return {std::to_string(contacts.number[row]),
                                 std::to_string(model.blocks.number[contacts.block1[row]]),
                                 std::to_string(model.blocks.number[contacts.block2[row]]),
                                 contact_type_text(contacts.type[row]),
                                 numbers(contacts.position[row]),
                                 numbers(contacts.normal[row]),
                                 number_text(contacts.area[row]),
                                 std::to_string(contacts.sub_contacts[row].count),
                                 std::to_string(contacts.material[row]),
                                 properties == nullptr ? "-" : properties->model};
                     });
}

/// What one sub-contact has for itself: `list subcontacts 7`.
std::string history_text(Session& session, std::int64_t number) {
    const auto& points = session.model.sub_contacts;
    const auto found = std::ranges::find(points.number, static_cast<std::int32_t>(number));
    if (found == points.number.end()) return {};
    const auto row = static_cast<std::size_t>(found - points.number.begin());
    const JointProperties* properties = properties_of(session.model, points.contact[row]);
    const JointModel* joint = properties == nullptr ? nullptr : session.joints.find(properties->model);
    if (joint == nullptr) return {};
    TextTable table({"own value", "value", "unit", "meaning"});
    for (const auto& value : joint_values(*joint))
        if (const auto own = value.of(session.model, static_cast<Row>(row)))
            table.add({value.name, number_text(*own), value.unit, value.help});
    return table.size() == 0 ? std::string() : fmt::format("\n{}", table.text());
}

std::string list_sub_contacts(Session& session, const lang::List& command) {
    const auto& model = session.model;
    const auto& points = model.sub_contacts;
    const std::string rows =
        rows_text(session, command, ObjectKind::sub_contact,
                  {"sub-contact", "contact", "position", "area", "nforce", "sforce", "ndis", "sdis", "state"},
                  [&](Row row) -> std::vector<std::string> {
                      return {std::to_string(points.number[row]),
                              std::to_string(model.contacts.number[points.contact[row]]),
                              numbers(points.position[row]),
                              number_text(points.area[row]),
                              number_text(points.normal_force[row]),
                              number_text(points.shear_force[row].norm()),
                              number_text(points.normal_displacement[row]),
                              number_text(points.shear_displacement[row].norm()),
                              state_text(session, points.contact[row], points.state[row])};
                  });
    return command.number ? rows + history_text(session, *command.number) : rows;
}

std::string list_states(Session& session, const lang::List& command) {
    const auto& model = session.model;
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
        share.area += model.sub_contacts.area[row];
    }
    if (shares.empty()) return command.range.place ? "no sub-contacts in range" : "no sub-contacts";
    TextTable table({"jmodel", "state", "points", "area"});
    for (const auto& [name, share] : shares)
        table.add({name.first, name.second, std::to_string(share.count), number_text(share.area)});
    return table.text();
}

} // namespace kaya
