// zone model, zone property, zone load, zone nmd.
#include "commands/conditions/densities.hpp"
#include "commands/session/handlers.hpp"
#include "commands/review/property_meaning.hpp"
#include "commands/review/zone_moduli.hpp"
#include "laws/given_values.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/edit/excavation.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace kaya {

namespace {

const ZoneModel& model_named(Session& session, const lang::ZoneModelCommand& command) {
    try {
        return session.engine.joints.zones.get(command.model);
    } catch (Diagnostic& mistake) {
        mistake.at(command.model_place);
        throw;
    }
}

void take_out(Session& session, const lang::ZoneModelCommand& command, const std::vector<Row>& blocks) {
    if (!command.items.empty())
        throw Diagnostic(fmt::format("zone model {} has no property '{}'", no_rock, command.items.front().word),
                         "it means that nothing is there: omit the properties")
            .at(command.items.front().place);
    if (blocks.empty()) return;
    excavate_blocks(session.engine.model, blocks);
}

/// The values of a line by the names of the properties. Throws Diagnostic at the word that is wrong.
std::map<std::string, double> values_of(const ZoneModel& model, const std::vector<lang::Property::Item>& items) {
    std::map<std::string, double> values;
    const auto has = [&](const std::string& word) { return model.find_property(word).has_value(); };
    for (const auto& item : with_moduli(items, has)) {
        try {
            const auto found = accepting_property(model, zone_law.noun, item.word, item.value);
            values[model.properties[found].name] = item.value;
        } catch (Diagnostic& mistake) {
            mistake.at(item.place);
            throw;
        }
    }
    return values;
}

/// A row of Model::zone_properties with this content; an equal one is used again.
Row row_of(Model& model, const ZoneProperties& wanted) {
    auto& rows = model.zone_properties;
    const auto found = std::ranges::find_if(rows, [&](const ZoneProperties& row) {
        return row.model == wanted.model && row.values == wanted.values && row.place == wanted.place;
    });
    if (found != rows.end()) return static_cast<Row>(found - rows.begin());
    rows.push_back(wanted);
    return static_cast<Row>(rows.size() - 1);
}

} // namespace

void run(Session& session, const lang::ZoneModelCommand& command) {
    using Action = lang::ZoneModelCommand::Action;
    auto& model = session.engine.model;
    if (command.action == Action::load) {
        model_named(session, command);
        return;
    }
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (command.density) give_density(session, blocks, *command.density, !command.range.place);
    if (command.action == Action::properties && command.items.empty()) return;
    if (command.action == Action::assign && command.model == no_rock) return take_out(session, command, blocks);
    std::vector<ZoneProperties> wanted; // first all that may be wrong, then the model
    for (const Row block : blocks) {
        const auto& before = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])];
        const bool assign = command.action == Action::assign;
        const ZoneModel& zone_model =
            assign ? model_named(session, command) : session.engine.joints.zones.get(zone_model_of(model, block));
        ZoneProperties properties{zone_model.name, assign ? std::map<std::string, double>{} : before.values,
                                  session.deck.here()};
        for (const auto& [name, value] : values_of(zone_model, command.items)) properties.values[name] = value;
        wanted.push_back(std::move(properties));
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (zone_model_of(model, blocks[i]) != wanted[i].model) forget_zones(model, blocks[i]);
        model.blocks.zone_properties[blocks[i]] = row_of(model, wanted[i]);
        ModelEdit(model, Change::properties);
    }
}

void run(Session& session, const lang::ZoneAveraging& command) {
    session.engine.model.settings.mixed_discretisation = command.on;
    ModelEdit(session.engine.model, Change::properties);
}

void add_handlers(HandlerTable& table, lang::ZoneModelCommands list) { fill(table, list); }

} // namespace kaya
