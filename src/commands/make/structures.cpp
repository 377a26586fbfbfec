// structure cable, structure beam, structure liner, structure property, structure delete.
#include "commands/session/handlers.hpp"
#include "mechanics/structures/keep_forces.hpp"
#include "model/structures/lining.hpp"
#include "model/kinds/selection.hpp"
#include "model/structures/structures.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

Grip grip_of(lang::StructureBeam::Grip grip) { return static_cast<Grip>(grip); }

/// Refuses elements too short for the resolution of the model's coordinates.
void check_lengths(const Model& model, const NewBeam& wanted, const Place& place) {
    double extent = model_size(model), shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < wanted.places.size(); ++k) {
        extent = std::max(extent, wanted.places[k].cwiseAbs().maxCoeff());
        if (k > 0) shortest = std::min(shortest, (wanted.places[k] - wanted.places[k - 1]).norm() / wanted.segments);
    }
    if (shortest > 1e-9 * extent) return;
    throw Diagnostic(fmt::format("elements of the beam would be {:.3g} long, in a model of {:.3g}", shortest, extent),
                     "give places that are farther from each other, or fewer segments")
        .at(place);
}

/// Warns of a beam without a node in the rock; its middle may be free.
void warn_of_free_beam(Session& session, const NewBeam& wanted, const Span& nodes, std::int32_t number,
                       const Place& place) {
    const Model& model = session.engine.model;
    const auto& points = model.structures.member_nodes;
    const std::int32_t inside = nodes_in_rock(model, points, nodes);
    for (const auto& [node, grip, end] :
         {std::tuple(nodes.first, wanted.first, "first"), std::tuple(nodes.end() - 1, wanted.last, "last")})
        if (grip != Grip::link && rock_block(model, points, node) == no_row)
            session.warn(Diagnostic(fmt::format("the {} node of beam {} is to be held and lies outside of all blocks",
                                                end, number),
                                    "nothing holds it there: put it into a block, or give a tolerance")
                             .at(place));
    if (inside == 0)
        session.warn(Diagnostic(fmt::format("all nodes of beam {} lie outside of all blocks; nothing holds it", number),
                                "make the blocks before, or give a tolerance")
                         .at(place));
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
    auto& model = session.engine.model;
    const Row cable = make_cable(model, wanted);
    const std::int32_t number = model.structures.cables.number[cable];
    const std::int32_t all = wanted.segments + 1, inside = nodes_in_rock(model, model.structures.cable_nodes,
                                                                         model.structures.cables.nodes[cable]);
    session.program.output.say(
        fmt::format("cable {}: {} bars, {:.6g} long", number, wanted.segments, (wanted.last - wanted.first).norm()));
    if (inside < all)
        session.warn(
            Diagnostic(fmt::format("{} of the {} nodes of cable {} lie outside of all blocks; nothing holds them there",
                                   all - inside, all, number),
                       inside == 0 ? "make the blocks before their cables, and look at its ends"
                                   : "shorten the cable, or make more segments")
                .at(command.place));
}

void run(Session& session, const lang::StructureBeam& command) {
    NewBeam wanted{.places = command.places,
                   .segments = static_cast<std::int32_t>(command.segments),
                   .property = static_cast<std::int32_t>(command.property),
                   .axis = command.axis.value_or(Vec3::Zero()),
                   .tolerance = command.tolerance,
                   .grip = grip_of(command.all),
                   .first = grip_of(command.first),
                   .last = grip_of(command.last)};
    auto& model = session.engine.model;
    check_lengths(model, wanted, command.place);
    const Row member = make_beam(model, wanted);
    const Span nodes = model.structures.members.nodes[member];
    const std::int32_t number = model.structures.members.number[member];
    double length = 0;
    for (std::size_t k = 1; k < wanted.places.size(); ++k) length += (wanted.places[k] - wanted.places[k - 1]).norm();
    session.program.output.say(fmt::format("beam {}: {} elements, {:.6g} long, {} of its {} nodes on the rock", number,
                                           nodes.count - 1, length,
                                           nodes_in_rock(model, model.structures.member_nodes, nodes), nodes.count));
    warn_of_free_beam(session, wanted, nodes, number, command.place);
}

