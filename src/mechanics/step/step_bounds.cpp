#include "mechanics/step/step_bounds.hpp"

#include "base/reduce.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;
constexpr double bound_rounding = 1e-12;

bool held(const Model& model, Row gridpoint) { return (model.gridpoints.fixed[gridpoint] & 7) == 7; }

Row block_of(const Model& model, Row contact, int side) {
    return side == 0 ? model.contacts.block1[contact] : model.contacts.block2[contact];
}

void take_smaller(StepLimit& limit, const StepLimit& other) {
    if (other.stable < limit.stable) limit = other;
}

template <class Visit> void for_rows(std::size_t rows, const Visit& visit) {
    for_chunks(rows, grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) visit(static_cast<Row>(i));
    });
}

/// `of` is called with a row and the smallest step so far, and may return any that is not smaller.
template <class Of> StepLimit smallest_of(std::size_t rows, const Of& of) {
    return reduce_chunks(
        rows, grain, StepLimit{},
        [&](std::size_t first, std::size_t last) {
            StepLimit part;
            for (std::size_t i = first; i < last; ++i) take_smaller(part, of(static_cast<Row>(i), part.stable));
            return part;
        },
        take_smaller);
}

/// Marks the blocks that have a contact with a marked one.
void spread(const Contacts& contacts, const std::vector<char>& from, std::vector<char>& to) {
    to = from;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (from[contacts.block1[c]] || from[contacts.block2[c]]) to[contacts.block1[c]] = to[contacts.block2[c]] = 1;
}

void add_node(const Model& model, const BodyFrame& frame, const NodeStiffness& stiffness, Row node,
              SpringMatrix& matrix) {
    SpringSums sums;
    sums.normal.add(stiffness.along, Vec3::Zero());
    sums.shear.add(stiffness.across, Vec3::Zero());
    matrix.add(1, {sums, direction_of_node(model, node), force_of_node(model, node).place - frame.centre});
    for (int k = 0; k < 3; ++k) matrix.rotations[k] += stiffness.turning;
}

void mark_whole_bodies(const JoinedBodies& bodies, std::vector<char>& blocks) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto members = bodies.members(i);
        const bool any = std::any_of(members.begin(), members.end(), [&](Row b) { return blocks[b]; });
        for (const Row b : members) blocks[b] = any;
    }
}

} // namespace

double Resistance::stable_step() const {
    const double root = std::sqrt(viscous * viscous + 4 * elastic);
    return root + viscous > 0 ? 4 / (root + viscous) : std::numeric_limits<double>::infinity();
}

void StepBounds::update(const Model& model, const Adjacency& adjacency, Of of) {
    asked_.assign(model.blocks.size(), 1);
    near_ = asked_;
    alone_ = of == Of::bodies;
    compute(model, adjacency);
}

// By equation (4) a body's bound depends on its own resistance and on those of its neighbours.
void StepBounds::update_at(const Model& model, const Adjacency& adjacency, const std::vector<char>& contacts, Of of) {
    near_.assign(model.blocks.size(), 0);
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (contacts[c]) near_[model.contacts.block1[c]] = near_[model.contacts.block2[c]] = 1;
    mark_whole_bodies(adjacency.bodies, near_);
    asked_ = near_;
    alone_ = of == Of::bodies;
    if (!alone_) {
        spread(model.contacts, near_, asked_);
        mark_whole_bodies(adjacency.bodies, asked_);
        spread(model.contacts, asked_, near_);
        mark_whole_bodies(adjacency.bodies, near_);
    }
    compute(model, adjacency);
}

Springs StepBounds::springs(const Model& model, Row sub_contact, const NormalAreaFactor& factor) const {
    if (foreseen) return (*foreseen)[static_cast<std::size_t>(sub_contact)];
    return springs_of(model.sub_contacts, sub_contact, factor);
}

SpringsOfEight StepBounds::springs(const Model& model, Row first, const RowsOfEight& group,
                                   const NormalAreaFactor& factor) const {
    if (!foreseen) return springs_of(model.sub_contacts, first, group, factor);
    SpringsOfEight eight{};
    for (Row l = 0; l < group.rows(); ++l) {
        const Springs& one = (*foreseen)[static_cast<std::size_t>(first + l)];
        eight.normal[l] = one.normal;
        eight.shear[l] = one.shear;
    }
    return eight;
}

