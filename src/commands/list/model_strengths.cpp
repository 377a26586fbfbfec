#include "commands/list/model_strengths.hpp"

#include "laws/property_roles.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {

namespace {

/// Properties of a law with their values, by whole name.
class Values {
public:
    Values(const LawTable& law, const std::vector<double>& values) : law_(law), values_(values) {}

    std::optional<double> of(std::string_view name) const {
        const auto found = std::ranges::find(law_.properties, name, &LawTable::Property::name);
        if (found == law_.properties.end()) return std::nullopt;
        const double value = values_[static_cast<std::size_t>(found - law_.properties.begin())];
        if (std::isnan(value)) return std::nullopt;
        return value;
    }

private:
    const LawTable& law_;
    const std::vector<double>& values_;
};

/// The mean of the rows of a contact by their area, of the tangent of friction.
std::optional<Strength> coulomb_of_rows(const Model& model, const JointModel& law, Row contact) {
    constexpr double degree = std::numbers::pi / 180;
    const Span span = model.contacts.sub_contacts[contact];
    double tangent = 0, cohesion = 0, whole = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        const auto strength = row_strength(model, law, s);
        if (!strength) return std::nullopt;
        if (is_unloaded(model, contact, s)) continue;
        const double area = model.sub_contacts.area[s];
        tangent += area * std::tan(strength->friction * degree);
        cohesion += area * strength->cohesion;
        whole += area;
    }
    if (!(whole > 0)) return std::nullopt;
    return Strength::coulomb(cohesion / whole, std::atan(tangent / whole) / degree);
}

std::optional<Strength> coulomb_of(std::optional<double> friction, std::optional<double> cohesion) {
    if (!friction && !cohesion) return std::nullopt;
    return Strength::coulomb(cohesion.value_or(0), friction.value_or(0));
}

/// Equations (2.13) and (2.14) of docs/joint-models/barton-bandis.md.
std::optional<Strength> barton_of(const Values& values) {
    const auto friction = values.of("friction-residual"), jrc = values.of("jrco"), jcs = values.of("jcso");
    if (!friction || !jrc || !jcs) return std::nullopt;
    const double sample = values.of("lo").value_or(100 * values.of("mm").value_or(1e-3)),
                 joint = values.of("ln").value_or(sample);
    const double size = values.of("large").value_or(0) == 1 ? 1 : joint / sample;
    return Strength::barton({*friction, *jrc * std::pow(size, -0.02 * *jrc), *jcs * std::pow(size, -0.03 * *jrc)});
}

std::optional<Strength> hoek_brown_of(const Values& values) {
    const auto strength = values.of("constant-sci"), mb = values.of("constant-mb"), s = values.of("constant-s"),
               a = values.of("constant-a");
    if (!strength || !mb || !s || !a) return std::nullopt;
    return Strength::hoek_brown({*strength, *mb, *s, *a});
}

} // namespace

std::optional<Strength> rock_strength(const Model& model, JointRegistry& laws, Row block) {
    const ZoneModel& law = laws.zones.get(zone_model_of(model, block));
    if (law.flows()) {
        const auto given = zone_model_values(model, block, law);
        const Values values(law, given);
        if (auto strength = hoek_brown_of(values)) return strength;
        return coulomb_of(values.of("friction"), values.of("cohesion"));
    }
    const auto material = model.materials.find(model.blocks.material[block]);
    if (material == model.materials.end() || (material->second.cohesion == 0 && material->second.friction == 0))
        return std::nullopt;
    return Strength::coulomb(material->second.cohesion, material->second.friction);
}

std::optional<RowStrength> row_strength(const Model& model, const JointModel& law, Row s) {
    const Row row = model.contacts.properties[model.sub_contacts.contact[s]];
    const auto& values = model.joint_properties[static_cast<std::size_t>(row)].values;
    const bool failed = model.sub_contacts.state[s] != 0;
    const auto value_of = [&](kaya_jrole peak, kaya_jrole residual) {
        const auto after = failed ? value_of_role(law, values, residual) : std::nullopt;
        return after ? after : value_of_role(law, values, peak);
    };
    const auto friction = value_of(KAYA_JROLE_FRICTION, KAYA_JROLE_FRICTION_RESIDUAL),
               cohesion = value_of(KAYA_JROLE_COHESION, KAYA_JROLE_COHESION_RESIDUAL);
    if (!friction && !cohesion) return std::nullopt;
    return RowStrength{friction.value_or(0), cohesion.value_or(0)};
}

bool has_failed(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    const auto first = model.sub_contacts.state.begin() + span.first;
    return std::any_of(first, first + span.count, [](std::uint32_t state) { return state != 0; });
}

std::optional<Strength> joint_strength(const Model& model, JointRegistry& laws, Row contact) {
    const Row row = model.contacts.properties[contact];
    if (row == no_row) return std::nullopt;
    const auto& set = model.joint_properties[static_cast<std::size_t>(row)];
    const JointModel& law = laws.get(set.model);
    if (!law.missing(set.values).empty()) return std::nullopt;
    const Values values(law, set.values);
    if (auto strength = barton_of(values)) return strength;
    return coulomb_of_rows(model, law, contact);
}

} // namespace kaya
