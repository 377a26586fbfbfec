// structure cable, structure property, structure delete, list structures.
#include "commands/handlers.hpp"
#include "commands/listing.hpp"
#include "commands/row_table.hpp"
#include "model/cables.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

/// How many nodes of a cable lie in the rock.
std::int32_t nodes_in_rock(const Model& model, const Span& nodes) {
    std::int32_t count = 0;
    for (Row node = nodes.first; node < nodes.end(); ++node) count += block_of_node(model, node) != no_row;
    return count;
}

std::string state_text(std::uint8_t state, const char* now, const char* before) {
    if (state & broken) return "broken";
    return state & yields ? now : state & has_yielded ? before : "-";
}

std::string limit_text(double value) { return std::isinf(value) ? "-" : number_text(value); }

std::string properties_text(const Structures& structures) {
    std::vector<std::string> headings{"property"};
    for (const auto& property : cable_properties()) headings.emplace_back(property.name);
    TextTable table(std::move(headings));
    for (const auto& [number, properties] : structures.properties) {
        std::vector<std::string> row{std::to_string(number)};
        for (const auto& property : cable_properties()) row.push_back(limit_text(properties.*property.value));
        table.add(std::move(row));
    }
    return table.text();
}

std::string nodes_text(const Model& model, Row cable) {
    const auto& nodes = model.structures.nodes;
    const Span span = model.structures.cables.nodes[cable];
    const auto grout_state = [&](Row node) {
        return nodes.anchored[node] ? "anchored" : state_text(nodes.grout_state[node], "slips", "slipped");
    };
    const auto tension = [&](Row node) { return has_bar(nodes, node) ? number_text(nodes.bar_force[node]) : "-"; };
    const auto bar_state = [&](Row node) {
        return has_bar(nodes, node) ? state_text(nodes.bar_state[node], "yields", "yielded") : "-";
    };
    RowTable table(model, ObjectKind::cable_node,
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

} // namespace

void run(Session& session, const lang::StructureCable& command) {
    NewCable wanted{.first = command.first,
                    .last = command.last,
                    .segments = static_cast<std::int32_t>(command.segments),
                    .property = static_cast<std::int32_t>(command.property),
                    .tension = command.tension,
                    .anchor_first = command.anchor_first,
                    .anchor_last = command.anchor_last};
    auto& model = session.model;
    const Row cable = make_cable(model, wanted);
    const std::int32_t number = model.structures.cables.number[cable];
    const std::int32_t all = wanted.segments + 1, inside = nodes_in_rock(model, model.structures.cables.nodes[cable]);
    session.output.say(
        fmt::format("cable {}: {} bars, {:.6g} long", number, wanted.segments, (wanted.last - wanted.first).norm()));
    if (inside < all)
        session.warn(
            Diagnostic(fmt::format("{} of the {} nodes of cable {} lie outside of all blocks; nothing holds them there",
                                   all - inside, all, number),
                       inside == 0 ? "make the blocks before their cables, and look at its ends"
                                   : "shorten the cable, or make more segments")
                .at(command.place));
}

void run(Session& session, const lang::StructureProperty& command) {
    auto& model = session.model;
    auto& properties = model.structures.properties[static_cast<std::int32_t>(command.number)];
    const CableProperties before = properties;
    for (const auto& item : command.items) {
        const auto found = std::ranges::find(cable_properties(), item.name, &CableProperty::name);
        properties.*found->value = item.value;
    }
    const bool given = std::ranges::any_of(command.items, [](const auto& item) { return item.name == "sbond"; });
    // Friction alone is a strength; the cohesion next to it is then none.
    if (properties.grout_friction > 0 && !given && std::isinf(properties.grout_cohesion)) properties.grout_cohesion = 0;
    if (properties != before) ModelEdit(model, Change::properties);
}

void run(Session& session, const lang::StructureDelete& command) {
    auto& model = session.model;
    const auto& cables = model.structures.cables;
    std::vector<Row> gone;
    if (command.number) {
        const auto found = std::ranges::find(cables.number, static_cast<std::int32_t>(*command.number));
        if (found == cables.number.end())
            throw Diagnostic(fmt::format("there is no cable {}", *command.number),
                             cables.empty() ? "there are no cables" : "list structures shows them");
        gone.push_back(static_cast<Row>(found - cables.number.begin()));
    } else {
        for (const Row node : session.pick(ObjectKind::cable_node, command.range)) {
            const Row cable = model.structures.nodes.cable[node];
            if (gone.empty() || gone.back() != cable) gone.push_back(cable);
        }
    }
    if (gone.empty()) return;
    delete_cables(model, gone);
    session.output.say(fmt::format("{} {} taken out", gone.size(), gone.size() == 1 ? "cable" : "cables"));
}

std::string list_structures(Session& session, const lang::List& command) {
    const Model& model = session.model;
    const auto& [cables, nodes, properties, next_number] = model.structures;
    if (cables.empty() && properties.empty()) return "no structures";
    if (command.number) {
        const auto found = std::ranges::find(cables.number, static_cast<std::int32_t>(*command.number));
        return found == cables.number.end() ? fmt::format("no cable {}", *command.number)
                                            : nodes_text(model, static_cast<Row>(found - cables.number.begin()));
    }
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
                   std::to_string(span.count), std::to_string(nodes_in_rock(model, span)), number_text(length),
                   number_text(tension), number_text(slip), state_text(grout, "slips", "slipped"),
                   state_text(bars, "yields", "yielded")});
    }
    std::string text = table.size() > 0 ? table.text() + "\n" : std::string("no cables\n");
    if (cables.size() > longest_table) text += fmt::format("... and {} more cables\n", cables.size() - longest_table);
    return text + properties_text(model.structures);
}

void add_handlers(HandlerTable& table, lang::StructureCommands list) { fill(table, list); }

} // namespace kaya