SpringSums StepBounds::sums_of(const Model& model, Row contact) const {
    MomentsOfEights normal, shear;
    const Span span = model.contacts.sub_contacts[contact];
    const Eight3 origin = eights(model.contacts.position[contact]);
    const NormalAreaFactor factor(model, contact);
    for (Row first = span.first; first < span.end(); first += eight) {
        const RowsOfEight group(span.end() - first);
        const SpringsOfEight k = springs(model, first, group, factor);
        const Eight3 place = factor.arms(first, group.load(model.sub_contacts.position, first, origin) - origin);
        normal.add(larger_of(k.normal, Eight{}), place);
        shear.add(larger_of(k.shear, Eight{}), place + group.load(model.sub_contacts.shear_arm, first));
    }
    return {normal.sum(), shear.sum()};
}

void StepBounds::compute(const Model& model, const Adjacency& adjacency) {
    const auto& blocks = model.blocks;
    body_.assign(blocks.size(), no_row);
    lead_.resize(blocks.size());
    for_rows(blocks.size(), [&](Row b) { lead_[b] = b; });
    fixed_.assign(blocks.fixed.begin(), blocks.fixed.end());
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const Row lead = adjacency.bodies.members(i).front();
        for (const Row b : adjacency.bodies.members(i)) {
            body_[b] = static_cast<Row>(i);
            lead_[b] = lead;
            fixed_[lead] |= blocks.fixed[b];
        }
    }
}

void StepBounds::find_frames(const Model& model, const Adjacency& adjacency, Masses masses) {
    const auto& blocks = model.blocks;
    const bool real = masses == Masses::real;
    frames_.resize(blocks.size());
    for_rows(blocks.size(), [&](Row b) {
        if (!near_[b] || blocks.deformable[b] || lead_[b] != b) return;
        const double factor = real || !(blocks.mass[b] > 0) ? 1 : blocks.inertial_mass[b] / blocks.mass[b];
        if (body_[b] != no_row) {
            const auto members = adjacency.bodies.members(static_cast<std::size_t>(body_[b]));
            const BodyMass body = body_mass(model, members);
            frames_[b] = make_frame(body.centroid, blocks.mass[b] > 0 ? factor * body.mass : 0, factor * body.inertia,
                                    fixed_[b]);
            return;
        }
        const Mat3 turn = turn_of(blocks, b);
        const double mass = factor * blocks.mass[b];
        frames_[b] =
            make_frame(blocks.centroid[b], mass,
                       mass / blocks.volume[b] * (turn * blocks.inertia[b] * turn.transpose()), blocks.fixed[b]);
    });
    if (adjacency.of_gridpoint.entries.empty() && model.zones.size() == 0) return;
    const auto& points = model.gridpoints;
    root_of_gridpoint_.resize(points.size());
    zone_part_.resize(points.size());
    for_rows(points.size(), [&](Row g) {
        const double mass = real ? points.mass[g] : points.inertial_mass[g];
        const bool moves = mass > 0 && !held(model, g);
        root_of_gridpoint_[g] = moves ? 1 / std::sqrt(mass) : 0;
        zone_part_[g] = moves ? points.zone_frequency[g] * (points.mass[g] / mass) : 0;
    });
}

/// The stiffness share of a sub-contact that its gridpoints on one side bear together, over mass.
double StepBounds::mobility(const Model& model, Row block, const Attachment& attachment) const {
    if (!model.blocks.deformable[block]) return 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        if (attachment.weights[k] != 0) sum += attachment.weights[k] * root_of_gridpoint_[attachment.gridpoints[k]];
    return sum;
}

/// The same for a structure node in a zone. No share is needed: it never holds a gridpoint more stiffly than this.
double StepBounds::mobility_of_node(const Model& model, Row node) const {
    const NodePlace at = place_of_held_node(model, node);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += std::abs((*at.weights)[k]) * root_of_gridpoint_[static_cast<std::size_t>((*at.corners)[k])];
    return sum;
}

