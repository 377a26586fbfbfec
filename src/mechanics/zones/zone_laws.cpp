#include "mechanics/zones/tile_rows.hpp"
#include "base/number_text.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include "laws/zone_trial.hpp"
#include "mechanics/common/remedy.hpp"
#include "model/measure/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace kaya {

namespace {

/// Constitutive numbers of `change cons`.
constexpr std::array<const char*, 2> models_of_numbers{"elastic", "mohr-coulomb"};

/// Words of materials that every deck may use for blocks.
struct MaterialWord {
    std::string_view word;
    double Material::*value;
};
constexpr std::array<MaterialWord, 6> material_words{{{"bulk", &Material::bulk},
                                                      {"shear", &Material::shear},
                                                      {"bcohesion", &Material::cohesion},
                                                      {"bfriction", &Material::friction},
                                                      {"btension", &Material::tension},
                                                      {"bdilation", &Material::dilation}}};

bool stands_for(const LawTable::Property& property, std::string_view word) {
    return property.name == word || std::ranges::find(property.aliases, word) != property.aliases.end();
}

const Material& material_of(const Model& model, std::int32_t number) {
    static const Material none;
    const auto found = model.materials.find(number);
    return found == model.materials.end() ? none : found->second;
}

/// Values by block material, `zone model` and its own values.
std::vector<double> values_of(const ZoneModel& zone_model, const Material& material, const ZoneProperties& given) {
    std::vector<double> values;
    for (const auto& property : zone_model.properties) {
        const auto own =
            std::ranges::find_if(given.values, [&](const auto& entry) { return stands_for(property, entry.first); });
        values.push_back(own != given.values.end() ? own->second : value_for_material(property, material));
    }
    return values;
}

std::string about_block(const Model& model, Row block, const std::string& message) {
    return fmt::format("block {} (material {}) {}", model.blocks.number[block], model.blocks.material[block], message);
}

template <class Mistake> [[noreturn]] void refuse(Mistake mistake, const ZoneProperties& given) {
    mistake.code = "property-missing";
    if (!given.place.empty()) mistake.add("its zone model was given at " + given.place);
    throw mistake;
}

void check_values(const Model& model, Row block, const ZoneModel& zone_model, const std::vector<double>& values,
                  const ZoneProperties& given) {
    const std::string material = std::to_string(model.blocks.material[block]);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& property = zone_model.properties[i];
        if (std::isnan(values[i])) {
            if (property.optional) continue;
            if (property.name == "bulk" || property.name == "shear")
                refuse(Advised(about_block(model, block, "has no elastic moduli"), Advice::give_moduli, {material}),
                       given);
            refuse(Advised(
                       about_block(model, block,
                                   fmt::format("has no {}, which zone model {} needs", property.name, zone_model.name)),
                       Advice::give_material_value, {material, property.name}),
                   given);
        }
        if (property.holds(values[i])) continue;
        refuse(Advised(about_block(model, block,
                                   fmt::format("has {} {}, but for zone model {} it must be {}", property.name,
                                               values[i], zone_model.name, property.limits_in_words())),
                       Advice::change_material_value, {material, property.name}),
               given);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
        if ((zone_model.properties[i].name == "bulk" || zone_model.properties[i].name == "shear") && !(values[i] > 0))
            refuse(Advised(about_block(model, block, "has no stiffness: its bulk and shear moduli must be above 0"),
                           Advice::give_moduli, {material}),
                   given);
    if (const std::string complaint = zone_model.check(values); !complaint.empty())
        refuse(Diagnostic(about_block(
                   model, block,
                   fmt::format("cannot have these properties of zone model {}: {}", zone_model.name, complaint))),
               given);
}

/// Whether a strength is excluded from reduction. Its name identifies its kind.
bool keeps(std::uint8_t unreduced, const LawTable::Property& property) {
    constexpr std::pair<std::uint8_t, std::string_view> names[] = {
        {keep_friction, "friction"}, {keep_cohesion, "cohesion"}, {keep_tension, "tension"}};
    return std::ranges::any_of(names, [&](const auto& kept) {
        return (unreduced & kept.first) != 0 && property.name.find(kept.second) != std::string::npos;
    });
}

/// The value of a property with the strength divided by a factor.
double reduced(const LawTable::Property& property, double value, double factor) {
    constexpr double radian = 0.017453292519943295;
    if (factor == 1) return value;
    if (property.reduction == KAYA_ZREDUCE_DIVIDE) return value / factor;
    if (property.reduction == KAYA_ZREDUCE_MULTIPLY) return value * factor;
    if (property.reduction == KAYA_ZREDUCE_TANGENT) return std::atan(std::tan(value * radian) / factor) / radian;
    return value;
}

/// The property that has the same name but for one word; none where this word is not in it, or there is no such property.
std::optional<std::size_t> counterpart(const ZoneModel& zone_model, std::string name, std::string_view word,
                                       std::string_view other) {
    const auto at = name.find(word);
    if (at == std::string::npos) return std::nullopt;
    name.replace(at, word.size(), other);
    const auto found = std::ranges::find(zone_model.properties, name, &LawTable::Property::name);
    if (found == zone_model.properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - zone_model.properties.begin());
}

void let_flow_associated(const ZoneModel& zone_model, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const auto friction = counterpart(zone_model, zone_model.properties[i].name, "dilation", "friction"))
            values[i] = values[*friction];
}

