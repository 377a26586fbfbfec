#include "mechanics/bodies/run_cables.hpp"

#include "base/reduce.hpp"
#include "mechanics/structures/rock_motion.hpp"
#include "model/structures/cables.hpp"
#include "model/measure/water.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {

namespace {

constexpr std::size_t grain = 1; // cables, each of many nodes
/// Largest strain of a bar whose tension counts in the time step.
constexpr double most_strain = 0.02;

const StructureProperties& properties_of(const Model& model, Row cable) {
    return model.structures.properties.at(model.structures.cables.property[cable]);
}

bool in_rock(const Model& model, Row node) { return block_of_node(model, node) != no_row; }

/// Nodes in the rock move with it. Nodes between parts of the rock stay on the straight line between them; free ends move with the nearest
/// node in the rock.
void place_nodes(Model& model, const Span& span, double step) {
    auto& nodes = model.structures.cable_nodes;
    Row before = no_row; // the last node in the rock
    Vec3 shift = Vec3::Zero();
    for (Row node = span.first; node < span.end(); ++node) {
        if (in_rock(model, node)) {
            const Vec3 before_step = nodes.position[node];
            const Vec3 now =
                is_placed(model, nodes, node) ? follow_rock(model, nodes, node, before_step, step) : before_step;
            shift = now - before_step;
            if (before == no_row)
                for (Row free = span.first; free < node; ++free) nodes.position[free] += shift;
            else
                for (Row free = before + 1; free < node; ++free) {
                    const double part = static_cast<double>(free - before) / static_cast<double>(node - before);
                    nodes.position[free] = (1 - part) * nodes.position[before] + part * now;
                }
            nodes.position[node] = now;
            before = node;
        }
    }
    if (before == no_row) return;
    // The displacement of the last node in the rock.
    for (Row free = before + 1; free < span.end(); ++free) nodes.position[free] += shift;
}

/// Effective compression of the rock around the cable at a node; 0 in rigid blocks.
double confinement(const Model& model, Row node, const Vec3& along) {
    const auto& nodes = model.structures.cable_nodes;
    const Row block = block_of_node(model, node);
    if (block == no_row || nodes.zone[node] == no_row) return 0;
    const Row zone = model.blocks.zones[block].first + nodes.zone[node];
    const Stress& s = model.zones.stress[zone];
    const double axial = along[0] * along[0] * s[0] + along[1] * along[1] * s[1] + along[2] * along[2] * s[2] +
                         2 * (along[0] * along[1] * s[3] + along[0] * along[2] * s[4] + along[1] * along[2] * s[5]);
    double pressure = 0;
    if (model.settings.water != Water::none) {
        const WaterPressure water(model);
        for (std::size_t k = 0; k < 4; ++k)
            pressure += nodes.weights[node][k] * water.at_gridpoint(model.zones.gridpoints[zone][k]);
    }
    return std::max(0.0, -0.5 * (s[0] + s[1] + s[2] - axial) - pressure);
}

double grout_strength(const Model& model, Row node, const StructureProperties& p, const Vec3& along) {
    if (p.grout_friction == 0 || p.grout_perimeter == 0)
        return p.grout_cohesion * model.structures.cable_nodes.share[node];
    const double friction =
        std::tan(p.grout_friction * std::numbers::pi / 180) * p.grout_perimeter * confinement(model, node, along);
    const double cohesion = std::isinf(p.grout_cohesion) ? 0 : p.grout_cohesion;
    return (cohesion + friction) * model.structures.cable_nodes.share[node];
}

void fill_chain(const Model& model, Row cable, CableChain& chain) {
    const auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[cable];
    const StructureProperties& p = properties_of(model, cable);
    const auto count = static_cast<std::size_t>(span.count);
    chain.bars.resize(count - 1);
    chain.grout.resize(count);
    chain.slip.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Row node = span.first + static_cast<Row>(i);
        const Vec3 along = direction_at(model, node);
        auto& grout = chain.grout[i];
        const bool held = in_rock(model, node);
        grout.anchored = held && nodes.anchored[node];
        grout.stiffness = held ? p.grout_stiffness * nodes.share[node] : 0;
        grout.strength = grout.stiffness > 0 ? grout_strength(model, node, p, along) : 0;
        grout.lost = nodes.slip_lost[node];
        chain.slip[i] = nodes.slip[node];
        if (i + 1 < count) {
            auto& bar = chain.bars[i];
            const Vec3 shift = nodes.position[node + 1] - nodes.position[node];
            const double length = shift.norm();
            const Vec3 direction = length > 0 ? Vec3(shift / length) : Vec3(Vec3::Zero());
            bar.stiffness = p.axial_stiffness() / nodes.bar_length[node];
            bar.gap = length - nodes.bar_length[node] - nodes.bar_yield[node];
            bar.kept = nodes.bar_kept[node];
            bar.first_cosine = along.dot(direction);
            bar.second_cosine = direction_at(model, node + 1).dot(direction);
            bar.yield_tension = p.yield_tension;
            bar.yield_compression = p.yield_compression;
            bar.broken = (nodes.bar_state[node] & broken) != 0;
        }
    }
}

std::uint8_t next_state(std::uint8_t before, bool now) {
    const auto kept = static_cast<std::uint8_t>(before & (has_yielded | broken));
    return now ? static_cast<std::uint8_t>(kept | yields | has_yielded) : kept;
}

