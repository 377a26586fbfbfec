// Sums of the phases of a step for the energy account, damping and equilibrium tests.
#pragma once

namespace kaya {

/// Sums over moving bodies that stopping and damping need.
struct MotionSums {
    double kinetic_before = 0, kinetic = 0; ///< energy before and after the step
    double gravity = 0, boundary = 0;       ///< work on the bodies
    double damped = 0;                      ///< energy taken out by damping
    double inner_power = 0;                 ///< of the forces of joints and zones at the velocities before the step
    double inner_power_size = 0;            ///< the same with absolute values, to tell it from rounding
    double inner_power_gain =
        0; ///< by how much it is greater at the velocities after the step, with that of loads that turn with a block

    void add(const MotionSums& part) {
        kinetic_before += part.kinetic_before;
        kinetic += part.kinetic;
        gravity += part.gravity;
        boundary += part.boundary;
        damped += part.damped;
        inner_power += part.inner_power;
        inner_power_size += part.inner_power_size;
        inner_power_gain += part.inner_power_gain;
    }
};

/// Effect of changing prescribed velocities on the energy account before the step.
struct HistorySums {
    double kinetic = 0; ///< change of kinetic energy
    double gravity = 0, boundary = 0;
    double inner_power = 0; ///< change of the power of the forces of joints and zones

    void add(const HistorySums& part) {
        kinetic += part.kinetic;
        gravity += part.gravity;
        boundary += part.boundary;
        inner_power += part.inner_power;
    }
};

/// Effect of a step on the joints.
struct JointSums {
    double work = 0;     ///< put into them
    double friction = 0; ///< of it, lost
    double returned = 0; ///< by contact updates from what they had taken
    double lost = 0;     ///< from springs where contacts changed their area or separated
    double damped = 0;   ///< taken up by dashpots
    bool stiffness_changed = false;
};

/// Effect of a step on the zones.
struct ZoneSums {
    double work = 0;     ///< put into them
    double damped = 0;   ///< taken up by viscous stress
    bool flowed = false; ///< a zone whose flow is averaged over its neighbours

    void add(const ZoneSums& part) {
        work += part.work;
        damped += part.damped;
        flowed = flowed || part.flowed;
    }
};

/// All of one step.
struct StepSums {
    HistorySums prescribed;
    MotionSums motion;
    JointSums joints;
    ZoneSums zones;
    double fluid = 0;          ///< work of the pore pressure in joints on the blocks
    double structure_work = 0; ///< work on cables, beams and liners
    double inner_power = 0;    ///< of the forces of joints and zones after the step
};

} // namespace kaya