Together together_of(const Model& model, const ZoneModel& zone_model, bool has_cells) {
    if (!zone_model.flows() && has_cells) return Together::cells;
    if (zone_model.flows() && (model.unreduced & strains_are_shared) != 0) return Together::strains_at_points;
    if (has_cells) return Together::flow_in_cells;
    return model.settings.mixed_discretisation ? Together::at_points : Together::nothing;
}

} // namespace

bool can_flow_associated(const ZoneModel& zone_model) {
    bool any = false;
    for (const auto& property : zone_model.properties) {
        if (property.name.find("friction") == std::string::npos) continue;
        any = true;
        if (!counterpart(zone_model, property.name, "friction", "dilation")) return false;
    }
    return any;
}

std::string zone_model_of(const Model& model, Row block) {
    const auto& given = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])];
    if (!given.model.empty()) return given.model;
    const auto number = model.blocks.constitutive[block];
    if (number >= 1 && static_cast<std::size_t>(number) <= models_of_numbers.size())
        return models_of_numbers[number - 1];
    Advised d(fmt::format("constitutive number {} of block {} means no zone model", number, model.blocks.number[block]),
              Advice::name_zone_model);
    d.code = "zone-model-unknown";
    throw d;
}

std::vector<double> zone_model_values(const Model& model, Row block, const ZoneModel& zone_model) {
    const auto row = static_cast<std::size_t>(model.blocks.zone_properties[block]);
    return values_of(zone_model, material_of(model, model.blocks.material[block]), model.zone_properties[row]);
}

double value_for_material(const LawTable::Property& property, const Material& material) {
    for (const auto& [word, value] : material_words)
        if (stands_for(property, word)) return material.*value;
    for (const auto* words : {&material.zone, &material.joint})
        for (const auto& [word, value] : *words)
            if (stands_for(property, word)) return value;
    return property.initial;
}

void forget_zones(Model& model, Row block) {
    const Span span = model.blocks.zones[block];
    for (Row z = span.first; z < span.end(); ++z) model.zones.forget(z);
}

ZoneLaws::ZoneLaws(Model& model, ZoneModels& models) : law_of_(model.blocks.size(), no_row) {
    using Key = std::tuple<std::string, std::int32_t, Row, bool>; // equal keys have equal values
    std::map<Key, Row> known;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks.deformable[b]) continue;
        const Row block = static_cast<Row>(b), row = model.blocks.zone_properties[b];
        const std::string name = zone_model_of(model, block);
        const bool has_cells = model.blocks.cell_zones[b] == zones_of_cell;
        const auto [found, is_new] =
            known.try_emplace(Key{name, model.blocks.material[b], row, has_cells}, static_cast<Row>(laws.size()));
        if (is_new) {
            const ZoneModel& zone_model = models.get(name);
            const auto& given = model.zone_properties[static_cast<std::size_t>(row)];
            auto values = values_of(zone_model, material_of(model, model.blocks.material[b]), given);
            check_values(model, block, zone_model, values, given);
            const auto [bulk, shear] = zone_model.moduli(values);
            try_zone(zone_model, values);
            for (std::size_t i = 0; i < values.size(); ++i)
                if (!keeps(model.unreduced, zone_model.properties[i]))
                    values[i] = reduced(zone_model.properties[i], values[i], model.settings.strength_factor);
            if ((model.unreduced & flow_is_associated) != 0) let_flow_associated(zone_model, values);
            const Together together = together_of(model, zone_model, has_cells);
            laws.push_back({&zone_model, std::move(values), {bulk - 2.0 / 3.0 * shear, 2 * shear}, together});
            model.zones.keep_history(zone_model.history.size());
        }
        law_of_[b] = found->second;
    }
    const auto law_of = [&](Row zone) { return static_cast<std::size_t>(law_of_[model.zones.block[zone]]); };
    tiles = ZoneTiles(model, law_of, [&](std::size_t law) { return by_cells(laws[law].together) ? zones_of_cell : 1; });
    if (std::ranges::any_of(laws, by_cells, &ZoneLaw::together)) model.zones.keep_warps();
}

std::vector<ElasticConstants> ZoneLaws::elastic_constants() const {
    std::vector<ElasticConstants> constants(law_of_.size());
    for (std::size_t b = 0; b < constants.size(); ++b)
        if (law_of_[b] != no_row) constants[b] = of_block(static_cast<Row>(b)).elastic;
    return constants;
}

Diagnostic failed_zone(const Model& model, const ZoneLaw& law, Row zone, const ZoneFailure& failure) {
    const Row block = model.zones.block[zone];
    const Vec3 centre = zone_centroid(model, zone);
    Diagnostic d(failure.message,
                 failure.trespass ? "results since the start of the run may be wrong; correct its source: " +
                                        law.model->file.string()
                                  : "look at the model's properties and at how fast the zones are loaded",
                 Fault::run);
    d.code = failure.trespass ? "zone-model-trespass" : "zone-model-failed";
    d.add(fmt::format("zone {} of block {}, at {}", zone + 1, model.blocks.number[block], place_text(centre)));
    const auto& place = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])].place;
    if (!place.empty()) d.add(fmt::format("zone model '{}' was given at {}", law.model->name, place));
    return d;
}

bool can_be_reduced(const ZoneModel& model) {
    return std::ranges::any_of(model.properties, [](const auto& p) { return p.reduction != KAYA_ZREDUCE_NONE; });
}

bool ZoneLaws::any(Together together) const {
    return std::ranges::find(laws, together, &ZoneLaw::together) != laws.end();
}

} // namespace kaya
