// Joints between rigid blocks that begin to open become overlap contacts.
#include "mechanics/common/closure_search.hpp"
#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/contact_load.hpp"
#include "mechanics/contact/contact_geometry.hpp"
#include "mechanics/lanes/eight.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/contact/torn_bonds.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// Closures in margins: below the first the sign of a force is rounding, below the second it does not tell how a joint is closed.
constexpr double none = 1e-9, some = 1e-6;

/// Whether a row without force has a bond: its force passes from pressure to tension, and nothing has opened.
bool has_bond_without_force(const Model& model, const JointModel& joint, Row c, double margin) {
    constexpr double beyond_rounding = 4;
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s)
        if (subs.normal_force[s] <= none * subs.normal_stiffness[s] * subs.area[s] * margin &&
            holds_when_opened(model, joint, s, beyond_rounding * none * margin))
            return true;
    return false;
}

} // namespace

bool is_partly_open(const Model& model, const JointModel& joint, Row c) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const double margin = std::min(model.blocks.margin[contacts.block1[c]], model.blocks.margin[contacts.block2[c]]);
    const Span span = contacts.sub_contacts[c];
    bool open = false, closed = false;
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        const Eight force = group.load(subs.normal_force.data() + s),
                    of_margin =
                        group.load(subs.normal_stiffness.data() + s) * group.load(subs.area.data() + s) * margin;
        if (group.any_below(force, -none * of_margin)) return false;
        open = open || group.any_not_above(force, none * of_margin);
        closed = closed || group.any_below(some * of_margin, force);
    }
    return open && closed && !has_bond_without_force(model, joint, c, margin);
}

namespace {

/// Closure of a joint according to its sub-contacts.
struct Closures {
    double force = 0; ///< sum over rows
    Vec3 shear = Vec3::Zero();
    Row most = no_row; ///< the row with the greatest traction
    Row open = no_row; ///< one that carries nothing
    double area = 0;
    double deepest = 0;
    double mean_offset = 0; ///< closure besides that of the places, weighted with the forces
    double misfit = 0;      ///< closure of places that the mean offset calls open, or the reverse
};

/// Closure that belongs to the normal force of a row: that of its spring, or its displacement if that is more, as for a joint that
/// stiffens.
double closure_of(const SubContacts& subs, Row s) {
    const double stiffness = subs.normal_stiffness[s] * subs.area[s];
    return std::max(stiffness > 0 ? subs.normal_force[s] / stiffness : 0, -subs.normal_displacement[s]);
}

Closures closures_of(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    Closures found;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double greatest = 0, low = infinity, high = -infinity, nearest = -infinity, open = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        found.shear += Vec3(subs.shear_force[s]);
        const bool known = subs.side1[s].attached() && subs.side2[s].attached();
        found.area += subs.area[s];
        if (!(subs.normal_force[s] > 0)) {
            found.open = s;
            if (!known) continue;
            open += subs.normal_displacement[s] - gap_of_sides(model, s);
            nearest = std::max(nearest, -gap_of_sides(model, s));
            continue;
        }
        found.force += subs.normal_force[s];
        const double closure = closure_of(subs, s), traction = subs.normal_force[s] / subs.area[s];
        const double offset = known ? closure + gap_of_sides(model, s) : 0;
        found.mean_offset += subs.normal_force[s] * offset;
        low = std::min(low, offset);
        high = std::max(high, offset);
        found.deepest = std::max(found.deepest, closure);
        if (traction > greatest) {
            greatest = traction;
            found.most = s;
        }
    }
    if (found.force > 0) {
        found.mean_offset /= found.force;
        found.misfit = std::max(high - low, nearest + found.mean_offset);
    } else {
        // All open: an initial overlap keeps carrying no force.
        found.most = span.first;
        found.mean_offset = std::min(0.0, -open / span.count);
    }
    return found;
}

/// The normal force of the overlap contact when a joint opens in part. The rows integrate closures that are linear over the joint exactly,
/// but miss those of a part of it by up to half. With the force of the rows the overlap would carry too little for as long as it lasts, and
/// return more energy than it takes.
double force_of_overlap(const Model& model, Row c, const Closures& closures, const OverlapPatch& patch) {
    constexpr double most = 2; // times the rows' force
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    double volume = 0;
    for (Row s = span.first; s < span.end(); ++s)
        if (subs.side1[s].attached() && subs.side2[s].attached())
            volume += subs.area[s] * std::max(0.0, -gap_of_sides(model, s) + closures.mean_offset);
    return volume > 0 ? closures.force * std::clamp(patch.carried / volume, 1 / most, most) : closures.force;
}

