// list structures.
#include "commands/list/listing.hpp"

#include "commands/list/row_table.hpp"
#include "commands/session/session.hpp"
#include "model/structures/structures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

std::string state_text(std::uint8_t state, const char* now, const char* before) {
    if (state & broken) return "broken";
    return state & yields ? now : state & has_yielded ? before : "-";
}

std::string limit_text(double value) { return std::isinf(value) ? "-" : number_text(value); }

/// Properties that any number has, and those of cables unless only others are given.
std::string properties_text(const Structures& structures) {
    const bool cables = structures.members.empty() || !structures.cables.empty();
    std::vector<StructureProperty> shown;
    for (const auto& property : structure_properties())
        if ((cables && (property.users & cable_kind)) ||
            std::ranges::any_of(structures.properties, [&](const auto& set) { return is_given(set.second, property); }))
            shown.push_back(property);
    std::vector<std::string> headings{"property"};
    for (const auto& property : shown) headings.emplace_back(property.name);
    TextTable table(std::move(headings));
    for (const auto& [number, properties] : structures.properties) {
        std::vector<std::string> row{std::to_string(number)};
        for (const auto& property : shown) row.push_back(limit_text(properties.*property.value));
        table.add(std::move(row));
    }
    return table.text();
}

std::string cable_text(const Model& model, const Units& units, Row cable) {
    const auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[cable];
    const auto grout_state = [&](Row node) {
        return nodes.anchored[node] ? "anchored" : state_text(nodes.grout_state[node], "slips", "slipped");
    };
    const auto tension = [&](Row node) { return has_bar(nodes, node) ? number_text(nodes.bar_force[node]) : "-"; };
    const auto bar_state = [&](Row node) {
        return has_bar(nodes, node) ? state_text(nodes.bar_state[node], "yields", "yielded") : "-";
    };
    RowTable table(model, units, ObjectKind::cable_node,
                   {{"node", [&](Row node) { return std::to_string(node - span.first + 1); }},
                    "block",
                    "x",
                    "y",
                    "z",
                    "slip",
                    {"grout", [&](Row node) { return number_text(nodes.grout[node]); }},
                    {"grout state", grout_state},
                    {"bar tension", tension},
                    {"bar state", bar_state}});
    for (Row node = span.first; node < span.end() && table.size() < longest_table; ++node) table.add(node);
    return table.text();
}

std::string cables_text(const Model& model) {
    const auto& cables = model.structures.cables;
    const auto& nodes = model.structures.cable_nodes;
    TextTable table(
        {"cable", "property", "nodes", "in rock", "length", "largest tension", "largest slip", "grout", "bars"});
    for (Row cable = 0; cable < static_cast<Row>(cables.size()) && table.size() < longest_table; ++cable) {
        const Span span = cables.nodes[cable];
        double length = 0, tension = 0, slip = 0;
        std::uint8_t grout = 0, bars = 0;
        for (Row node = span.first; node < span.end(); ++node) {
            if (has_bar(nodes, node)) {
                length += (nodes.position[node + 1] - nodes.position[node]).norm();
                if (std::abs(nodes.bar_force[node]) > std::abs(tension)) tension = nodes.bar_force[node];
                bars |= nodes.bar_state[node];
            }
            if (std::abs(nodes.slip[node]) > std::abs(slip)) slip = nodes.slip[node];
            grout |= nodes.grout_state[node];
        }
        table.add({std::to_string(cables.number[cable]), std::to_string(cables.property[cable]),
                   std::to_string(span.count), std::to_string(nodes_in_rock(model, nodes, span)), number_text(length),
                   number_text(tension), number_text(slip), state_text(grout, "slips", "slipped"),
                   state_text(bars, "yields", "yielded")});
    }
    std::string text = table.size() > 0 ? table.text() + "\n" : std::string("no cables\n");
    if (cables.size() > longest_table) text += fmt::format("... and {} more cables\n", cables.size() - longest_table);
    return text;
}

/// The value with the largest size.
struct Largest {
    double value = 0;
    void add(double other) {
        if (std::abs(other) > std::abs(value)) value = other;
    }
};

double number_of(const Model& model, ObjectKind kind, const char* field, Row row) {
    return std::get<double>(find_field(kind, field)->get(model, row));
}

