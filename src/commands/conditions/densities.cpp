// block property density.
#include "commands/conditions/densities.hpp"

#include "commands/session/handlers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace kaya {

namespace {

/// Whether two materials have the same values; what is not given is the same, too.
bool same_material(const Material& a, const Material& b) {
    const auto same = [&](double Material::*member) {
        return a.*member == b.*member || (std::isnan(a.*member) && std::isnan(b.*member));
    };
    return same(&Material::density) && same(&Material::bulk) && same(&Material::shear) && same(&Material::young) &&
           same(&Material::poisson) && a.cohesion == b.cohesion && a.friction == b.friction && a.tension == b.tension &&
           a.dilation == b.dilation && a.joint == b.joint && a.zone == b.zone;
}

/// The number of this material; a new one is added when no material is the same.
std::int32_t number_of(Model& model, const Material& wanted) {
    std::int32_t last = 1;
    for (const auto& [number, material] : model.materials) {
        if (same_material(material, wanted)) return number;
        last = std::max(last, number);
    }
    for (const std::int32_t number : model.blocks.material) last = std::max(last, number);
    model.materials[last + 1] = wanted;
    return last + 1;
}

} // namespace

void give_density(Session& session, const std::vector<Row>& blocks, double density, bool all) {
    Model& model = session.engine.model;
    const std::set<Row> chosen(blocks.begin(), blocks.end());
    std::set<std::int32_t> shared; // with blocks that keep their density
    for (std::size_t b = 0; b < model.blocks.size(); ++b)
        if (!chosen.contains(static_cast<Row>(b))) shared.insert(model.blocks.material[b]);
    std::map<std::int32_t, std::int32_t> renamed;
    for (const Row block : blocks) {
        std::int32_t& number = model.blocks.material[block];
        if (!renamed.contains(number)) {
            const auto known = model.materials.find(number);
            Material wanted = known == model.materials.end() ? Material{} : known->second;
            wanted.density = density;
            if (all && !shared.contains(number)) {
                model.materials[number] = wanted;
                renamed[number] = number;
            } else {
                const std::int32_t before = number;
                renamed[before] = number_of(model, wanted);
            }
        }
        number = renamed[number];
    }
    ModelEdit(model, Change::properties);
}

void run(Session& session, const lang::BlockDensity& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (!blocks.empty()) give_density(session, blocks, command.density, !command.range.place);
}

void add_handlers(HandlerTable& table, lang::DensityCommands list) { fill(table, list); }

} // namespace kaya