void take_chain(Model& model, Row cable, const CableChain& chain) {
    auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[cable];
    const StructureProperties& p = properties_of(model, cable);
    for (std::size_t i = 0; i < chain.grout.size(); ++i) {
        const Row node = span.first + static_cast<Row>(i);
        const auto& grout = chain.grout[i];
        nodes.slip[node] = chain.slip[i];
        nodes.grout[node] = grout.anchored ? 0 : chain.grout_force(i);
        const bool slips = !grout.anchored && grout.stiffness > 0 && std::abs(chain.grout_force(i)) >= grout.strength;
        nodes.grout_state[node] = next_state(nodes.grout_state[node], slips);
        if (slips) nodes.slip_lost[node] = chain.slip[i] + chain.grout_force(i) / grout.stiffness;
        if (i + 1 == chain.grout.size()) break;
        const auto& bar = chain.bars[i];
        const double force = chain.bar_force(i);
        const bool flows = !bar.broken && (force >= bar.yield_tension || force <= -bar.yield_compression);
        nodes.bar_force[node] = force;
        nodes.bar_state[node] = next_state(nodes.bar_state[node], flows);
        if (!flows) continue;
        nodes.bar_yield[node] += chain.elongation(i) - (force - bar.kept) / bar.stiffness;
        if (nodes.bar_yield[node] > p.rupture_strain * nodes.bar_length[node]) {
            nodes.bar_state[node] |= broken;
            nodes.bar_force[node] = 0;
        }
    }
    // An anchor takes the resultant of the bars.
    for (std::size_t i = 0; i < chain.grout.size(); ++i) {
        if (!chain.grout[i].anchored) continue;
        const Row node = span.first + static_cast<Row>(i);
        double& grout = nodes.grout[node];
        if (i < chain.bars.size()) grout -= chain.bars[i].first_cosine * nodes.bar_force[node];
        if (i > 0) grout += chain.bars[i - 1].second_cosine * nodes.bar_force[node - 1];
    }
}

Vec3 unit_between(const CableNodes& nodes, Row first, Row second) {
    const Vec3 shift = nodes.position[second] - nodes.position[first];
    const double length = shift.norm();
    return length > 0 ? Vec3(shift / length) : Vec3(Vec3::Zero());
}

/// Forces on the rock, and the work since the last call; `before` are the positions then.
double take_forces(Model& model, Row cable, const std::vector<Vec3>& before) {
    auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[cable];
    double work = 0;
    for (Row node = span.first; node < span.end(); ++node) {
        Vec3 force = Vec3::Zero();
        if (in_rock(model, node)) {
            if (node + 1 < span.end()) force += nodes.bar_force[node] * unit_between(nodes, node, node + 1);
            if (node > span.first) force -= nodes.bar_force[node - 1] * unit_between(nodes, node - 1, node);
        }
        const Vec3 shift = nodes.position[node] - before[static_cast<std::size_t>(node - span.first)];
        work -= 0.5 * (force + nodes.force[node]).dot(shift);
        nodes.force[node] = force;
    }
    return work;
}

} // namespace

Vec3 direction_at(const Model& model, Row node) {
    const auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[nodes.cable[node]];
    return unit_between(nodes, std::max(span.first, node - 1), std::min(span.end() - 1, node + 1));
}

double run_cables(Model& model, std::vector<CableChain>& chains, double step) {
    auto& cables = model.structures.cables;
    auto& nodes = model.structures.cable_nodes;
    chains.resize(cables.size());
    const auto add = [](double& sum, double part) { sum += part; };
    return reduce_chunks(
        cables.size(), grain, 0.0,
        [&](std::size_t first, std::size_t last) {
            double work = 0;
            for (std::size_t i = first; i < last; ++i) {
                const Row cable = static_cast<Row>(i);
                const Span span = cables.nodes[cable];
                CableChain& chain = chains[i];
                chain.places.assign(nodes.position.begin() + span.first, nodes.position.begin() + span.end());
                place_nodes(model, span, step);
                fill_chain(model, cable, chain);
                chain.solve();
                take_chain(model, cable, chain);
                const double done = take_forces(model, cable, chain.places);
                cables.work[cable] += done;
                work += done;
            }
            return work;
        },
        add);
}

NodeStiffness cable_node_stiffness(const Model& model, Row node) {
    const auto& nodes = model.structures.cable_nodes;
    const StructureProperties& p = properties_of(model, nodes.cable[node]);
    // For the bound, a node follows the rock: it is anchored, or its bars are softer than its grout.
    const auto bars_of = [&](Row row) {
        double sum = 0;
        if (row > 0 && has_bar(nodes, row - 1)) sum += p.axial_stiffness() / nodes.bar_length[row - 1];
        if (has_bar(nodes, row)) sum += p.axial_stiffness() / nodes.bar_length[row];
        return sum;
    };
    const double bars = 2 * bars_of(node), grout = p.grout_stiffness * nodes.share[node];
    const double tension = std::min(p.yield_tension, most_strain * p.axial_stiffness());
    const double across = p.axial_stiffness() > 0 ? tension / p.axial_stiffness() * bars : 0;
    return {(nodes.anchored[node] ? bars : std::min(grout, bars)) + across, across, 0};
}

} // namespace kaya