/// Compares the force of the overlap of two blocks, with an offset linear over the joint, with the required resultant.
class ResultantFit {
public:
    ResultantFit(const Model& model_, Row contact, const Closures& closures, OverlapScratch& scratch_)
        : model(model_), scratch(scratch_), pair(pair_of(model_.contacts, contact)), n(model_.contacts.normal[contact]),
          carried(closures.force / model_.sub_contacts.normal_stiffness[closures.most]) {
        const auto& subs = model.sub_contacts;
        const Span span = model.contacts.sub_contacts[contact];
        Vec3 centre = Vec3::Zero();
        Mat3 spread = Mat3::Zero();
        for (Row s = span.first; s < span.end(); ++s) middle += Vec3(subs.position[s]) / span.count;
        for (Row s = span.first; s < span.end(); ++s) {
            const Vec3 arm = subs.position[s] - middle, flat = arm - arm.dot(n) * n;
            centre += subs.normal_force[s] / closures.force * flat;
            spread += flat * flat.transpose() / span.count;
        }
        // In lengths of the joint along and across it: a strip is as well conditioned as a square.
        const Eigen::SelfAdjointEigenSolver<Mat3> principal(spread); // the first is across the plane
        constexpr double least = 1e-6;                               // places in a line have no length across it
        for (int i = 0; i < 2; ++i)
            per_length[i] = principal.eigenvectors().col(i + 1) /
                            std::sqrt(std::max(principal.eigenvalues()[i + 1], least * pair.least_area));
        wanted = {1, centre.dot(per_length[0]), centre.dot(per_length[1])};
    }

    /// The offset from a closure in the middle and its increase over a length.
    ClosureOffset offset(const Vec3& closure) const {
        ClosureOffset made;
        made.tilt = closure[1] * per_length[0] + closure[2] * per_length[1];
        made.closure = closure[0] - made.tilt.dot(middle - model.blocks.centroid[pair.block1]);
        return made;
    }

    struct Carried {
        Vec3 excess; ///< over the resultant: parts of its force, and of its moments over force and length
        double depth;
    };
    Carried at(const Vec3& closure) const {
        const OverlapPatch patch = overlap_patch(model, pair, n, offset(closure), scratch);
        const Vec3 arm = patch.centre - middle;
        const double part = patch.carried / carried;
        return {Vec3(part, part * arm.dot(per_length[0]), part * arm.dot(per_length[1])) - wanted, patch.depth};
    }

    /// The closure in the middle alone that gives the force.
    double closure_for_force(double start) const {
        return closure_with_none_missing(
            [&](double closure) {
                return -at({closure, 0, 0}).excess[0];
            },
            start, carried / pair.least_area);
    }

private:
    const Model& model;
    OverlapScratch& scratch;
    OverlapPair pair;
    Vec3 n;
    double carried; ///< force over stiffness
    Vec3 middle = Vec3::Zero(), wanted;
    std::array<Vec3, 2> per_length; ///< unit vectors along and across the joint over its lengths
};

/// Finds the offset, linear over the joint, with which the overlap has the force and the moments of the rows, by Newton's method. A
/// resultant beyond the edge of a joint, which no overlap can have, is approached until the overlap is as deep as the rows are closed;
/// without that bound the offset would grow without limit.
ClosureOffset closure_of_resultant(const Model& model, Row c, const Closures& closures, OverlapScratch& scratch) {
    constexpr double met = 1e-3, deepest = 2; // of the resultant; of the closure of the rows
    constexpr int most_steps = 20, most_halves = 8;
    const ResultantFit fit(model, c, closures, scratch);
    Vec3 closure(fit.closure_for_force(closures.mean_offset), 0, 0);
    ResultantFit::Carried now = fit.at(closure);
    const double limit = std::max(deepest * closures.deepest, now.depth);
    for (int i = 0; i < most_steps && now.depth > 0 && now.excess.norm() > met; ++i) {
        const double difference = 1e-3 * now.depth;
        Mat3 slope;
        for (int k = 0; k < 3; ++k)
            slope.col(k) = (fit.at(closure + difference * Vec3::Unit(k)).excess - now.excess) / difference;
        const Vec3 step = slope.fullPivLu().solve(now.excess);
        double part = 1;
        ResultantFit::Carried next = fit.at(closure - step);
        const auto is_better = [&] {
            return next.depth > 0 && next.depth <= limit && next.excess.norm() < now.excess.norm();
        };
        for (int k = 0; k < most_halves && !is_better(); ++k) next = fit.at(closure - (part *= 0.5) * step);
        if (!is_better()) break;
        closure -= part * step;
        now = next;
    }
    return fit.offset(closure);
}

