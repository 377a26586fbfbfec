// The phases of a cycle. Each is a free function in a file of its own name and says what it reads and
// writes; cycle.cpp puts them in order.
#pragma once

#include "mechanics/adjacency.hpp"
#include "mechanics/batches.hpp"
#include "mechanics/quiet_boundary.hpp"
#include "mechanics/zone_tiles.hpp"
#include "model/lanes.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Cycles between two looks at whether the time step may grow again; a step that must shrink does at once.
constexpr std::int64_t growth_interval = 100;

/// Whether the time step may grow when this cycle ends.
inline bool step_may_grow(const Clock& clock) { return (clock.cycle + 1) % growth_interval == 0; }

/// Sums over moving bodies that stopping and damping need.
struct MotionSums {
    double kinetic_before = 0, kinetic = 0; ///< energy before and after the step
    double gravity = 0, boundary = 0;       ///< work on the bodies
    double damped = 0;                      ///< energy taken out by damping
    double inner_power = 0;      ///< of the forces of joints and zones at the velocities before the step
    double inner_power_size = 0; ///< the same with the sizes of its terms, to tell it from rounding
    double inner_power_gain = 0; ///< by how much it is greater at the velocities after the step

    void add(const MotionSums& part);
};

inline void MotionSums::add(const MotionSums& part) {
    kinetic_before += part.kinetic_before;
    kinetic += part.kinetic;
    gravity += part.gravity;
    boundary += part.boundary;
    damped += part.damped;
    inner_power += part.inner_power;
    inner_power_size += part.inner_power_size;
    inner_power_gain += part.inner_power_gain;
}

struct Hooks;
struct BodyStiffness;
class TieLists;
class ZoneLaws;

/// The drives by what they do, and room for the values of their functions; derived.
struct HistoryLists {
    std::vector<Row> velocities, loads; ///< rows of Model::drives
    std::vector<std::int32_t> velocity_functions, load_functions;
    std::vector<double> factors; ///< of each time function
};

HistoryLists list_boundary_histories(const Model& model);

/// What driven velocities do to the account of energy before the step.
struct HistorySums {
    double kinetic = 0;           ///< change of kinetic energy
    double gravity = 0, boundary = 0;
    double inner_power = 0;       ///< change of the power of the forces of joints and zones

    void add(const HistorySums& part) {
        kinetic += part.kinetic;
        gravity += part.gravity;
        boundary += part.boundary;
        inner_power += part.inner_power;
    }
};

/// Sets the prescribed velocities that change with time to those of the middle of the step. Throws Diagnostic
/// (Fault::run) when a function gives no number.
HistorySums apply_velocity_histories(Model& model, HistoryLists& lists, const Hooks& hooks);

/// Brings the loads that change with time to the time of the clock. Throws as apply_velocity_histories does.
void apply_load_histories(Model& model, HistoryLists& lists, const Hooks& hooks);

/// Reads forces, loads, masses; writes velocities, positions, displacements, orientations of rigid blocks
/// and the positions of their vertices. Joined blocks move as one.
MotionSums move_blocks(Model& model, const JoinedBodies& bodies);

/// The same for gridpoints of deformable blocks; viscous boundaries damp, rollers constrain their gridpoints, and
/// those that are tied to each other move as one.
MotionSums move_gridpoints(Model& model, const QuietPoints& quiet, const TieLists& ties);

/// What contacts pass on in a cycle; derived, so that it is not part of the model.
struct JointForces {
    std::vector<Vec3> of_sub_contact; ///< on the second side, of contacts with a deformable block
    std::vector<Vec3> of_contact;     ///< sum on the second block
    std::vector<Vec3> moment;         ///< of that sum about Contacts::position
    std::vector<double> stiffness;    ///< of each contact, to be compared with that of the last step only: its sub-contacts'
                                      ///< larger tangent stiffnesses, of overlaps over the masses as they feel it
    std::vector<ContactKind> kind;    ///< as it was when the stiffness was taken
    std::vector<char> stiffness_changed; ///< of contacts that are much stiffer or have other geometry, until someone clears it
};

/// What a step has done to the joints.
struct JointSums {
    double work = 0;     ///< put into them
    double friction = 0; ///< of it, lost
    double returned = 0; ///< of what changes of touches had taken from the contacts
    double lost = 0;     ///< of what springs held, where contacts changed their area or parted
    double fluid = 0;    ///< done on the blocks by pore pressure
    double damped = 0;   ///< taken up by dashpots
    bool stiffness_changed = false;
};

