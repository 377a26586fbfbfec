#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/common/growth.hpp"
#include "mechanics/shape/overlap_gap.hpp"
#include "mechanics/contact/overlap_shear.hpp"

#include "mechanics/common/closure_search.hpp"
#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/contact/torn_bonds.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace kaya {

namespace {

/// Whether no force acts in a contact; forces set by a script or a command count, and so does water.
bool is_idle(const Model& model, Row c) {
    if (model.contacts.depth[c] > 0) return false;
    const auto& subs = model.sub_contacts;
    const bool damped = joints_are_damped(model.settings);
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        if (!all_zero(group.load(subs.normal_force.data() + s)) || !all_zero(group.load(subs.shear_force, s)) ||
            !all_zero(group.load(subs.pore_pressure.data() + s)))
            return false;
        if (damped &&
            !(all_zero(group.load(subs.dashpot_normal.data() + s)) && all_zero(group.load(subs.dashpot_shear, s))))
            return false;
    }
    return true;
}

/// Whether the joint model has left a contact unchanged, without force.
bool stays_without_force(const Model& model, Row c, const CarriedLoad& before) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    for (Row k = 0; k < carriers; ++k)
        if (!before.shear[static_cast<std::size_t>(k)].isZero(0) ||
            subs.frictional_work[span.first + k] != before.worn_by_row[static_cast<std::size_t>(k)])
            return false;
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        if (!all_zero(group.load(subs.normal_force.data() + s)) || !all_zero(group.load(subs.shear_force, s)))
            return false;
    }
    return true;
}

/// Frictional work of idle contacts counts before and after a step, as for all others.
void add_friction_of(const Model& model, Row c, JointWork& work) { work.friction[0] += frictional_work(model, c); }

/// Turns the shear forces into the plane and with the mean spin of the blocks about its normal. Returns the energy lost or created: the
/// blocks move under the force before the rotation, the springs under the one after it.
double turn_shear(Model& model, Row c, const Vec3& n, const RelativeMotion& motion) {
    const Vec3 turn = 0.5 * (motion.one.turn + motion.two.turn);
    const RelativeMotion start = motion.at_start();
    double lost = 0;
    auto& subs = model.sub_contacts;
    const Eight twist = eights(turn.dot(n)), none{}, same = eights(1);
    const Eight3 normal = eights(n);
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        const Eight3 force = group.load(subs.shear_force, s), projected = in_plane(force, normal);
        const Eight size = square_root(force.dot(force)), left = square_root(projected.dot(projected));
        const Eight3 flat = projected * (left > none ? size / left : same); // rotation keeps its size
        const Eight3 turned = flat + normal.cross(flat) * twist;
        const Eight work = (turned - force).dot(start.at(shear_places(subs, s, group)));
        lost += 0.5 * sum(work);
        group.store(subs.shear_force, s, turned);
    }
    return lost;
}

/// Changes the area of the carriers of a contact. Normal tractions are kept. So are shear forces between parallel faces, whose springs have
/// the shear area; on rolling corners and edges, shear force is lost with the area that separates.
void change_areas(SubContacts& subs, Span rows, double area, bool lies) {
    for (Row s = rows.first; s < rows.first + std::min(carriers, rows.count); ++s) {
        const double ratio = subs.area[s] > 0 ? area / subs.area[s] : 1;
        subs.normal_force[s] *= ratio;
        subs.area[s] = area;
        if (ratio < 1 && !lies) subs.shear_force.set(s, ratio * Vec3(subs.shear_force[s]));
    }
}

/// From the places of the pressure to those of the shear forces, at most as far as the ellipse of its second moments reaches.
Eight3 shear_arms(const Eight3& held, const Eight3& place, const PressureSpread& spread, const Eight3& normal) {
    if (!(spread.square > 0)) return eights(Vec3(Vec3::Zero()));
    const Eight3 arm = in_plane(held - place, normal);
    const Eight square = spread.squares_of(arm), one = eights(1);
    return arm * (square > one ? one / square_root(square) : one);
}

