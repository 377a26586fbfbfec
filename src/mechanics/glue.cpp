#include "mechanics/glue.hpp"

#include "mechanics/contact_table.hpp"
#include "mechanics/phases.hpp"
#include "mechanics/property_sets.hpp"
#include "model/joined.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace kaya {

namespace {

/// The part of a zone's edge that a spring stands for. Stiffer springs would shorten the time step for little: the zones
/// themselves are as soft as ten such layers.
constexpr double layer = 0.1;

struct Body {
    double volume = 0;
    std::size_t zones = 0;
    ElasticConstants stiffest; ///< of its blocks

    /// Of a regular tetrahedron as large as the mean zone.
    double edge() const { return std::cbrt(6 * std::numbers::sqrt2 * volume / static_cast<double>(zones)); }
};

std::map<std::int32_t, Body> zoned_bodies(const Model& model) {
    const auto& blocks = model.blocks;
    std::map<std::int32_t, Body> bodies;
    std::vector<ElasticConstants> elastic;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.body[b] == 0 || !blocks.deformable[b]) continue;
        if (elastic.empty()) elastic = elastic_constants(model);
        Body& body = bodies[blocks.body[b]];
        body.volume += blocks.volume[b];
        body.zones += static_cast<std::size_t>(blocks.zones[b].count);
        body.stiffest.lambda = std::max(body.stiffest.lambda, elastic[b].lambda);
        body.stiffest.two_shear = std::max(body.stiffest.two_shear, elastic[b].two_shear);
    }
    return bodies;
}

} // namespace

void glue_joined_blocks(Model& model, JointRegistry& joints) {
    auto& contacts = model.contacts;
    const auto bodies = zoned_bodies(model);
    if (bodies.empty() && std::ranges::find(contacts.material, material_of_glue) == contacts.material.end()) return;
    std::map<std::int32_t, Row> sets; // by body
    for (const auto& [number, body] : bodies) {
        const JointModel& spring = joints.get("elastic");
        std::vector<double> values(spring.properties.size());
        const double thickness = layer * body.edge();
        values[*spring.find_property("stiffness-normal")] = (body.stiffest.lambda + body.stiffest.two_shear) / thickness;
        values[*spring.find_property("stiffness-shear")] = 0.5 * body.stiffest.two_shear / thickness;
        sets[number] = shared_set(model, {spring.name, material_of_glue, std::move(values), ""});
    }
    std::vector<char> marked(model.sub_contacts.size(), 0); // that another joint model has prepared
    bool any = false;
    const auto give = [&](std::size_t c, Row set, std::int32_t material) {
        if (contacts.properties[c] == set) return;
        contacts.properties[c] = set;
        contacts.material[c] = material;
        const Span span = contacts.sub_contacts[c];
        std::fill_n(marked.begin() + span.first, span.count, char{1});
        any = true;
    };
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const std::int32_t joint = model.settings.default_joint_material;
        if (glued(model, static_cast<Row>(c))) give(c, sets.at(model.blocks.body[contacts.block1[c]]), material_of_glue);
        else if (contacts.material[c] == material_of_glue) // no longer: it is a joint like any other
            give(c, property_set(model, joints, default_joint_model(model), joint, ""), joint);
    }
    if (any) initialise_sub_contacts(model, joints, marked);
}

} // namespace kaya