/// History of a row.
struct RowState {
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    std::array<double, KAYA_JMODEL_MAX_FIELDS> field{};
    std::uint32_t field_set = 0;
    JointObject object;
    std::uint32_t state;
    double normal_stiffness, shear_stiffness, displacement;

    RowState(const SubContacts& subs, Row s)
        : state(subs.state[s]), normal_stiffness(subs.normal_stiffness[s]), shear_stiffness(subs.shear_stiffness[s]),
          displacement(subs.normal_displacement[s]) {
        for (std::int32_t h = 0; h < subs.history_columns; ++h) history[h] = subs.history[h][s];
        for (std::int32_t k = 0; k < subs.field_columns; ++k) field[k] = subs.field[k][s];
        if (subs.field_columns > 0) field_set = subs.field_set[s];
        if (subs.keeps_objects) object = subs.object[s];
    }
    void put(SubContacts& subs, Row s) const {
        for (std::int32_t h = 0; h < subs.history_columns; ++h) subs.history[h][s] = history[h];
        for (std::int32_t k = 0; k < subs.field_columns; ++k) subs.field[k][s] = field[k];
        if (subs.field_columns > 0) subs.field_set[s] = field_set;
        if (subs.keeps_objects) subs.object[s] = object;
        subs.state[s] = state;
        subs.normal_stiffness[s] = normal_stiffness;
        subs.shear_stiffness[s] = shear_stiffness;
        subs.normal_displacement[s] = displacement;
    }
};

Vec3 row_of(const Eight3& rows, Row k) { return {rows.x[k], rows.y[k], rows.z[k]}; }

/// Four places of equal area with the first and second moments of the area of a joint's rows; fewer unloaded rows are all in its centroid.
Eight3 places_of_face(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    double area = 0;
    Vec3 centre = Vec3::Zero();
    for (Row s = span.first; s < span.end(); ++s) area += subs.area[s], centre += subs.area[s] * Vec3(subs.position[s]);
    if (!(area > 0)) return eights(model.contacts.position[c]);
    centre /= area;
    if (span.count < 2 * carriers) return eights(centre);
    Mat3 second = Mat3::Zero();
    for (Row s = span.first; s < span.end(); ++s) {
        const Vec3 arm = subs.position[s] - centre;
        second += subs.area[s] / area * arm * arm.transpose();
    }
    const Vec3 &n = model.contacts.normal[c], &axis = model.contacts.axis[c];
    return PressureSpread(centre, second, n, axis.isZero() ? Vec3(n.unitOrthogonal()) : axis).places();
}

/// Gives an overlap contact the geometry of a patch. Returns the places of its carriers.
Eight3 lie_on(Contacts& contacts, Row c, const OverlapPatch& patch) {
    const bool closed = patch.carried > 0;
    contacts.depth[c] = closed ? patch.depth : 0;
    contacts.twist[c] = patch.twist;
    contacts.area[c] = patch.carrying_area(contacts.least_area[c]);
    contacts.shear_area[c] = std::max(patch.area, contacts.area[c]);
    contacts.stiffness_area[c] = rung_above(contacts.shear_area[c], contacts.least_area[c]);
    contacts.energy_length[c] = closed ? patch.energy / patch.carried : 0;
    if (!closed) return eights(contacts.position[c]);
    contacts.normal[c] = patch.normal;
    contacts.axis[c] = axis_in_plane(contacts.axis[c], patch.longest_edge, patch.normal);
    contacts.position[c] = patch.centre;
    return PressureSpread(patch, contacts.axis[c]).places();
}

} // namespace