double normal_force_of(const Model& model, Row c) {
    const Span span = model.contacts.sub_contacts[c];
    double sum = 0;
    for (Row s = span.first; s < span.end(); ++s) sum += model.sub_contacts.normal_force[s];
    return sum;
}

/// For a force that was set without overlap: the offset at which the overlap carries it.
double offset_for_force(const Model& model, Row c, double force, double stiffness, OverlapScratch& scratch) {
    const auto& contacts = model.contacts;
    ClosureOffset offset = offset_of(contacts, c);
    const auto missing = [&](double closure) {
        offset.closure = closure;
        const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset, scratch);
        return force - stiffness * patch.carried;
    };
    return closure_with_none_missing(missing, contacts.offset[c], force / (stiffness * contacts.least_area[c]));
}

/// Places that move with the material, the mean of the motions of both blocks, from those at the start of a step.
Eight3 kept_places(const Eight3& places, const Eight3& one, const Eight3& two) {
    return places + (one + two) * eights(0.5);
}

/// The rows of carriers from one vector, and the unloaded rows from another.
Eight3 loaded_first(const Eight3& loaded, const Eight3& others) {
    static_assert(carriers == lane_count);
    const auto both = [](const Eight& a, const Eight& b) { return joined(low_half(a), high_half(b)); };
    return {both(loaded.x, others.x), both(loaded.y, others.y), both(loaded.z, others.z)};
}

/// Writes places and increments of blocks that are apart: loaded rows stand in one place. `n` is the normal. The joint model's closure is kept,
/// and the loaded rows slip.
void write_rows_apart(Model& model, Row c, const Vec3& n, const RelativeMotion& motion) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const bool parts = contacts.depth[c] > 0;
    contacts.depth[c] = contacts.twist[c] = 0;
    const Vec3 shift = motion.at(contacts.position[c]), flat = shift - shift.dot(n) * n;
    const bool wet = is_wet_beyond(contacts, c);
    const RelativeMotion start = motion.at_start();
    const Eight3 place = eights(contacts.position[c]), none = eights(Vec3(Vec3::Zero()));
    for (Row i = 0; i < span.count; i += eight) {
        const RowsOfEight group(span.count - i), loaded(std::clamp<Row>(carriers - i, 0, span.count - i));
        const Row first = span.first + i;
        Eight3 kept = place;
        if (wet) {
            const Eight3 held = group.load(subs.position, first);
            kept = kept_places(held, start.one.at(held), start.two.at(held));
        }
        const Eight closed = loaded.load(subs.normal_displacement.data() + first);
        group.store(subs.position, first, i == 0 ? loaded_first(place, kept) : kept);
        if (parts) group.store(subs.shear_arm, first, none);
        group.store(subs.normal_displacement_increment.data() + first, larger_of(-closed, Eight{}));
        group.store(subs.shear_displacement_increment, first, none);
        loaded.store(subs.shear_displacement_increment, first, eights(flat));
    }
}

