// Motion of contacts in a step, and the work of their forces on it.
#pragma once

#include "mechanics/lanes/eight.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// The part of vectors in a plane with a unit normal.
inline Eight3 in_plane(const Eight3& v, const Eight3& normal) { return v - normal * v.dot(normal); }

/// Rates of work on the blocks times the step, in eights of sub-contacts.
struct JointWork {
    Eight joint{}, friction{};
    double dashpots = 0; ///< of the viscous forces of overlaps

    void add(const JointWork& other) {
        joint += other.joint;
        friction += other.friction;
        dashpots += other.dashpots;
    }
};

/// Motion of a rigid block in a step.
struct StepMotion {
    Vec3 shift, turn, centre;

    StepMotion(const Model& model, Row b)
        : shift(model.blocks.velocity[b] * model.clock.time_step),
          turn(model.blocks.rotational_velocity[b] * model.clock.time_step), centre(model.blocks.centroid[b]) {}
    Vec3 at(const Vec3& place) const { return shift + turn.cross(place - centre); }
    Eight3 at(const Eight3& places) const { return eights(shift) + eights(turn).cross(places - eights(centre)); }
};

/// Relative motion of block 2 in a step.
struct RelativeMotion {
    StepMotion one, two;

    RelativeMotion(const Model& model, Row c)
        : one(model, model.contacts.block1[c]), two(model, model.contacts.block2[c]) {}
    /// With the arms at the start of the step, for forces of that time: they changed the kinetic energy with these arms.
    RelativeMotion at_start() const {
        RelativeMotion start = *this;
        start.one.centre -= one.shift;
        start.two.centre -= two.shift;
        return start;
    }
    Vec3 at(const Vec3& place) const { return two.at(place) - one.at(place); }
    Eight3 at(const Eight3& places) const { return two.at(places) - one.at(places); }
};

/// Velocity of the material point of one side.
struct SideMotion {
    const Model& model;
    bool deformable;
    Vec3 velocity, spin, centre; ///< of a rigid block

    SideMotion(const Model& m, Row block) : model(m), deformable(m.blocks.deformable[block] != 0) {
        velocity = m.blocks.velocity[block];
        spin = m.blocks.rotational_velocity[block];
        centre = m.blocks.centroid[block];
    }
    Vec3 at(const Attachment& side, const Vec3& place) const {
        if (!deformable) return velocity + spin.cross(place - centre);
        const auto& v = model.gridpoints.velocity;
        if (side.weights[0] == 1) return v[side.gridpoints[0]];
        return side.weights[0] * v[side.gridpoints[0]] + side.weights[1] * v[side.gridpoints[1]] +
               side.weights[2] * v[side.gridpoints[2]];
    }
};

/// Joint models see the displacements at the start of the step; this adds the increments of the step.
inline void add_increments(SubContacts& subs, Row row, const RowsOfEight& group, const Eight& opening,
                           const Eight3& slip) {
    double* const opened = subs.normal_displacement.data() + row;
    group.store(opened, group.load(opened) + opening);
    group.store(subs.shear_displacement, row, group.load(subs.shear_displacement, row) + slip);
}

/// Work of the present forces of a contact between rigid blocks on the motion of the step.
void add_work_of(const Model& model, Row contact, const RelativeMotion& motion, JointWork& work);

/// Work of the present forces of any contact on the motion of the step.
double work_of_step(const Model& model, Row contact);

/// Work of the pore pressure in all contacts, as they are, on the motion of the step, after the bodies have moved: while sub-contacts have the
/// places of its start, or those of its end.
enum class StepPlaces { start, end };
double fluid_work(const Model& model, StepPlaces places);

/// Accumulated frictional work of a contact according to its joint model.
double frictional_work(const Model& model, Row contact);

} // namespace kaya