/// Reads positions and velocities of blocks and gridpoints; turns the planes, computes displacement
/// increments, calls the joint models, and writes contact forces, displacements, history, state and
/// stiffnesses. One batch after another goes through all of it.
JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces);

/// Forces of the contacts as they are, without a step. Contacts with geometry made anew are marked as changed.
void joint_forces(const Model& model, JointForces& forces);

/// The same for those contacts only; the others have kept their rows and forces.
void joint_forces_of_new(const Model& model, JointForces& forces);

/// Rates of work on the blocks times the step, in lanes of sub-contacts.
struct JointWork {
    Lanes joint = Lanes::Zero(), friction = Lanes::Zero();
    Lanes fluid = Lanes::Zero(); ///< of the pore pressure; a joint model does not change it
    double dashpots = 0;         ///< of the viscous forces of overlaps

    void add(const JointWork& other) {
        joint += other.joint;
        friction += other.friction;
        fluid += other.fluid;
        dashpots += other.dashpots;
    }
};

/// Turns the plane of a contact with its blocks and writes the displacement increments of its
/// sub-contacts; turns their shear forces with the plane. Adds the work of the forces as they then are to `work`.
void move_contact(Model& model, Row contact, JointWork& work);

/// Turns the vectors that a joint model keeps of each sub-contact as its shear force was turned: `vectors` has the first
/// of the three history variables of each. Only where strain is large; call it after move_contact.
void turn_kept_vectors(Model& model, Row contact, const std::vector<std::size_t>& vectors);

/// Writes SubContacts::pore_pressure where water acts, at the places where the sub-contacts are now.
void put_water(Model& model);

/// Lame's constants of a block: stress = lambda trace(strain) + two_shear strain.
struct ElasticConstants {
    double lambda = 0, two_shear = 0;
};

/// What a step has done to the zones.
struct ZoneSums {
    double work = 0;   ///< put into them
    double damped = 0; ///< taken up by viscous stress

    void add(const ZoneSums& part) {
        work += part.work;
        damped += part.damped;
    }
};

/// Room for what zones that average have to keep within a step; its memory stays.
struct ZoneScratch {
    struct Mean {
        double sum = 0, volume = 0; ///< of a quantity times volume
    };
    std::vector<double> volume, strain, mean_strain, flow; ///< by zone: volume strain, its mean, plastic change of the mean stress
    std::vector<Mean> at_point;                            ///< by point of the tiles
};

/// Reads gridpoint motion; writes zone stresses, states and histories, and `forces`: by point of the tiles, with the sum of the
/// sizes of the forces of single zones. Throws Diagnostic when a zone model fails.
ZoneSums run_zone_models(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces);

/// Forces of the stresses that are there, without a step.
void zone_forces(const Model& model, const ZoneLaws& laws, std::vector<PointRow>& forces);

/// Reads contact forces, forces of zones, loads; writes forces and moments in row order, and the unbalanced
/// force and its ratios in the clock. Returns the power of the forces of joints and zones on the bodies.
double gather_forces(Model& model, const Adjacency& adjacency, const TieLists& ties, const JointForces& joints,
                     const ZoneTiles& tiles, const std::vector<PointRow>& zone_forces);

/// Masses of blocks and gridpoints from the densities. Throws Diagnostic when one is missing.
void compute_masses(Model& model);

/// Writes Gridpoints::zone_frequency.
void zone_frequencies(Model& model, const std::vector<ElasticConstants>& elastic);

/// What density scaling has done: docs/theory/time-step.md.
struct ScaledMasses {
    std::size_t bodies = 0; ///< rigid blocks and gridpoints that have mass and may move
    std::size_t scaled = 0; ///< of them with another inertial mass than their own
    double real = 0, inertial = 0; ///< sums over those bodies
};

ScaledMasses scaled_masses(const Model& model);

/// Gives inertial masses so that `stable_step` is the largest that is stable for every body, none below `least` times its
/// mass. Velocities stay. Masses that are enough and not much too large stay as well.
void scale_masses(Model& model, const BodyStiffness& stiffness, double stable_step, double least);

/// The same, only upwards from what the masses are: for stiffnesses that grow between two scalings.
void raise_masses(Model& model, const BodyStiffness& stiffness, double stable_step);

/// All inertial masses are the true ones again.
void restore_masses(Model& model);

/// The step at which full density scaling leaves the sum of all masses as it is; 0 when nothing resists.
double mean_stable_step(const Model& model, const BodyStiffness& stiffness);

} // namespace kaya