/// Whether the body on one side of a sub-contact can move; for rigid blocks independent of the sub-contact.
bool StepBounds::moves(const Model& model, Row contact, Row sub_contact, int side) const {
    const Row block = block_of(model, contact, side);
    const auto& blocks = model.blocks;
    if (!blocks.deformable[block]) return blocks.mass[block] > 0 && fixed_[lead_[block]] != fix_all;
    const auto& subs = model.sub_contacts;
    const Attachment& attachment = side == 0 ? subs.side1[sub_contact] : subs.side2[sub_contact];
    for (int k = 0; k < 3; ++k)
        if (attachment.weights[k] != 0 && root_of_gridpoint_[attachment.gridpoints[k]] > 0) return true;
    return false;
}

/// Immobile bodies bear nothing. A dashpot scales with the root of its spring: with the share of the spring, a soft contact beside a stiff
/// one would bear its dashpot many times over.
StepBounds::Share StepBounds::share(const Model& model, Row contact, Row sub_contact, int side, Shares shares) const {
    if (shares == Shares::none) return {1, 1};
    if (shares == Shares::halves) return moves(model, contact, sub_contact, 1 - side) ? Share{2, 2} : Share{1, 1};
    const auto of_side = [&](int i) {
        const Row block = block_of(model, contact, i);
        if (!model.blocks.deformable[block]) return resistance_[lead_[block]];
        const auto& subs = model.sub_contacts;
        const Attachment& attachment = i == 0 ? subs.side1[sub_contact] : subs.side2[sub_contact];
        Resistance largest;
        for (int k = 0; k < 3; ++k) {
            if (attachment.weights[k] == 0) continue;
            const Resistance& point = point_resistance_[attachment.gridpoints[k]];
            largest.elastic = std::max(largest.elastic, point.elastic);
            largest.viscous = std::max(largest.viscous, point.viscous);
        }
        return largest;
    };
    const auto times = [](double own, double other) { return own == 0 || other == 0 ? 1 : 1 + other / own; };
    const Resistance own = of_side(side), other = of_side(1 - side);
    return {times(own.elastic, other.elastic), times(own.viscous, other.viscous)};
}

void StepBounds::add_contact(const Model& model, const BodyFrame& frame, const ContactEntry& entry, Shares shares,
                             Matrices& matrices) const {
    const Row c = entry.contact;
    const Vec3 arm = model.contacts.position[c] - frame.centre;
    const Vec3& normal = model.contacts.normal[c];
    const Beta beta = damped_ ? beta_[c] : Beta{0, 0};
    const auto add_dashpots = [&](const SpringSums& sums, double times) {
        matrices.viscous.add(times, {{sums.normal * beta.normal, sums.shear * beta.shear}, normal, arm});
    };
    if (between_rigid(model, c)) {
        const Share times = share(model, c, no_row, entry.side, shares);
        if (alone_) matrices.elastic.add(times.elastic, {sums_[c], normal, arm});
        else matrices.elastic.add(times.elastic, matrices_[c][static_cast<std::size_t>(entry.side)]);
        if (damped_) add_dashpots(sums_[c], times.viscous);
        return;
    }
    const Span span = model.contacts.sub_contacts[c];
    const NormalAreaFactor factor(model, c);
    SpringSums sums, damped;
    for (Row s = span.first; s < span.end(); ++s) {
        const Springs k = springs(model, s, factor);
        if (k.stiffer() <= 0) continue;
        const Vec3 place = model.sub_contacts.position[s] - model.contacts.position[c];
        const Share times = share(model, c, s, entry.side, shares);
        sums.normal.add(times.elastic * k.normal, place);
        sums.shear.add(times.elastic * k.shear, place);
        if (!damped_) continue;
        damped.normal.add(times.viscous * k.normal, place);
        damped.shear.add(times.viscous * k.shear, place);
    }
    matrices.elastic.add(1, {sums, normal, arm});
    if (damped_) add_dashpots(damped, 1);
}

/// The most that a rigid body has by equation (4): what it has without its neighbours, and the largest that one of them has. Infinite at
/// blocks with zones, whose points have different ones.
Resistance StepBounds::with_neighbours(const Model& model, const Adjacency& adjacency, Row row) const {
    Resistance largest;
    const auto take = [&](Row b) {
        for (auto e = adjacency.of_block.begin(b); e != adjacency.of_block.end(b); ++e) {
            const Row other = block_of(model, e->contact, 1 - e->side);
            constexpr double infinity = std::numeric_limits<double>::infinity();
            const Resistance of_other =
                model.blocks.deformable[other] ? Resistance{infinity, infinity} : resistance_[lead_[other]];
            largest = {std::max(largest.elastic, of_other.elastic), std::max(largest.viscous, of_other.viscous)};
        }
    };
    if (body_[row] == no_row) take(row);
    else
        for (const Row b : adjacency.bodies.members(static_cast<std::size_t>(body_[row]))) take(b);
    largest.add(resistance_[row]);
    return largest;
}