/// Writes places, areas and increments for the present common volume.
void write_rows(Model& model, Row c, const OverlapPatch& patch, const CarrierRows& rows, const RelativeMotion& motion) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const Vec3 n = patch.normal;
    if (!(patch.carried > 0)) return write_rows_apart(model, c, n, motion);
    const bool was_closed = contacts.depth[c] > 0;
    const RelativeMotion start = motion.at_start();
    contacts.axis[c] = axis_in_plane(contacts.axis[c], patch.longest_edge, n);
    const PressureSpread spread(patch, contacts.axis[c]);
    const Eight3 places = spread.places();
    contacts.position[c] = patch.centre;
    contacts.area[c] = patch.carrying_area(contacts.least_area[c]);
    contacts.shear_area[c] = std::max({contacts.shear_area[c], contacts.area[c], patch.area});
    contacts.depth[c] = patch.depth;
    contacts.twist[c] = patch.twist;
    change_areas(subs, span, rows.area, patch.lies);
    const bool wet = is_wet_beyond(contacts, c);
    put_open_area(model, c);
    const Eight3 normal = eights(n), centre = eights(contacts.position[c]), none = eights(Vec3(Vec3::Zero()));
    for (Row i = 0; i < span.count; i += eight) {
        const RowsOfEight group(span.count - i), loaded(std::clamp<Row>(carriers - i, 0, span.count - i));
        const Row first = span.first + i;
        const bool loaded_before = was_closed && i == 0;
        Eight3 place = i == 0 ? places : centre, arm = none, shift;
        if (wet || loaded_before) {
            const Eight3 held = shear_places(subs, first, group), one = start.one.at(held), two = start.two.at(held),
                         kept = kept_places(held, one, two);
            if (wet) place = i == 0 ? loaded_first(places, kept) : kept;
            // The mean of start and end: slip at the end alone lags behind the places, and a block at rest would gain energy from its weight.
            if (loaded_before) {
                arm = loaded_first(shear_arms(kept, place, spread, normal), none);
                shift = (motion.at(place + arm) + (two - one)) * eights(0.5);
            }
        }
        if (!loaded_before) shift = motion.at(place);
        Eight closed{};
        for (Row k = 0; k < loaded.rows(); ++k) closed[k] = rows.closure[static_cast<std::size_t>(k)];
        const Eight opening = -closed - group.load(subs.normal_displacement.data() + first);
        group.store(subs.position, first, place);
        if (i == 0) group.store(subs.shear_arm, first, arm);
        group.store(subs.normal_displacement_increment.data() + first, Eight{});
        loaded.store(subs.normal_displacement_increment.data() + first, opening);
        group.store(subs.shear_displacement_increment, first, none);
        loaded.store(subs.shear_displacement_increment, first, in_plane(shift, normal));
    }
}

/// The tilt of an offset turns with block 1. It is reduced by the tilt of the blocks in the same direction.
void turn_offset(Contacts& contacts, Row c, const RelativeMotion& motion, const Vec3& origin) {
    Vec3& tilt = contacts.offset_tilt[c];
    const double size = tilt.norm();
    if (!(size > 0)) return;
    tilt += motion.one.turn.cross(tilt);
    const Vec3 along = tilt / size, tilted = (motion.two.turn - motion.one.turn).cross(contacts.normal[c]);
    const double used = std::clamp(tilted.dot(along), 0.0, size);
    tilt -= used * along;
    contacts.offset[c] += used * along.dot(contacts.position[c] - origin);
}

/// Work of the normal force, and of the moment that comes with it, on the motion of a step.
double normal_work(const Model& model, Row c, const RelativeMotion& motion) {
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Vec3& n = contacts.normal[c];
    const Eight3 along = eights(n);
    const Span span = contacts.sub_contacts[c];
    double work = 0, force = 0;
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        const Eight forces = group.load(subs.normal_force.data() + s);
        work += sum(forces * along.dot(motion.at(group.load(subs.position, s))));
        force += sum(forces);
    }
    return work + force * contacts.twist[c] * n.dot(motion.two.turn - motion.one.turn);
}

/// Shear force is scaled too: friction limits both. Returns the energy lost from the shear springs.
double scale_force(Model& model, Row c, double scale) {
    auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    const double before = shear_energy(model, c);
    for (Row s = span.first; s < span.end(); ++s) subs.normal_force[s] *= scale;
    scale_shear(subs, span, scale);
    return before * (1 - scale * scale);
}

/// The joint model's springs and friction see the whole shear force during half a step, but a part of it is withheld from the blocks.
/// Returns the work of the withheld part on the motion of the step. `scale` is that of the present forces.
double withheld_shear_work(const Model& model, Row c, double scale, const RelativeMotion& motion) {
    if (scale == 1 || !(scale > 0)) return 0;
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    double work = 0;
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        work += sum(group.load(subs.shear_force, s).dot(motion.at(shear_places(subs, s, group))));
    }
    return -0.5 * (1 / scale - 1) * work;
}

