// Density scaling: inertial masses that differ from the true ones. Equations (8) to (10) of docs/theory/time-step.md.
#include "mechanics/step/density_scaling.hpp"
#include "mechanics/structures/member_lists.hpp"
#include "mechanics/step/step_bounds.hpp"
#include "model/measure/time_step_fraction.hpp"
#include "model/structures/members.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// A rigid block or a gridpoint of a deformable one.
struct Body {
    double mass; ///< the true one
    double& inertial;
    unsigned fixed;
    const Vec3& force; ///< of joints and zones
    Vec3& velocity;
    const Vec3* moment; ///< of a rigid block, as the next two
    Vec3* spin;
    Vec3* momentum; ///< angular
};

/// Calls visit(body, resistance) for every rigid block and then for every gridpoint of a deformable one that has mass.
template <class Visit> void each_body(Model& model, const BodyStiffness& stiffness, Visit&& visit) {
    auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks.deformable[b] && blocks.mass[b] > 0)
            visit(Body{blocks.mass[b], blocks.inertial_mass[b], blocks.fixed[b], blocks.force[b], blocks.velocity[b],
                       &blocks.moment[b], &blocks.rotational_velocity[b], &blocks.angular_momentum[b]},
                  stiffness.of_block[b]);
    auto& points = model.gridpoints;
    for (std::size_t g = 0; g < points.size(); ++g)
        if (points.mass[g] > 0)
            visit(Body{points.mass[g], points.inertial_mass[g], points.fixed[g], points.force[g], points.velocity[g],
                       nullptr, nullptr, nullptr},
                  stiffness.of_gridpoint[g]);
}

/// Calls visit(resistance, mass, inertial mass) for the bodies on which a stiffness acts.
template <class Visit> void each_that_resists(const Model& model, const BodyStiffness& stiffness, Visit&& visit) {
    const auto each = [&](const std::vector<Resistance>& resistances, const auto& bodies) {
        for (std::size_t i = 0; i < resistances.size(); ++i)
            if (resistances[i].acts()) visit(resistances[i], bodies.mass[i], bodies.inertial_mass[i]);
    };
    each(stiffness.of_block, model.blocks);
    each(stiffness.of_gridpoint, model.gridpoints);
}

/// Effect of a change of masses: kinetic energy, and the power of joint and zone forces.
struct MassChange {
    double kinetic = 0, power = 0;
};

/// A change of mass creates no kinetic energy: a body that gets heavier keeps its momentum, one that gets lighter keeps its velocity.
/// Otherwise a rattling block would gain energy each time, getting lighter while springs push it and heavier in flight. Held velocities are
/// unchanged.
void give(const Body& body, double value, MassChange& change) {
    const double before = body.inertial, ratio = value / before, slower = std::min(1.0, 1 / ratio);
    body.inertial = value;
    for (int k = 0; k < 3; ++k) {
        if (body.fixed & (fix_x << k)) continue;
        double& v = body.velocity[k];
        const double old = v;
        v *= slower;
        change.kinetic += 0.5 * (value * v * v - before * old * old);
        change.power += body.force[k] * (v - old);
    }
    if (!body.spin) return;
    if (body.fixed & (fix_rx | fix_ry | fix_rz)) {
        *body.momentum *= ratio;
        return;
    }
    const Vec3 spin = *body.spin, momentum = *body.momentum;
    *body.spin *= slower;
    *body.momentum *= std::min(ratio, 1.0);
    change.kinetic += 0.5 * (body.spin->dot(*body.momentum) - spin.dot(momentum));
    change.power += body.moment->dot(*body.spin - spin);
}

