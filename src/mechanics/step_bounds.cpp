#include "mechanics/step_bounds.hpp"

#include "base/reduce.hpp"
#include "mechanics/overlap_contact.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;
constexpr double rounding = 1e-12;

bool held(const Model& model, Row gridpoint) { return (model.gridpoints.fixed[gridpoint] & 7) == 7; }

double least_eigenvalue(const Mat3& inertia) {
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(inertia, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[0];
}

void take_larger(StepLimit& limit, const StepLimit& other) {
    if (other.frequency_squared > limit.frequency_squared) limit = other;
}

/// The largest of a number that `of` gives for each row.
template <class Of> StepLimit largest(std::size_t rows, bool of_block, const Of& of) {
    return reduce_chunks(
        rows, grain, StepLimit{},
        [&](std::size_t first, std::size_t last) {
            StepLimit part;
            for (std::size_t i = first; i < last; ++i)
                take_larger(part, {of(static_cast<Row>(i)), of_block, static_cast<Row>(i)});
            return part;
        },
        take_larger);
}

template <class Visit> void for_rows(std::size_t rows, const Visit& visit) {
    for_chunks(rows, grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) visit(static_cast<Row>(i));
    });
}

} // namespace

void StepBounds::update(const Model& model, const Adjacency& adjacency) {
    asked_.assign(model.blocks.size(), 1);
    near_ = asked_;
    look(model, adjacency);
}

void StepBounds::update_at(const Model& model, const Adjacency& adjacency, const std::vector<char>& contacts) {
    const auto &block1 = model.contacts.block1, &block2 = model.contacts.block2;
    asked_.assign(model.blocks.size(), 0);
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (contacts[c]) asked_[block1[c]] = asked_[block2[c]] = 1;
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const auto members = adjacency.bodies.members(i);
        const bool any = std::any_of(members.begin(), members.end(), [&](Row b) { return asked_[b]; });
        for (const Row b : members) asked_[b] = any;
    }
    near_ = asked_;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (asked_[block1[c]] || asked_[block2[c]]) near_[block1[c]] = near_[block2[c]] = 1;
    look(model, adjacency);
}

void StepBounds::look(const Model& model, const Adjacency& adjacency) {
    const auto& blocks = model.blocks;
    centroid_ = blocks.centroid;
    gyration2_.resize(blocks.size());
    body_mass_ = blocks.mass;
    held_.resize(blocks.size());
    for_rows(blocks.size(), [&](Row b) {
        held_[b] = blocks.fixed[b] == fix_all || blocks.mass[b] <= 0;
        if (near_[b] && !blocks.deformable[b] && blocks.body[b] == 0)
            gyration2_[b] = least_eigenvalue(blocks.inertia[b]) / blocks.volume[b];
    });
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const auto members = adjacency.bodies.members(i);
        if (std::none_of(members.begin(), members.end(), [&](Row b) { return near_[b]; })) continue;
        const BodyMass body = body_mass(model, members);
        const double gyration2 = least_eigenvalue(body.inertia) / body.mass;
        std::uint8_t fixed = 0;
        for (const Row b : members) fixed |= blocks.fixed[b];
        for (const Row b : members) {
            centroid_[b] = body.centroid;
            gyration2_[b] = gyration2;
            body_mass_[b] = body.mass;
            held_[b] = fixed == fix_all || blocks.mass[members.front()] <= 0;
        }
    }
    const auto& contacts = model.contacts;
    sums_.resize(contacts.size());
    for_rows(contacts.size(), [&](Row c) {
        if ((asked_[contacts.block1[c]] || asked_[contacts.block2[c]]) && between_rigid(model, c)) add_contact(model, c);
    });
    if (model.settings.mass_scaling != MassScaling::none) find_stiffness(model, adjacency);
}