/// Work of a contact on motions below the precision of coordinates: a block at rest moves by less in a step.
double rounding_of_work(const Model& model, Row c, double force) {
    constexpr double precision = 0x1p-50;
    const auto& blocks = model.blocks;
    const Vec3 &one = blocks.centroid[model.contacts.block1[c]], &two = blocks.centroid[model.contacts.block2[c]];
    const Vec3 size = (two - one).cwiseAbs();
    return precision * force * (size + one.cwiseAbs().cwiseMax(two.cwiseAbs())).maxCoeff();
}

/// Steps are finite: a contact that closes and opens within a few steps would return a little more or less than it took. On corners and
/// edges it returns no more: where the energy taken is below that of its overlap, the force is that of the lower one, within limits, so
/// that the overlap remains the one that the load requires. `worn` is the frictional work of the whole force in the step. Returns the
/// energy removed from the account without work.
double keep_passive(Model& model, Row c, bool lies, double worn) {
    constexpr double least_scale = 0.75, recovery = 2e-3, surplus = 1.1;
    // When little energy is exchanged in a step, relax toward the exact value; at maximum penetration this holds only briefly.
    constexpr double slow = 1e-3, settling = 0.02;
    auto& contacts = model.contacts;
    const RelativeMotion motion(model, c);
    const double of_overlap = normal_force_of(model, c) * contacts.energy_length[c];
    const double work = 0.5 * normal_work(model, c, motion);
    double& taken = contacts.energy_taken[c];
    const double before = taken, scale_before = 1 - contacts.withheld[c];
    double scale = 1, of_shear = 0;
    taken -= work;
    if (lies) taken = of_overlap;
    else if (std::abs(work) < slow * of_overlap) taken += settling * (of_overlap - taken);
    if (of_overlap > 0 && taken < of_overlap) {
        taken = std::max(taken, least_scale * least_scale * of_overlap);
        scale = std::sqrt(taken / of_overlap);
        of_shear += scale_force(model, c, scale);
        taken += (1 - scale) * work + recovery * (of_overlap - taken);
    }
    // Half of a force's work is still to come. Where the blocks separate meanwhile, no more than the rest may be returned.
    if (const double to_come = scale * work; of_overlap > 0 && to_come > taken) {
        const double part = std::max(0.0, 0.5 * (taken + to_come) / to_come);
        of_shear += scale_force(model, c, part);
        scale *= part;
        taken += (1 - part) * to_come;
    }
    taken = std::min(taken, surplus * of_overlap);
    contacts.withheld[c] = 1 - scale;
    double lost = before - scale * work - taken + of_shear;
    if (std::abs(lost) < rounding_of_work(model, c, normal_force_of(model, c))) lost = 0;
    // The withheld part of the work of the shear springs comes from the account of the contact, and friction dissipates less.
    const double not_worn = (1 - 0.5 * (scale_before + scale)) * worn;
    taken = std::max(0.0, taken + not_worn - withheld_shear_work(model, c, scale, motion));
    return lost - not_worn;
}

/// Surfaces that climb on each other are farther apart at the same closure: the growth of the force beyond the closure of the step is moved
/// to the offset, so that the overlap keeps representing the force of the joint model. Over a closed path this adds up to zero for any law
/// whose force depends on its closure only.
void take_dilation(Model& model, Row c, const CarriedLoad& before) {
    constexpr double rounding = 1e-12; // of the depth
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const CarriedLoad after(model, c);
    const double stiffness = 0.5 * (before.stiffness + after.stiffness);
    if (!(before.force > 0 && after.force > 0 && stiffness > 0)) return;
    const Row first = contacts.sub_contacts[c].first;
    const double dilation = (after.force - before.force) / stiffness + subs.normal_displacement_increment[first];
    if (!(std::abs(dilation) > rounding * contacts.depth[c])) return;
    contacts.offset[c] += dilation;
    contacts.energy_taken[c] += after.force * dilation;
    for (Row s = first; s < first + carriers; ++s) subs.normal_displacement[s] -= dilation;
}

/// The joint model sees the force of the overlap. Returns the energy lost from the shear springs.
double take_back_scale(Model& model, Row c) {
    const double missing = model.contacts.withheld[c];
    return missing > 0 && missing < 1 ? scale_force(model, c, 1 / (1 - missing)) : 0;
}

} // namespace