Resistance StepBounds::of_block(const Model& model, const Adjacency& adjacency, Row row, Shares shares,
                                double enough) const {
    const BodyFrame& frame = frames_[row];
    if (!frame.moves()) return {};
    if (shares == Shares::by_resistance)
        if (const Resistance most = with_neighbours(model, adjacency, row);
            most.stable_step() >= (1 + bound_rounding) * enough)
            return most;
    Matrices matrices;
    const auto add = [&](Row b) {
        for (auto e = adjacency.of_block.begin(b); e != adjacency.of_block.end(b); ++e)
            add_contact(model, frame, *e, shares, matrices);
        if (adjacency.has_structures())
            for (auto e = adjacency.nodes_of_block.begin(b); e != adjacency.nodes_of_block.end(b); ++e)
                add_node(model, frame, adjacency.node_stiffness[static_cast<std::size_t>(e->node)], e->node,
                         matrices.elastic);
    };
    if (body_[row] == no_row) add(row);
    else
        for (const Row b : adjacency.bodies.members(static_cast<std::size_t>(body_[row]))) add(b);
    const Mat6 elastic = frame.scaled(matrices.elastic);
    const Mat6 viscous = damped_ ? frame.scaled(matrices.viscous) : Mat6::Zero();
    const Resistance norms{elastic.norm(), viscous.norm()}; // no eigenvalue is larger
    if (shares == Shares::none || norms.stable_step() >= enough) return norms;
    if (damped_) return {largest_eigenvalue(elastic), largest_eigenvalue(viscous)};
    return {largest_eigenvalue(elastic, (1 - bound_rounding) * 4 / (enough * enough)), 0};
}

Resistance StepBounds::of_gridpoint(const Model& model, const Adjacency& adjacency, Row row, Shares shares) const {
    const double root = root_of_gridpoint_[row];
    if (root == 0) return {};
    const auto& subs = model.sub_contacts;
    Resistance sum{zone_part_[row], stiffness_damping(model.settings) * zone_part_[row]};
    for (auto e = adjacency.of_gridpoint.begin(row); e != adjacency.of_gridpoint.end(row); ++e) {
        const Row s = e->sub_contact, c = subs.contact[s];
        const Springs k = springs(model, s, NormalAreaFactor(model, c));
        if (k.stiffer() <= 0) continue;
        const Share times = share(model, c, s, e->side, shares);
        const double part = root * e->weight *
                            mobility(model, block_of(model, c, e->side), e->side == 0 ? subs.side1[s] : subs.side2[s]);
        sum.elastic += times.elastic * part * k.stiffer();
        if (damped_)
            sum.viscous += times.viscous * part * std::max(beta_[c].normal * k.normal, beta_[c].shear * k.shear);
    }
    if (adjacency.has_structures())
        for (auto e = adjacency.nodes_of_gridpoint.begin(row); e != adjacency.nodes_of_gridpoint.end(row); ++e) {
            const NodeStiffness& k = adjacency.node_stiffness[static_cast<std::size_t>(e->node)];
            sum.elastic += root * std::abs(e->weight) * mobility_of_node(model, e->node) * std::max(k.along, k.across);
        }
    return sum;
}

/// Matrices of contacts between rigid blocks on each of the two: bodies sum them twice, with different shares. Alone they sum once.
void StepBounds::find_matrices(const Model& model) {
    const auto& contacts = model.contacts;
    if (!alone_) matrices_.resize(contacts.size());
    if (alone_ || damped_) sums_.resize(contacts.size());
    for_rows(contacts.size(), [&](Row c) {
        if (!(near_[contacts.block1[c]] || near_[contacts.block2[c]]) || !between_rigid(model, c)) return;
        const SpringSums sums = sums_of(model, c);
        if (alone_ || damped_) sums_[c] = sums;
        if (alone_) return;
        for (int side = 0; side < 2; ++side) {
            const Vec3& centre = frames_[lead_[block_of(model, c, side)]].centre;
            matrices_[c][static_cast<std::size_t>(side)] = {sums, contacts.normal[c], contacts.position[c] - centre};
        }
    });
}