/// The size a of equation (7) of a rigid block's row at a sub-contact.
double StepBounds::size(const Model& model, Row block, Row sub_contact) const {
    const double arm2 = (model.sub_contacts.position[sub_contact] - centroid_[block]).squaredNorm();
    return std::sqrt(1 + arm2 / gyration2_[block]);
}

void StepBounds::add_contact(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    ContactSums sums;
    const Span span = contacts.sub_contacts[contact];
    const double factor = contacts.stiffness_area[contact] > 0 ? contacts.stiffness_area[contact] / contacts.area[contact] : 1;
    for (Row s = span.first; s < span.end(); ++s) {
        const double stiffness = factor * tangent_stiffness(model.sub_contacts, s);
        if (stiffness == 0) continue; // open
        const double a1 = size(model, contacts.block1[contact], s), a2 = size(model, contacts.block2[contact], s);
        sums.own1 += stiffness * a1 * a1;
        sums.cross += stiffness * a1 * a2;
        sums.own2 += stiffness * a2 * a2;
    }
    sums_[contact] = sums;
}

/// One side of a sub-contact, over all its nodes, in coordinates scaled by the roots of the masses.
double StepBounds::side(const Model& model, Row block, const Attachment& attachment, Row sub_contact) const {
    if (!model.blocks.deformable[block]) return root_of_block_[block] * size(model, block, sub_contact);
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        if (attachment.weights[k] != 0) sum += attachment.weights[k] * root_of_gridpoint_[attachment.gridpoints[k]];
    return sum;
}

/// Takes masses to go by.
void StepBounds::weigh(const Model& model, const Adjacency& adjacency, Masses masses) {
    const auto& blocks = model.blocks;
    root_of_block_.resize(blocks.size());
    for_rows(blocks.size(), [&](Row b) {
        const double mass = masses == Masses::unit   ? 1
                            : masses == Masses::real ? body_mass_[b]
                            : blocks.body[b] == 0    ? blocks.inertial_mass[b]
                                                     : body_mass_[b] * (blocks.inertial_mass[b] / blocks.mass[b]);
        root_of_block_[b] = held_[b] ? 0 : 1 / std::sqrt(mass);
    });
    if (adjacency.of_gridpoint.entries.empty()) return;

    const auto& points = model.gridpoints;
    root_of_gridpoint_.resize(points.size());
    for_rows(points.size(), [&](Row g) {
        const double mass = masses == Masses::unit ? 1 : masses == Masses::real ? points.mass[g] : points.inertial_mass[g];
        root_of_gridpoint_[g] = held(model, g) || mass <= 0 ? 0 : 1 / std::sqrt(mass);
    });
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    coupling_.resize(subs.size());
    for_rows(contacts.size(), [&](Row c) {
        if (between_rigid(model, c)) return;
        const Span span = contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s)
            coupling_[s] = tangent_stiffness(subs, s) * (side(model, contacts.block1[c], subs.side1[s], s) +
                                                    side(model, contacts.block2[c], subs.side2[s], s));
    });
}

// Sums of the absolute values in the rows of the joints' stiffness matrix, in the coordinates of the sizes.

double StepBounds::row_of_gridpoint(const Adjacency& adjacency, Row row) const {
    double sum = 0;
    for (auto e = adjacency.of_gridpoint.begin(row); e != adjacency.of_gridpoint.end(row); ++e)
        sum += root_of_gridpoint_[row] * e->weight * coupling_[e->sub_contact];
    return sum;
}

double StepBounds::row_of_block(const Model& model, const Adjacency& adjacency, Row row) const {
    const double root = root_of_block_[row];
    if (root == 0) return 0;
    double sum = 0;
    for (auto e = adjacency.of_block.begin(row); e != adjacency.of_block.end(row); ++e) {
        if (between_rigid(model, e->contact)) {
            const ContactSums& sums = sums_[e->contact];
            const auto& contacts = model.contacts;
            const Row other = e->side == 0 ? contacts.block2[e->contact] : contacts.block1[e->contact];
            sum += root * (root * (e->side == 0 ? sums.own1 : sums.own2) + root_of_block_[other] * sums.cross);
        } else {
            const Span span = model.contacts.sub_contacts[e->contact];
            for (Row s = span.first; s < span.end(); ++s) sum += root * size(model, row, s) * coupling_[s];
        }
    }
    return sum;
}