void begin_without_force(Model& model, Row c, OverlapScratch& scratch) {
    auto& contacts = model.contacts;
    contacts.offset[c] = 0;
    contacts.offset_tilt[c].setZero();
    const OverlapPair pair = pair_of(contacts, c);
    ClosureOffset offset;
    if (gap_along(model, pair.block1, pair.block2, contacts.normal[c], offset) >=
        -rounding_of_gap(model, pair.block1, pair.block2))
        return;
    const OverlapPatch patch = overlap_patch(model, pair, contacts.normal[c], offset, scratch);
    if (!(patch.carried > 0)) return;
    const Vec3 n = patch.normal;
    const auto overlaps = [&](double closure) {
        offset.closure = closure;
        return overlap_patch(model, pair, n, offset, scratch).carried > 0;
    };
    double low = -patch.depth, high = 0;
    for (int i = 0; i < 20 && overlaps(low); ++i) low *= 2;
    for (int i = 0; i < 16; ++i) { // to some 1e-5 of the overlap, from the side without force
        const double middle = 0.5 * (low + high);
        (overlaps(middle) ? high : low) = middle;
    }
    contacts.offset[c] = low;
    contacts.offset_normal[c] = n;
}

OverlapStart move_overlap_contact(Model& model, Row c, JointWork& work, OverlapScratch& scratch,
                                  OverlapSlopes* slopes) {
    auto& contacts = model.contacts;
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const RelativeMotion motion(model, c);
    const bool idle = is_idle(model, c);
    if (idle) add_friction_of(model, c, work);
    else {
        add_work_of(model, c, motion.at_start(), work);
        contacts.energy_taken[c] -= 0.5 * normal_work(model, c, motion.at_start()) +
                                    withheld_shear_work(model, c, 1 - contacts.withheld[c], motion.at_start());
    }
    const double of_scale = idle ? 0 : take_back_scale(model, c);

    Vec3& n = contacts.normal[c];
    const Vec3 turn = 0.5 * (motion.one.turn + motion.two.turn);
    Between between;
    if (contacts.depth[c] == 0) {
        n = (n + turn.cross(n)).normalized();
        between = nearest_corners(model, b1, b2, n);
        contacts.position[c] = between.place;
        const double force = idle ? 0 : normal_force_of(model, c),
                     stiffness = model.sub_contacts.normal_stiffness[contacts.sub_contacts[c].first];
        if (force > 0 && stiffness > 0) contacts.offset[c] = offset_for_force(model, c, force, stiffness, scratch);
        // If the force-free overlap has shrunk, keep the smaller one.
        if (const double before = contacts.offset[c]; before < 0 && contacts.offset_tilt[c].isZero(0)) {
            const Vec3 along = contacts.offset_normal[c];
            begin_without_force(model, c, scratch);
            if (contacts.offset[c] < before) {
                contacts.offset[c] = before;
                contacts.offset_normal[c] = along;
            }
        }
    }
    contacts.axis[c] += turn.cross(contacts.axis[c]);
    turn_offset(contacts, c, motion, model.blocks.centroid[b1]);
    // With the normal of the common volume each would depend on the other, and they might not converge.
    Vec3& along = contacts.offset_normal[c];
    const bool has_offset = contacts.offset[c] != 0 || !contacts.offset_tilt[c].isZero(0);
    along = has_offset ? (along + turn.cross(along)).normalized() : n;

    // The closest approach in two more steps like this one.
    const double closing = std::max(0.0, -2 * motion.at(contacts.position[c]).dot(n));
    OverlapPatch patch;
    patch.normal = n;
    ClosureOffset offset = offset_of(contacts, c);
    const auto comes_near = [&] {
        constexpr double no_motion = 1e-10; // of the margin: of adjacent blocks that only rounding moves
        const double margin = std::min(model.blocks.margin[b1], model.blocks.margin[b2]);
        const double gap =
            offset.closure == 0 && offset.tilt.isZero(0) ? between.gap : gap_along(model, b1, b2, n, offset);
        return gap < -rounding_of_gap(model, b1, b2) || gap < closing - no_motion * margin;
    };
    const bool near = contacts.depth[c] > 0 || comes_near();
    double area = 0;
    if (near) {
        patch = overlap_patch(model, pair_of(contacts, c), n, offset, scratch, slopes);
        area = patch.area;
        if (closing > 0.25 * patch.depth) {
            offset.closure += closing;
            area = std::max(area, overlap_area(model, pair_of(contacts, c), patch.normal, offset, scratch));
        }
    }
    CarrierRows rows{};
    if (patch.carried > 0) rows = slopes != nullptr ? press(model, c, patch, *slopes) : patch.rows(0);
    n = patch.normal;
    const double of_turn = idle ? 0 : turn_shear(model, c, n, motion);
    if (patch.lies) hold_by_grip(model, c, rows);
    const double in_springs = idle ? 0 : shear_energy(model, c);
    write_rows(model, c, patch, rows, motion);
    note_torn(model, c);
    contacts.energy_length[c] = patch.carried > 0 ? patch.energy / patch.carried : 0;
    const double stiff = std::max(area, contacts.area[c]);
    // It decreases only while the contact carries nothing, and only when all bodies are checked; otherwise a rattling contact would need a check
    // each time it closes.
    double& rung = contacts.stiffness_area[c];
    if (rung < stiff || (!(patch.carried > 0) && step_may_grow(model.clock) && rung > 1.18 * stiff))
        rung = rung_above(stiff, contacts.least_area[c]); // a rung is a factor of 1.189
    return {idle ? 0 : of_scale + of_turn + pay_for_area(model, c, in_springs), patch.lies};
}