void share_overlap(Model& model, const JointModel& joint, Row c, OverlapScratch& scratch) {
    if (!follows_overlap(model, c)) return;
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const double depth = contacts.depth[c], area = contacts.area[c], energy = area * depth * contacts.energy_length[c];
    if (!(energy > 0)) return;
    OverlapSlopes slopes;
    const bool curved = contacts.curved[c] != 0;
    const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset_of(contacts, c),
                                             scratch, curved ? &slopes : nullptr);
    const bool closed = patch.carried > 0;
    const Eight3 places = lie_on(contacts, c, patch);
    const CarrierRows rows = patch.rows(contacts.least_area[c]);
    contacts.energy_taken[c] *= patch.energy / energy;
    // Straight springs follow the depth; curved ones are run to it.
    const double of_force = curved && closed ? contacts.area[c] / area : patch.carried / (area * depth);
    for (Row k = 0; k < span.count; ++k) {
        const Row s = span.first + k;
        const bool carries = k < carriers;
        subs.normal_force[s] *= of_force;
        subs.shear_force.set(s, of_force * Vec3(subs.shear_force[s]));
        subs.position.set(s, carries ? row_of(places, k) : contacts.position[c]);
        if (!carries) continue;
        const auto i = static_cast<std::size_t>(k);
        if (!curved || !closed)
            subs.normal_displacement[s] += area * depth / (carriers * subs.area[s]) - rows.closure[i];
        subs.area[s] = rows.area;
    }
    if (curved && closed) return close_halves(model, joint, c, slopes);
    BatchColumns made;
    initialise_rows(model, joint, c, std::min(carriers, span.count), made);
}

double follow_overlap(Model& model, const JointModel& joint, Row c, OverlapScratch& scratch) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const ContactLoad load(model, c);
    const double stored = contacts.curved[c] != 0 && contacts.kind[c] == ContactKind::joint
                              ? load.shear_energy + energy_of_rows(model, joint, c)
                              : load.stored();
    Closures closures = closures_of(model, c);
    if (contacts.kind[c] == ContactKind::joint) begin_tearing(model, joint, c);
    closures.most = row_of_majority(model, c, closures.most);
    ClosureOffset offset;
    constexpr double same = 0.05; // of the deepest closure
    offset.closure = closures.mean_offset;
    const bool fits = !(closures.force > 0 && closures.misfit > same * closures.deepest);
    if (!fits) offset = closure_of_resultant(model, c, closures, scratch);

    OverlapSlopes slopes;
    const bool curved = contacts.curved[c] != 0;
    const OverlapPatch patch =
        overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset, scratch, curved ? &slopes : nullptr);
    const bool closed = patch.carried > 0 && closures.force > 0;
    const double force = fits && closed ? force_of_overlap(model, c, closures, patch) : closures.force;
    if (contacts.kind[c] == ContactKind::joint) contacts.whole_area[c] = closures.area;
    contacts.kind[c] = ContactKind::overlap;
    contacts.offset[c] = offset.closure;
    contacts.offset_tilt[c] = offset.tilt;
    contacts.offset_normal[c] = contacts.normal[c];
    contacts.axis[c].setZero();
    const Eight3 places = lie_on(contacts, c, patch);
    const Eight3 wet_places = places_of_face(model, c);
    const CarrierRows rows = patch.rows(contacts.least_area[c]);
    if (!closed) contacts.depth[c] = 0;
    contacts.energy_taken[c] = force * contacts.energy_length[c];
    contacts.withheld[c] = contacts.slip_since_update[c] = contacts.unforced_overlap[c] = contacts.withdrawn_energy[c] =
        0;
    const Vec3 n = contacts.normal[c], shear = closures.shear - closures.shear.dot(n) * n;
    double dashpots = 0; // the joint's dashpots act on the carriers, which are elsewhere than its rows
    Vec3 shear_dashpots = Vec3::Zero();
    for (Row s = span.first; s < span.end(); ++s) {
        dashpots += subs.dashpot_normal[s];
        shear_dashpots += Vec3(subs.dashpot_shear[s]);
    }
    // Unloaded rows get the area of the open part, a history of open places, and places where water acts.
    const Row source_open = closures.open == no_row ? closures.most : closures.open;
    const RowState of_carrier(subs, closures.most), of_open(subs, source_open);
    const double of_area = subs.area[closures.most];
    const ClosedPlace most{closure_of(subs, closures.most),
                           of_area > 0 ? subs.normal_force[closures.most] / of_area : 0};
    for (Row k = 0; k < span.count; ++k) {
        const Row s = span.first + k;
        const bool carries = k < carriers;
        const auto i = static_cast<std::size_t>(k % carriers);
        (carries ? of_carrier : of_open).put(subs, s);
        if (carries) subs.area[s] = rows.area;
        else if (closures.open == no_row) subs.area[s] = 0;
        subs.normal_force[s] = carries && closed ? force / carriers : 0;
        subs.shear_force.set(s, carries && closed ? Vec3(shear / carriers) : Vec3(Vec3::Zero()));
        if (carries) subs.normal_displacement[s] = closed ? -rows.closure[i] : std::max(0.0, of_carrier.displacement);
        subs.position.set(s, carries ? row_of(places, k) : row_of(wet_places, (k - carriers) % carriers));
        subs.shear_arm.set(s, Vec3::Zero());
        subs.dashpot_normal[s] = carries ? dashpots / carriers : 0;
        subs.dashpot_shear.set(s, carries ? Vec3(shear_dashpots / carriers) : Vec3(Vec3::Zero()));
    }
    put_open_area(model, c);
    note_torn(model, c);
    if (!curved) {
        BatchColumns made;
        initialise_rows(model, joint, c, std::min(carriers, span.count), made);
    } else if (closed) {
        begin_curved(model, joint, c, slopes, most);
    }
    return stored - ContactLoad(model, c).stored();
}