void StepBounds::find_resistances(const Model& model, const Adjacency& adjacency, Masses masses) {
    find_frames(model, adjacency, masses);
    damped_ = joints_are_damped(model.settings);
    const auto& contacts = model.contacts;
    if (damped_) {
        beta_.resize(contacts.size());
        for_rows(contacts.size(), [&](Row c) {
            if (near_[contacts.block1[c]] || near_[contacts.block2[c]]) beta_[c] = beta_of(model, c);
        });
    }
    find_matrices(model);
    if (alone_) return;
    resistance_.resize(model.blocks.size());
    for_rows(model.blocks.size(), [&](Row b) {
        if (near_[b] && !model.blocks.deformable[b] && lead_[b] == b)
            resistance_[b] = of_block(model, adjacency, b, Shares::none);
    });
    if (root_of_gridpoint_.empty()) return;
    point_resistance_.resize(model.gridpoints.size());
    for_rows(model.gridpoints.size(), [&](Row g) {
        const Row b = model.gridpoints.block[g];
        if (near_[b] && model.blocks.deformable[b])
            point_resistance_[g] = of_gridpoint(model, adjacency, g, Shares::none);
    });
}

StepLimit StepBounds::smallest(const Model& model, const Adjacency& adjacency, Shares shares, double enough) const {
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    StepLimit limit;
    if (model.zones.size() > 0)
        limit = smallest_of(points.size(), [&](Row g, double) {
            if (!asked_[points.block[g]] || !blocks.deformable[points.block[g]]) return StepLimit{};
            const Resistance sum = of_gridpoint(model, adjacency, g, shares);
            return StepLimit{sum.stable_step(), false, g, sum.elastic > 0 ? zone_part_[g] / sum.elastic : 0};
        });
    take_smaller(
        limit, smallest_of(blocks.size(), [&](Row b, double smallest) {
            if (!asked_[b] || blocks.deformable[b] || lead_[b] != b) return StepLimit{};
            return StepLimit{of_block(model, adjacency, b, shares, std::min(smallest, enough)).stable_step(), true, b};
        }));
    return limit;
}

StepLimit StepBounds::limit(const Model& model, const Adjacency& adjacency, Masses masses, double enough) {
    find_resistances(model, adjacency, masses);
    if (alone_) return smallest(model, adjacency, Shares::halves, enough);
    const StepLimit limit = smallest(model, adjacency, Shares::by_resistance, enough);
    if (masses == Masses::real || model.settings.mass_scaling == MassScaling::none) return limit;
    // Bounds equal within rounding count as the one that holds without scaling.
    const StepLimit other = smallest(model, adjacency, Shares::halves, enough);
    return other.stable > (1 + bound_rounding) * limit.stable ? other : limit;
}

// With halves, no share depends on the neighbours' masses, so an eigenvalue is over the body's own mass.
const BodyStiffness& StepBounds::stiffness(const Model& model, const Adjacency& adjacency, double enough) {
    find_resistances(model, adjacency, Masses::inertial);
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    const auto times = [](const Resistance& r, double mass) { return Resistance{mass * r.elastic, mass * r.viscous}; };
    stiffness_.of_gridpoint.assign(points.size(), {});
    stiffness_.of_block.assign(blocks.size(), {});
    if (model.zones.size() > 0)
        for_rows(points.size(), [&](Row g) {
            if (asked_[points.block[g]] && blocks.deformable[points.block[g]])
                stiffness_.of_gridpoint[g] =
                    times(of_gridpoint(model, adjacency, g, Shares::halves), points.inertial_mass[g]);
        });
    // Members share the stiffness of their body by mass, so that one factor scales them all.
    for_rows(blocks.size(), [&](Row b) {
        if (!asked_[b] || blocks.deformable[b] || lead_[b] != b) return;
        const Resistance whole = of_block(model, adjacency, b, Shares::halves, enough);
        if (body_[b] == no_row) stiffness_.of_block[b] = times(whole, blocks.inertial_mass[b]);
        else
            for (const Row m : adjacency.bodies.members(static_cast<std::size_t>(body_[b])))
                stiffness_.of_block[m] = times(whole, blocks.inertial_mass[b] / blocks.mass[b] * blocks.mass[m]);
    });
    return stiffness_;
}

} // namespace kaya
