// list interfaces, list reactions: forces between bodies and on supports, summed as people ask for them.
#include "commands/list/listing.hpp"
#include "commands/list/row_table.hpp"

#include "base/counted.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "commands/list/reactions.hpp"
#include "commands/list/interfaces.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/joint_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

std::string utilisation_text(const Session& session, const Interface& one) {
    const auto used = utilisation_of(session.engine.model, session.engine.joints, one);
    return used ? number_text(*used) : "-";
}

std::string name_of_group(const Model& model, std::int32_t group) {
    const std::string_view name = default_group(model, group);
    return name.empty() ? "-" : std::string(name);
}

/// Meshes may share a face in many pieces: the first ones are shown.
std::string corners_text(const Model& model, const Interface& one) {
    constexpr std::size_t most = 12;
    std::string text;
    std::size_t count = 0;
    for (const Row contact : one.contacts)
        for (const auto& polygon : joint_polygons(model, contact)) {
            if (++count > most) continue;
            std::vector<std::string> corners;
            for (const Vec3& corner : polygon) corners.push_back(place_text(corner));
            text += fmt::format("\npolygon: {}", fmt::join(corners, " "));
        }
    if (count > most) text += fmt::format("\n... and {} more polygons", count - most);
    return text;
}

} // namespace

std::string list_interfaces(Session& session, const lang::List& command) {
    find_contacts(session.engine.model, session.engine.joints);
    const Model& model = session.engine.model;
    const auto interfaces =
        interfaces_of(model, select(model, ObjectKind::contact, session.test_of(ObjectKind::contact, command.range)));
    if (interfaces.empty()) return fmt::format("no interfaces{}", command.range.place ? " in range" : "");
    TextTable table({"block1", "block2", "contacts", "area", "normal force", "shear force", "angle", "utilisation",
                     "force on block2", "acts at"});
    for (const Interface& one : interfaces) {
        if (table.size() == longest_table) break;
        const double angle = std::atan2(one.shear_force(), one.normal_force()) * 180 / std::numbers::pi;
        const bool loaded = one.force.norm() > 0;
        table.add({std::to_string(model.blocks.number[one.first]), std::to_string(model.blocks.number[one.second]),
                   std::to_string(one.contacts.size()), number_text(one.area), number_text(one.normal_force()),
                   number_text(one.shear_force()), loaded ? number_text(angle) : "-", utilisation_text(session, one),
                   vector_text(one.force), loaded ? place_text(one.point_of_action()) : "-"});
    }
    std::string text = table.text();
    if (interfaces.size() > longest_table)
        text += fmt::format("\n... and {} more; a range picks which are shown", interfaces.size() - longest_table);
    if (interfaces.size() == 1) text += corners_text(model, interfaces.front());
    return text;
}

std::string list_reactions(Session& session, const lang::List& command) {
    const Model& model = session.engine.model;
    const RangeTest test = session.test_of(ObjectKind::block, command.range);
    const Reactions reactions = reactions_of(model, [&](Row b) { return !test || test(model, ObjectKind::block, b); });
    if (reactions.groups.empty()) return fmt::format("no supports{}", command.range.place ? " in range" : "");
    TextTable table({"group", "held", "reaction", "own weight"});
    for (const Reaction& one : reactions.groups)
        table.add({name_of_group(model, one.group), counted(one.held, "block"), vector_text(one.force),
                   vector_text(one.weight)});
    return fmt::format("{}\nsum of reactions {}, weights {}, loads {}, unbalanced {}", table.text(),
                       vector_text(reactions.reaction), vector_text(reactions.weight), vector_text(reactions.load),
                       vector_text(reactions.unbalanced));
}

} // namespace kaya
