#include "mechanics/contact/move_contact.hpp"
#include "mechanics/contact/contact_plane.hpp"
#include "mechanics/lanes/turn.hpp"
#include "mechanics/shape/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Cycles between two updates of the faces of deformable blocks, which turn slowly.
constexpr std::int64_t face_interval = 10;

/// The normal of a contact on a face with zones: of two such faces that of both, as when the contact was found.
Vec3 normal_on_zones(const Model& model, Row c) {
    const auto& contacts = model.contacts;
    const Row one = contacts.face1[c], two = contacts.face2[c], b1 = contacts.block1[c], b2 = contacts.block2[c];
    const bool both = one != no_row && two != no_row && model.blocks.deformable[b1] && model.blocks.deformable[b2];
    if (!both) return contacts.reference[c] == 1 ? current_normal(model, one) : Vec3(-current_normal(model, two));
    return normal_of_faces(model, b1, b2, current_normal(model, one), current_normal(model, two));
}

/// The plane turns with the block whose face it is, or both; between rigid blocks see PairMotions.
void turn_plane(Model& model, Row c) {
    auto& contacts = model.contacts;
    const auto& blocks = model.blocks;
    const std::int32_t reference = contacts.reference[c];
    if (reference == 0) return;
    const Row owner = reference == 1 ? contacts.block1[c] : contacts.block2[c];
    Vec3& n = contacts.normal[c];
    if (!blocks.deformable[owner]) {
        const Triple spin(blocks.rotational_velocity[owner]);
        n = turned_a_little(Triple(n), model.clock.time_step * spin).vector();
    } else if (model.clock.cycle % face_interval == 0) {
        const Vec3 now = normal_on_zones(model, c);
        if (!now.isZero()) n = now;
    }
}

/// Vectors in the plane of a contact stay in it and turn with the mean rotation of the blocks.
inline Eight3 turned_in_plane(const Eight3& vector, const Eight3& n, const Eight& twist) {
    const Eight3 flat = in_plane(vector, n);
    return flat + n.cross(flat) * twist;
}

/// Most joints have never dilated, and have nothing to turn.
inline void turn_kept(SubContacts& subs, const std::vector<std::size_t>& kept, Row row, const RowsOfEight& group,
                      const Eight3& n, const Eight& twist) {
    for (const std::size_t k : kept) {
        auto* const column = &subs.history[k];
        const Eight3 vector{group.load(column[0].data() + row), group.load(column[1].data() + row),
                            group.load(column[2].data() + row)};
        if (all_zero(vector)) continue;
        const Eight3 turned = turned_in_plane(vector, n, twist);
        group.store(column[0].data() + row, turned.x);
        group.store(column[1].data() + row, turned.y);
        group.store(column[2].data() + row, turned.z);
    }
}

/// One vector of eight, in all lanes.
inline Eight3 lane(const Eight3& v, std::size_t l) {
    const auto of = [l](const Eight& e) { return eights(reinterpret_cast<const double*>(&e)[l]); };
    return {of(v.x), of(v.y), of(v.z)};
}

/// Rotation in a step of vectors in a plane about its normal: with the mean motion of points in it.
class PlaneTwist {
public:
    PlaneTwist(const Vec3& normal, const Vec3& origin) : normal_(normal), origin_(origin) {}

    void add(const Vec3& place, const Vec3& velocity) {
        const Vec3 arm = place - origin_;
        ++count_;
        arms_ += arm;
        velocities_ += velocity;
        moment_ += normal_.dot(arm.cross(velocity));
        square_ += square(arm);
    }
    double angle(double step) const {
        const double own = square_ - square(arms_) / count_;
        if (!(own > 1e-12 * square_)) return 0; // one place
        return step * (moment_ - normal_.dot(arms_.cross(velocities_)) / count_) / own;
    }

private:
    double square(const Vec3& arm) const { return arm.squaredNorm() - arm.dot(normal_) * arm.dot(normal_); }

    Vec3 normal_, origin_, arms_ = Vec3::Zero(), velocities_ = Vec3::Zero();
    double count_ = 0, moment_ = 0, square_ = 0;
};

/// The rotation for a contact with zones, after its sub-contacts have moved: the displacement itself does not change it.
double twist_with_zones(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const SideMotion side1(model, model.contacts.block1[c]), side2(model, model.contacts.block2[c]);
    const Span span = model.contacts.sub_contacts[c];
    if (span.count == 0) return 0;
    PlaneTwist twist(model.contacts.normal[c], subs.position[span.first]);
    for (Row s = span.first; s < span.end(); ++s) {
        const Vec3 place = subs.position[s];
        twist.add(place, 0.5 * (side1.at(subs.side1[s], place) + side2.at(subs.side2[s], place)));
    }
    return twist.angle(model.clock.time_step);
}

