// Strengths, moduli and densities of blocks with zones that are valid, and implausible.
#include "commands/session/plausible.hpp"

#include "commands/session/session.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/kinds/selection.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace kaya {

namespace {

/// A block with zones for each zone model and material.
std::map<std::pair<std::string, std::int32_t>, Row> zoned_blocks(const Model& model) {
    std::map<std::pair<std::string, std::int32_t>, Row> found;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        if (model.blocks.zones[block].count == 0) continue;
        found.try_emplace({zone_model_of(model, block), model.blocks.material[block]}, block);
    }
    return found;
}

std::optional<double> value_of(const ZoneModel& law, const std::vector<double>& values, std::string_view name) {
    for (std::size_t k = 0; k < law.properties.size() && k < values.size(); ++k)
        if (law.properties[k].name == name) return values[k];
    return std::nullopt;
}

void say_once(Session& session, const std::string& message, const std::string& hint) {
    if (!session.program.said_once.insert(message).second) return;
    Diagnostic d(message, hint);
    d.code = "implausible";
    session.warn(std::move(d));
}

} // namespace

void doubt_zone_strengths(Session& session) {
    for (const auto& [law_and_material, block] : zoned_blocks(session.engine.model)) {
        const auto& [name, material] = law_and_material;
        const ZoneModel* law = session.engine.joints.zones.find(name);
        if (law == nullptr) continue;
        const auto values = zone_model_values(session.engine.model, block, *law);
        const auto cohesion = value_of(*law, values, "cohesion"), friction = value_of(*law, values, "friction"),
                   table = value_of(*law, values, "table-cohesion"), other = value_of(*law, values, "table-friction");
        if (!cohesion || !friction || *cohesion != 0 || *friction != 0 || table.value_or(0) > 0 ||
            other.value_or(0) > 0)
            continue;
        say_once(session,
                 fmt::format("zone model {} of material {} has neither cohesion nor friction: it carries no shear",
                             name, material),
                 session.deck.in_words("give them: zone property cohesion 1e6 friction 30",
                                       "give them: block zone property cohesion 1e6 friction 30"));
    }
}

void doubt_zone_words(Session& session) {
    const Model& model = session.engine.model;
    for (const auto& [law_and_material, block] : zoned_blocks(model)) {
        const auto& [name, number] = law_and_material;
        const auto found = model.materials.find(number);
        const ZoneModel* law = session.engine.joints.zones.find(name);
        if (found == model.materials.end() || law == nullptr) continue;
        const auto values = zone_model_values(model, block, *law);
        for (const auto& [word, value] : found->second.joint) {
            const auto given = session.deck.property_words.find({number, word});
            const auto property = law->find_property(word);
            if (given == session.deck.property_words.end() || given->second.of_joints || !property) continue;
            const auto& of_zones = law->properties[*property];
            if (values[*property] == value || values[*property] != of_zones.initial) continue;
            if (!session.program.said_once.insert(fmt::format("joint prop {} {}", number, word)).second) continue;
            session.warn(
                Diagnostic(fmt::format("'{}' of material {} went to its joints; its zones, {}, have no {}", word,
                                       number, name, of_zones.name),
                           fmt::format("give zones theirs with `zone property {}`, or write `prop jmat {}` for joints",
                                       of_zones.name, number))
                    .at(given->second.place));
        }
    }
}

void doubt_zone_magnitudes(Session& session) {
    const Model& model = session.engine.model;
    const double gravity = model.settings.gravity.norm(), size = model_size(model);
    for (const auto& [law_and_material, block] : zoned_blocks(model)) {
        const std::int32_t number = law_and_material.second;
        const auto found = model.materials.find(number);
        const ZoneModel* law = session.engine.joints.zones.find(law_and_material.first);
        if (found == model.materials.end() || law == nullptr) continue;
        const auto values = zone_model_values(model, block, *law);
        const double bulk = value_of(*law, values, "bulk").value_or(found->second.bulk),
                     shear = value_of(*law, values, "shear").value_or(found->second.shear),
                     density = found->second.density;
        if (!(bulk > 0) || !(density > 0)) continue;
        constexpr double soft = 0.1; // rock in a deck of Pa with moduli in MPa or GPa shrinks to nothing
        const double strain = density * gravity * size / bulk;
        if (strain > soft)
            say_once(
                session,
                fmt::format("material {}: bulk modulus {} under the weight of the model: it shrinks by {:.3g} of its "
                            "size",
                            number, number_text(bulk), strain),
                "are the moduli in MPa or GPa, and the rest in Pa?");
        // Gravity tells that lengths are metres and times seconds; nothing carries waves faster than diamond.
        constexpr double least = 9, most = 10.5, fastest = 2e4;
        const double speed = std::sqrt((bulk + 4 * std::max(shear, 0.0) / 3) / density);
        if (gravity > least && gravity < most && speed > fastest)
            say_once(
                session,
                fmt::format("material {}: waves would run at {:.3g} m/s with density {} and bulk modulus {}", number,
                            speed, number_text(density), number_text(bulk)),
                "rock has 1000 to 7000 m/s: are density and moduli of one system of units, kg and Pa or t and kPa?");
    }
}

} // namespace kaya