void run(Session& session, const lang::StructureLiner& command) {
    constexpr double most = 2e6;
    auto& model = session.engine.model;
    const std::vector<Row> faces = session.pick(ObjectKind::face, command.range);
    const std::vector<Row> triangles =
        triangles_to_line(model, faces, session.pick(ObjectKind::gridpoint, command.range));
    const double expected = expected_triangles(model, triangles, command.edge);
    if (expected > most)
        throw Diagnostic(fmt::format("the liner would have about {:.2g} elements", expected),
                         "give a longer edge, or fewer faces");
    NewLiner wanted{.mesh = {},
                    .property = static_cast<std::int32_t>(command.property),
                    .axis = command.axis.value_or(Vec3::Zero()),
                    .tolerance = command.tolerance,
                    .grip = grip_of(command.grip)};
    Lining lining = line_triangles(model, triangles, command.edge, wanted.tolerance);
    if (lining.mesh.triangles.empty())
        throw Diagnostic(triangles.empty() ? "there is no face for the liner"
                                           : "other blocks cover all faces that the liner would lie on",
                         "name faces of an opening or of the outside: structure liner ... range ...");
    wanted.mesh = std::move(lining.mesh);
    const Row member = make_liner(model, wanted);
    const std::int32_t number = model.structures.members.number[member];
    session.program.output.say(fmt::format("liner {}: {} elements, {} nodes, area {:.6g}", number,
                                           wanted.mesh.triangles.size(), wanted.mesh.points.size(), lining.area));
    if (lining.partly > 0)
        session.warn(
            Diagnostic(
                fmt::format(
                    "{} triangles for liner {} lie on other blocks in parts; those whose middle is covered are left out",
                    lining.partly, number),
                "a shorter edge makes the border finer")
                .at(command.place));
}

void run(Session& session, const lang::StructureProperty& command) {
    auto& model = session.engine.model;
    auto& properties = model.structures.properties[static_cast<std::int32_t>(command.number)];
    const StructureProperties before = properties;
    for (const auto& item : command.items) {
        const auto found = std::ranges::find(structure_properties(), item.name, &StructureProperty::name);
        properties.*found->value = item.value;
    }
    // Friction alone is a strength, with cohesion zero.
    const auto given = [&](const char* name) {
        return std::ranges::any_of(command.items, [name](const auto& item) { return item.name == name; });
    };
    if (properties.grout_friction > 0 && !given("sbond") && std::isinf(properties.grout_cohesion))
        properties.grout_cohesion = 0;
    if (properties.link_friction > 0 && !given("cohesion") && std::isinf(properties.link_cohesion))
        properties.link_cohesion = 0;
    if (properties == before) return;
    keep_structure_forces(model, static_cast<std::int32_t>(command.number), before);
    ModelEdit(model, Change::properties);
}

void run(Session& session, const lang::StructureDelete& command) {
    auto& model = session.engine.model;
    const auto& structures = model.structures;
    std::vector<Row> cables, members;
    if (command.number) {
        const auto number = static_cast<std::int32_t>(*command.number);
        const auto found = std::ranges::find(structures.cables.number, number);
        const Row member = member_of_number(model, number);
        if (found != structures.cables.number.end())
            cables.push_back(static_cast<Row>(found - structures.cables.number.begin()));
        else if (member != no_row) members.push_back(member);
        else
            throw Diagnostic(fmt::format("there is no structure {}", number),
                             structures.stand() ? "list structures shows them" : "there are no structures");
    } else {
        const auto gather = [&](ObjectKind kind, const Column<Row>& owner, std::vector<Row>& gone) {
            if (owner.empty()) return;
            for (const Row node : session.pick(kind, command.range))
                if (gone.empty() || gone.back() != owner[node]) gone.push_back(owner[node]);
        };
        gather(ObjectKind::cable_node, structures.cable_nodes.cable, cables);
        gather(ObjectKind::structure_node, structures.member_nodes.member, members);
    }
    const auto are_beams = std::ranges::count_if(
        members, [&](Row member) { return structures.members.kind[member] == StructureKind::beam_kind; });
    const auto beams = static_cast<std::size_t>(are_beams), liners = members.size() - beams;
    if (!cables.empty()) delete_cables(model, cables);
    if (!members.empty()) delete_members(model, members);
    for (const auto& [count, noun] : {std::pair(cables.size(), "cable"), {beams, "beam"}, {liners, "liner"}})
        if (count > 0) session.program.output.say(fmt::format("{} {}{} taken out", count, noun, count == 1 ? "" : "s"));
}

void add_handlers(HandlerTable& table, lang::StructureCommands list) { fill(table, list); }

} // namespace kaya