/// The account books it as damped.
void book(Model& model, const MassChange& change) {
    Energy& energy = model.energy;
    energy.kinetic += change.kinetic;
    energy.inner_power += change.power;
    if (model.settings.energy) energy.damped -= change.kinetic + change.power * energy.lag;
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

/// Rounding tolerance: a mass computed for a frequency must not be found too small for it.
constexpr double above = 1 + 1e-9;
/// A growing stiffness gets some mass in advance, so that it need not be changed in the next cycle.
constexpr double ahead = 1.1;
/// Masses stay unchanged while they are at most this part too large: changing them costs kinetic energy.
constexpr double enough = 0.8;

} // namespace

double mean_stable_step(const Model& model, const BodyStiffness& stiffness) {
    Resistance sum;
    double mass = 0;
    each_that_resists(model, stiffness, [&](const Resistance& body, double real, double) {
        sum.add(body);
        mass += real;
    });
    return mass > 0 ? sum.over(mass).stable_step() : 0;
}

double least_stable_step(const Model& model, const BodyStiffness& stiffness) {
    double least = std::numeric_limits<double>::infinity();
    each_that_resists(model, stiffness, [&](const Resistance& body, double, double inertial) {
        least = std::min(least, body.over(inertial).stable_step());
    });
    return least;
}

void scale_masses(Model& model, const BodyStiffness& stiffness, double stable_step, double least) {
    const auto wanted = [&](double mass, const Resistance& body) {
        return body.acts() ? std::max(least * mass, body.needed_for(stable_step)) : mass;
    };
    bool apart = false;
    each_body(model, stiffness, [&](const Body& body, const Resistance& resistance) {
        const double right = wanted(body.mass, resistance);
        apart = apart || right > above * body.inertial || right < enough * body.inertial;
    });
    if (!apart) return;
    MassChange change;
    each_body(model, stiffness, [&](const Body& body, const Resistance& resistance) {
        give(body, wanted(body.mass, resistance), change);
    });
    book(model, change);
    sum_up(model);
}

bool raise_masses(Model& model, const BodyStiffness& stiffness, double stable_step) {
    bool raised = false;
    MassChange change;
    each_body(model, stiffness, [&](const Body& body, const Resistance& resistance) {
        const double needed = resistance.needed_for(stable_step);
        if (needed <= above * body.inertial) return;
        give(body, ahead * needed, change);
        raised = true;
    });
    book(model, change);
    if (raised) sum_up(model);
    return raised;
}

void restore_masses(Model& model) {
    const BodyStiffness none{std::vector<Resistance>(model.gridpoints.size()),
                             std::vector<Resistance>(model.blocks.size())};
    MassChange change;
    each_body(model, none, [&](const Body& body, const Resistance&) {
        if (body.inertial != body.mass) give(body, body.mass, change);
    });
    book(model, change);
    for (std::size_t b = 0; b < model.blocks.size(); ++b) model.blocks.inertial_mass[b] = model.blocks.mass[b];
}

void fit_member_masses(Model& model) {
    auto& nodes = model.structures.member_nodes;
    if (nodes.empty()) return;
    const double longest = model.clock.time_step / (2 * time_step_fraction(model.settings)), square = longest * longest;
    const bool follow = member_masses_follow(model.settings);
    MassChange change;
    const auto fit = [&](double& inertial, double right, Vec3& velocity, const Vec3& force) {
        if (inertial == 0) inertial = right; // newly created
        if (inertial >= right && enough * inertial <= right) return;
        give(Body{right, inertial, 0, force, velocity, nullptr, nullptr, nullptr}, right, change);
    };
    for (Row node = 0; node < static_cast<Row>(nodes.size()); ++node) {
        const Hold hold = hold_of(model, node);
        if (hold == Hold::clamped) continue;
        fit(nodes.inertia[node], square * nodes.rotation_stiffness[node], nodes.spin[node], nodes.moment[node]);
        if (hold == Hold::pinned) continue;
        const double needed = follow ? square * node_resistance(model, node, hold) : 0;
        fit(nodes.inertial_mass[node], std::max(nodes.mass[node], needed), nodes.velocity[node], nodes.force[node]);
    }
    book(model, change);
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