void close_joint(Model& model, const JointModel& joint, const ContactDraft& draft, Row c, const ContactLoad& before,
                 const ClosureOffset& offset, std::vector<char>& moved) {
    auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const Vec3& n = draft.plane.normal;
    const Vec3 origin = model.blocks.centroid[draft.block1], shear = before.shear_sum - before.shear_sum.dot(n) * n;
    const auto closure = [&](const ContactPoint& p) {
        return offset.closure + offset.tilt.dot(p.position - origin) - p.gap;
    };
    // A curved joint model is run from the closure of the deeper half to that of each place.
    const bool curved = model.contacts.curved[c] != 0;
    const double deep = -subs.normal_displacement[first],
                 stress = subs.area[first] > 0 ? subs.normal_force[first] / subs.area[first] : 0,
                 power = curved ? power_at({deep, stress}, subs.normal_stiffness[first]) : 1;
    // Over the deepest closure, since a power of a small length may be 0.
    double deepest = 0, whole = 0;
    for (const auto& point : draft.points) deepest = std::max(deepest, closure(point));
    const auto share = [&](const ContactPoint& p) {
        const double closed = deepest > 0 ? std::max(0.0, closure(p)) / deepest : 0;
        return p.area * (curved ? std::pow(closed, power) : closed);
    };
    for (const auto& point : draft.points) whole += share(point);
    for (std::size_t i = 0; i < draft.points.size(); ++i) {
        const ContactPoint& point = draft.points[i];
        const Row s = first + static_cast<Row>(i);
        const double closed = closure(point), part = closed > 0 ? share(point) / whole : 0;
        subs.contact[s] = c;
        subs.type[s] = point.type;
        subs.side1[s] = point.side1;
        subs.side2[s] = point.side2;
        subs.position.set(s, point.position);
        subs.shear_arm.set(s, Vec3::Zero());
        subs.area[s] = point.area;
        subs.normal_force[s] = part * before.normal;
        subs.shear_force.set(s, part * shear);
        // The history is that of a loaded place: its joint model receives the opening of the others.
        moved[static_cast<std::size_t>(s)] = curved || closed < 0;
        subs.normal_displacement[s] = std::min(0.0, -closed);
        if (curved) {
            subs.normal_force[s] = stress * point.area;
            subs.normal_displacement[s] = -deep;
            subs.normal_displacement_increment[s] = deep - closed;
        }
        if (s == first) continue;
        for (std::size_t h = 0; h < static_cast<std::size_t>(subs.history_columns); ++h)
            subs.history[h][s] = subs.history[h][first];
        for (std::size_t k = 0; k < static_cast<std::size_t>(subs.field_columns); ++k)
            subs.field[k][s] = subs.field[k][first];
        if (subs.field_columns > 0) subs.field_set[s] = subs.field_set[first];
        if (subs.keeps_objects) subs.object[s] = subs.object[first];
        subs.state[s] = subs.state[first];
        subs.normal_stiffness[s] = subs.normal_stiffness[first];
        subs.shear_stiffness[s] = subs.shear_stiffness[first];
    }
    tear(model, joint, c);
    if (curved) return;
    BatchColumns made;
    initialise_rows(model, joint, c, static_cast<Row>(draft.points.size()), made);
    for (std::size_t i = 0; i < draft.points.size(); ++i)
        subs.normal_displacement_increment[first + static_cast<Row>(i)] = std::max(0.0, -closure(draft.points[i]));
}

} // namespace kaya
