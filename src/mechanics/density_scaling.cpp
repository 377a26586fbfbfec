// Density scaling: inertial masses that differ from the true ones. Equations (8) to (10) of docs/theory/time-step.md.
#include "mechanics/phases.hpp"
#include "mechanics/step_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Calls visit(mass, inertial mass, resistance, row) for every rigid block and then for every gridpoint of a deformable
/// one that has mass; the row is that of a rigid block, or no_row.
template <class Visit> void each_body(Model& model, const BodyStiffness& stiffness, Visit&& visit) {
    auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks.deformable[b] && blocks.mass[b] > 0)
            visit(blocks.mass[b], blocks.inertial_mass[b], stiffness.of_block[b], static_cast<Row>(b));
    auto& points = model.gridpoints;
    for (std::size_t g = 0; g < points.size(); ++g)
        if (points.mass[g] > 0) visit(points.mass[g], points.inertial_mass[g], stiffness.of_gridpoint[g], no_row);
}

/// The velocity of a body stays, so that its angular momentum follows its inertia.
void give(Model& model, double& inertial, double value, Row block) {
    if (block != no_row) model.blocks.angular_momentum[block] *= value / inertial;
    inertial = value;
}

/// A deformable block has the inertial mass of its gridpoints.
void sum_up(Model& model) {
    auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks.deformable[b]) continue;
        const Span span = blocks.gridpoints[b];
        blocks.inertial_mass[b] = 0;
        for (Row g = span.first; g < span.end(); ++g) blocks.inertial_mass[b] += model.gridpoints.inertial_mass[g];
    }
}

/// Room for rounding: a mass that was made for a frequency is not found to be too small for it.
constexpr double above = 1 + 1e-9;
/// A stiffness that grows gives a little more mass than it must, so that it does not have to in the next cycle.
constexpr double ahead = 1.1;
/// Masses stay while they are no more than this part too large: changing them changes the kinetic energy.
constexpr double enough = 0.8;

} // namespace

double mean_stable_step(const Model& model, const BodyStiffness& stiffness) {
    Resistance sum;
    double mass = 0;
    const auto add = [&](const Resistance& body, double m) {
        if (!body.acts()) return;
        sum.add(body);
        mass += m;
    };
    for (std::size_t b = 0; b < model.blocks.size(); ++b) add(stiffness.of_block[b], model.blocks.mass[b]);
    for (std::size_t g = 0; g < model.gridpoints.size(); ++g) add(stiffness.of_gridpoint[g], model.gridpoints.mass[g]);
    return mass > 0 ? sum.over(mass).stable_step() : 0;
}

void scale_masses(Model& model, const BodyStiffness& stiffness, double stable_step, double least) {
    const auto wanted = [&](double mass, const Resistance& body) {
        return body.acts() ? std::max(least * mass, body.needed_for(stable_step)) : mass;
    };
    bool apart = false;
    each_body(model, stiffness, [&](double mass, double inertial, const Resistance& body, Row) {
        const double right = wanted(mass, body);
        apart = apart || right > above * inertial || right < enough * inertial;
    });
    if (!apart) return;
    each_body(model, stiffness, [&](double mass, double& inertial, const Resistance& body, Row block) {
        give(model, inertial, wanted(mass, body), block);
    });
    sum_up(model);
}

void raise_masses(Model& model, const BodyStiffness& stiffness, double stable_step) {
    bool raised = false;
    each_body(model, stiffness, [&](double, double& inertial, const Resistance& body, Row block) {
        const double needed = body.needed_for(stable_step);
        if (needed <= above * inertial) return;
        give(model, inertial, ahead * needed, block);
        raised = true;
    });
    if (raised) sum_up(model);
}

void restore_masses(Model& model) {
    const BodyStiffness none{std::vector<Resistance>(model.gridpoints.size()), std::vector<Resistance>(model.blocks.size())};
    each_body(model, none, [&](double mass, double& inertial, const Resistance&, Row block) {
        if (inertial != mass) give(model, inertial, mass, block);
    });
    for (std::size_t b = 0; b < model.blocks.size(); ++b) model.blocks.inertial_mass[b] = model.blocks.mass[b];
}

ScaledMasses scaled_masses(const Model& model) {
    ScaledMasses sums;
    const auto add = [&](bool moves, double mass, double inertial) {
        if (!moves || mass <= 0) return;
        ++sums.bodies;
        sums.scaled += inertial != mass;
        sums.real += mass;
        sums.inertial += inertial;
    };
    const auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        add(!blocks.deformable[b] && blocks.fixed[b] != fix_all, blocks.mass[b], blocks.inertial_mass[b]);
    const auto& points = model.gridpoints;
    for (std::size_t g = 0; g < points.size(); ++g)
        add((points.fixed[g] & 7) != 7, points.mass[g], points.inertial_mass[g]);
    return sums;
}

} // namespace kaya
