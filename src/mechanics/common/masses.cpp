#include "mechanics/common/remedy.hpp"
#include "mechanics/common/masses.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

[[noreturn]] void missing(const Model& model, Row block, const char* what) {
    const auto material = model.blocks.material[block];
    Advised d(fmt::format("block {} (material {}) has no {}", model.blocks.number[block], material, what),
              Advice::give_density, {std::to_string(material)});
    d.code = "property-missing";
    throw d;
}

/// Ratio of a body's inertial mass to its mass.
double inertial_factor(double inertial, double mass) { return inertial > 0 && mass > 0 ? inertial / mass : 1; }

} // namespace

double density_of(const Model& model, Row block) {
    const auto found = model.materials.find(model.blocks.material[block]);
    return found == model.materials.end() ? std::nan("") : found->second.density;
}

void compute_masses(Model& model) {
    auto& blocks = model.blocks;
    auto& g = model.gridpoints;
    // All densities are checked before the first mass is written.
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Row row = static_cast<Row>(b);
        const double density = density_of(model, row);
        const bool held = !blocks.deformable[b] && blocks.fixed[b] == fix_all && blocks.body[b] == 0;
        if (!(density > 0) && !held) missing(model, row, density == 0 ? "mass: its density is 0" : "density");
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const double density = density_of(model, static_cast<Row>(b));
        const double factor = inertial_factor(blocks.inertial_mass[b], blocks.mass[b]);
        blocks.mass[b] = density > 0 ? density * blocks.volume[b] : 0;
        blocks.inertial_mass[b] = factor * blocks.mass[b];
        const Span span = blocks.gridpoints[b];
        for (Row row = span.first; row < span.end(); ++row) {
            g.inertial_mass[row] = inertial_factor(g.inertial_mass[row], g.mass[row]);
            g.mass[row] = 0;
        }
        if (!blocks.deformable[b]) continue;
        const Span zones = blocks.zones[b];
        for (Row z = zones.first; z < zones.end(); ++z)
            for (const Row row : model.zones.gridpoints[z]) g.mass[row] += 0.25 * density * model.zones.volume[z];
        for (Row row = span.first; row < span.end(); ++row) g.inertial_mass[row] *= g.mass[row];
    }
}

} // namespace kaya