OverlapEnd finish_overlap_contact(Model& model, Row c, const CarriedLoad& carried, const OverlapSlopes* slopes,
                                  JointWork& work) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    OverlapEnd end;
    const bool apart = contacts.depth[c] == 0;
    const bool had_force = !apart || !stays_without_force(model, c, carried);
    const SlippedCarriers slipped = apart ? SlippedCarriers{} : slipped_carriers(model, c, carried);
    const bool slips = std::ranges::find(slipped, true) != slipped.end();
    if (had_force) stiffen_shear(model, c, carried);
    if (slips) end.lost += release_places(model, c, slipped);
    if (apart) {
        if (had_force) end.lost += shear_energy(model, c);
        for (Row s = span.first; s < span.end(); s += eight) {
            const RowsOfEight group(span.end() - s);
            group.store(subs.normal_force.data() + s, Eight{});
            group.store(subs.shear_force, s, eights(Vec3(Vec3::Zero())));
        }
        // The blocks may meet again elsewhere: of a tilt, only its closure at the place of separation is kept.
        const Vec3 arm = contacts.position[c] - model.blocks.centroid[contacts.block1[c]];
        contacts.offset[c] += contacts.offset_tilt[c].dot(arm);
        contacts.offset_tilt[c].setZero();
        end.lost += contacts.energy_taken[c];
        contacts.energy_taken[c] = contacts.energy_length[c] = contacts.withheld[c] = 0;
        contacts.energy_deep[c] = contacts.energy_shallow[c] = contacts.shear_area[c] = 0;
    } else {
        if (slopes != nullptr) settle_curved(model, c, *slopes, carried, slips);
        else take_dilation(model, c, carried);
        end.lost += keep_passive(model, c, carried.lies, frictional_work(model, c) - carried.worn);
    }
    end.idle = is_idle(model, c);
    if (end.idle) add_friction_of(model, c, work);
    else add_work_of(model, c, RelativeMotion(model, c), work);
    for (Row s = span.first; s < span.end(); s += eight) {
        const RowsOfEight group(span.end() - s);
        add_increments(subs, s, group, group.load(subs.normal_displacement_increment.data() + s),
                       group.load(subs.shear_displacement_increment, s));
    }
    return end;
}

} // namespace kaya