/// `acted`: the normal along which the forces at the start of the step have acted.
void move_between(Model& model, Row c, const Vec3& acted, const std::vector<std::size_t>& kept, JointWork& work) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const SideMotion side1(model, contacts.block1[c]), side2(model, contacts.block2[c]);
    const Vec3 n = contacts.normal[c];
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    double farthest = 0;
    const Span span = contacts.sub_contacts[c];
    if (span.count == 0) return;
    PlaneTwist twist(n, subs.position[span.first]);
    for (Row s = span.first; s < span.end(); ++s) {
        const Vec3 place = subs.position[s];
        const Vec3 v1 = side1.at(subs.side1[s], place), v2 = side2.at(subs.side2[s], place);
        const Vec3 increment = (v2 - v1) * step;
        work.joint[0] += (subs.normal_force[s] * acted + Vec3(subs.shear_force[s])).dot(increment);
        work.friction[0] += subs.frictional_work[s];
        const double opening = increment.dot(n);
        const Vec3 shear = increment - opening * n;
        subs.normal_displacement_increment[s] = opening;
        subs.shear_displacement_increment.set(s, shear);
        farthest = std::max(farthest, shear.squaredNorm());
        if (!large) continue;
        const Vec3 mean = 0.5 * (v1 + v2);
        twist.add(place, mean);
        subs.position.set(s, place + step * mean);
    }
    if (!large) return;
    contacts.slip_since_update[c] += std::sqrt(farthest);
    const Eight3 normal = eights(n);
    const Eight angle = eights(twist.angle(step));
    for (Row row = span.first; row < span.end(); row += eight) {
        const RowsOfEight group(span.end() - row);
        group.store(subs.shear_force, row, turned_in_plane(group.load(subs.shear_force, row), normal, angle));
        turn_kept(subs, kept, row, group, normal, angle);
    }
}

/// Whether a sub-contact of a contact has a vector to turn.
bool keeps_any(const Model& model, Row c, const std::vector<std::size_t>& kept) {
    const Span span = model.contacts.sub_contacts[c];
    for (const std::size_t k : kept)
        for (Row i = span.first; i < span.end(); i += eight)
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (!all_zero(RowsOfEight(span.end() - i).load(model.sub_contacts.history[k + axis].data() + i)))
                    return true;
    return false;
}

/// Work and slips of a step, of some rows of a joint between rigid blocks.
struct RowsMotion {
    JointWork work;
    Eight slip2{}; ///< squares of the slips, the greatest of each lane
};

/// Moves up to eight rows with pair number `l`.
inline void move_rows(Model& model, Row i, const RowsOfEight& group, const PairMotions& pairs, std::size_t l,
                      const std::vector<std::size_t>& kept, RowsMotion& moved) {
    auto& subs = model.sub_contacts;
    const bool large = model.settings.large_strain;
    const Eight3 n = lane(pairs.normal, l), origin = lane(pairs.origin, l), mean_turn = lane(pairs.mean_turn, l);
    const Eight half = eights(large ? 0.5 : 0);
    // Missing rows move as the origin does; otherwise they would seem to slip far.
    const Eight3 x = group.load(subs.position, i, origin), arm = x - origin;
    const Eight3 turned = mean_turn.cross(arm);
    const Eight3 u = lane(pairs.apart, l) + lane(pairs.apart_turn, l).cross(arm + turned * half);
    const Eight opening = u.dot(lane(pairs.normal_middle, l));
    const Eight3 shear = in_plane(u, n);
    group.store(subs.normal_displacement_increment.data() + i, opening);
    group.store(subs.shear_displacement_increment, i, shear);
    Eight3 force = group.load(subs.shear_force, i);
    if (large) {
        const Eight twist = eights(reinterpret_cast<const double*>(&pairs.twist)[l]);
        moved.slip2 = larger_of(moved.slip2, shear.dot(shear));
        group.store(subs.position, i, x + (lane(pairs.mean, l) + turned));
        force = turned_in_plane(force, n, twist);
        group.store(subs.shear_force, i, force);
        turn_kept(subs, kept, i, group, n, twist);
    }
    moved.work.joint += group.load(subs.normal_force.data() + i) * opening + force.dot(shear);
    moved.work.friction += group.load(subs.frictional_work.data() + i);
}

} // namespace

void move_contact(Model& model, Row c, const std::vector<std::size_t>& kept, JointWork& work) {
    const Vec3 acted = model.contacts.normal[c];
    if (model.settings.large_strain) turn_plane(model, c);
    move_between(model, c, acted, kept, work);
}

void move_rigid_contact(Model& model, Row c, const PairMotions& pairs, std::size_t l,
                        const std::vector<std::size_t>& kept, JointWork& work) {
    const Span span = model.contacts.sub_contacts[c];
    RowsMotion moved;
    // Most joints have no more than eight places: in a loop, all numbers of the pair would wait in registers.
    move_rows(model, span.first, RowsOfEight(span.count), pairs, l, kept, moved);
    for (Row i = eight; i < span.count; i += eight)
        move_rows(model, span.first + i, RowsOfEight(span.count - i), pairs, l, kept, moved);
    work.add(moved.work);
    if (model.settings.large_strain) model.contacts.slip_since_update[c] += std::sqrt(largest(moved.slip2));
}

void turn_kept_vectors(Model& model, Row c, const std::vector<std::size_t>& kept) {
    if (kept.empty() || !model.settings.large_strain || !keeps_any(model, c, kept)) return;
    const auto& contacts = model.contacts;
    const auto& blocks = model.blocks;
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const Eight3 n = eights(contacts.normal[c]);
    const bool rigid = !blocks.deformable[b1] && !blocks.deformable[b2];
    const Vec3 turn = 0.5 * model.clock.time_step * (blocks.rotational_velocity[b1] + blocks.rotational_velocity[b2]);
    const Eight twist = eights(rigid ? turn.dot(contacts.normal[c]) : twist_with_zones(model, c));
    const Span span = contacts.sub_contacts[c];
    for (Row i = span.first; i < span.end(); i += eight)
        turn_kept(model.sub_contacts, kept, i, RowsOfEight(span.end() - i), n, twist);
}

} // namespace kaya