/// One line of members_text.
std::vector<std::string> member_row(const Model& model, Row member) {
    const auto& members = model.structures.members;
    const auto& nodes = model.structures.member_nodes;
    const bool beam = members.kind[member] == beam_kind;
    const Span own = members.nodes[member], elements = beam ? members.beams[member] : members.liners[member];
    const ObjectKind kind = beam ? ObjectKind::beam_element : ObjectKind::liner_element;
    double size = 0;
    Largest force, moment;
    std::uint8_t state = 0, links = 0;
    for (Row row = elements.first; row < elements.end(); ++row) {
        size += number_of(model, kind, beam ? "length" : "area", row);
        force.add(number_of(model, kind, beam ? "axial_force" : "membrane_1", row));
        if (!beam) force.add(number_of(model, kind, "membrane_2", row));
        moment.add(number_of(model, kind, beam ? "moment" : "moment_1", row));
        if (!beam) moment.add(number_of(model, kind, "moment_2", row));
        if (beam) state |= model.structures.beams.state[row];
    }
    double mass = 0, inertial = 0;
    for (Row node = own.first; node < own.end(); ++node) {
        links |= nodes.link_state[node];
        const Hold hold = hold_of(model, node);
        if (hold == Hold::pinned || hold == Hold::clamped) continue;
        mass += nodes.mass[node];
        inertial += nodes.inertial_mass[node];
    }
    return {std::to_string(members.number[member]),
            beam ? "beam" : "liner",
            std::to_string(members.property[member]),
            std::to_string(elements.count),
            std::to_string(own.count),
            std::to_string(nodes_in_rock(model, nodes, own)),
            number_text(size),
            number_text(force.value),
            number_text(moment.value),
            beam ? state_text(state, "yields", "yielded") : "-",
            state_text(links, "slip", "slipped"),
            mass > 0 ? fmt::format("{:.3g}", inertial / mass) : "-"};
}

std::string members_text(const Model& model) {
    const auto& members = model.structures.members;
    TextTable table({"number", "kind", "property", "elements", "nodes", "on rock", "length or area", "largest force",
                     "largest moment", "state", "links", "inertia"});
    for (Row member = 0; member < static_cast<Row>(members.size()) && table.size() < longest_table; ++member)
        table.add(member_row(model, member));
    std::string text = table.text() + "\n";
    if (members.size() > longest_table) text += fmt::format("... and {} more\n", members.size() - longest_table);
    return text;
}

std::string elements_text(const Model& model, const Units& units, Row member) {
    const auto& members = model.structures.members;
    const bool beam = members.kind[member] == beam_kind;
    const Span span = beam ? members.beams[member] : members.liners[member];
    const ListColumn number{"element", [span](Row row) { return std::to_string(row - span.first + 1); }};
    const std::vector<ListColumn> of_beam{
        number,
        "x",
        "y",
        "z",
        {"axial", "axial_force"},
        {"shear y", "shear_y"},
        {"shear z", "shear_z"},
        "torsion",
        {"y first", "moment_y_first"},
        {"y last", "moment_y_last"},
        {"z first", "moment_z_first"},
        {"z last", "moment_z_last"},
        {"state", [&](Row row) { return state_text(model.structures.beams.state[row], "yields", "yielded"); }}};
    const std::vector<ListColumn> of_liner{number,
                                           "x",
                                           "y",
                                           "z",
                                           {"xx", "membrane_xx"},
                                           {"yy", "membrane_yy"},
                                           {"xy", "membrane_xy"},
                                           {"moment xx", "moment_xx"},
                                           {"moment yy", "moment_yy"},
                                           {"moment xy", "moment_xy"},
                                           {"greatest stress", "greatest_stress"},
                                           {"least stress", "least_stress"}};
    RowTable table(model, units, beam ? ObjectKind::beam_element : ObjectKind::liner_element,
                   beam ? of_beam : of_liner);
    for (Row row = span.first; row < span.end() && table.size() < longest_table; ++row) table.add(row);
    std::string text = table.text();
    if (static_cast<std::size_t>(span.count) > longest_table)
        text += fmt::format("\n... and {} more elements; kaya export writes all", span.count - longest_table);
    return text;
}

} // namespace

std::string list_structures(Session& session, const lang::List& command) {
    const Model& model = session.engine.model;
    const auto& cables = model.structures.cables;
    if (!model.structures.any()) return "no structures";
    if (command.number) {
        const auto number = static_cast<std::int32_t>(*command.number);
        if (const Row member = member_of_number(model, number); member != no_row)
            return elements_text(model, session.deck.units, member);
        const auto found = std::ranges::find(cables.number, number);
        if (found != cables.number.end())
            return cable_text(model, session.deck.units, static_cast<Row>(found - cables.number.begin()));
        return fmt::format("no structure {}", number);
    }
    std::string text;
    if (!cables.empty() || model.structures.members.empty()) text += cables_text(model);
    if (!model.structures.members.empty()) text += members_text(model);
    return text + properties_text(model.structures);
}

} // namespace kaya