/// Of joined blocks together.
double StepBounds::row_of_body(const Model& model, const Adjacency& adjacency, std::size_t body) const {
    double sum = 0;
    for (const Row b : adjacency.bodies.members(body)) sum += row_of_block(model, adjacency, b);
    return sum;
}

// Gershgorin's theorem on the scaled stiffness matrix: a sub-contact of stiffness k couples its nodes i
// and j with at most k s_i s_j, s being the sizes over the roots of the masses, so every eigenvalue is below the
// largest of sum over sub-contacts of k s_i (sum over its nodes of s_j), to which the zones add theirs.
StepLimit StepBounds::limit(const Model& model, const Adjacency& adjacency, Masses masses) {
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    const auto& of_points = masses == Masses::real ? points.mass : points.inertial_mass;
    weigh(model, adjacency, masses);
    StepLimit limit;
    if (model.zones.size() > 0)
        limit = largest(points.size(), false, [&](Row g) {
            if (!asked_[points.block[g]] || held(model, g) || of_points[g] <= 0) return 0.0;
            return points.zone_frequency[g] * (points.mass[g] / of_points[g]) + row_of_gridpoint(adjacency, g);
        });
    take_larger(limit, largest(blocks.size(), true, [&](Row b) {
                    return asked_[b] && blocks.body[b] == 0 ? row_of_block(model, adjacency, b) : 0;
                }));
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const Row lead = adjacency.bodies.members(i).front();
        if (asked_[lead]) take_larger(limit, {row_of_body(model, adjacency, i), true, lead});
    }
    if (masses == Masses::real || model.settings.mass_scaling == MassScaling::none) return limit;

    const auto ratio = [](double k, double mass) { return k > 0 ? k / mass : 0; };
    StepLimit other = largest(points.size(), false, [&](Row g) { return ratio(stiffness_.of_gridpoint[g], of_points[g]); });
    take_larger(other, largest(blocks.size(), true,
                               [&](Row b) { return ratio(stiffness_.of_block[b], blocks.inertial_mass[b]); }));
    // Bounds that are the same but for rounding count as the one that holds without scaling.
    return other.frequency_squared < (1 - rounding) * limit.frequency_squared ? other : limit;
}

// The same theorem on the matrix M^-1 K itself, rotations measured by the radius of gyration: its rows are sums
// of stiffnesses that do not know of the neighbours' masses, over the body's own mass.
void StepBounds::find_stiffness(const Model& model, const Adjacency& adjacency) {
    weigh(model, adjacency, Masses::unit);
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    stiffness_.of_gridpoint.assign(points.size(), 0);
    stiffness_.of_block.assign(blocks.size(), 0);
    if (model.zones.size() > 0)
        for_rows(points.size(), [&](Row g) {
            if (!held(model, g))
                stiffness_.of_gridpoint[g] = points.zone_frequency[g] * points.mass[g] + row_of_gridpoint(adjacency, g);
        });
    for_rows(blocks.size(), [&](Row b) {
        if (blocks.body[b] == 0) stiffness_.of_block[b] = row_of_block(model, adjacency, b);
    });
    // Members share the stiffness of their body by mass, so that one factor scales them all.
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const auto members = adjacency.bodies.members(i);
        const double whole = row_of_body(model, adjacency, i);
        double mass = 0;
        for (const Row b : members) mass += blocks.mass[b];
        if (mass > 0)
            for (const Row b : members) stiffness_.of_block[b] = whole * (blocks.mass[b] / mass);
    }
}

} // namespace kaya
