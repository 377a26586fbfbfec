// Sources and sinks of energy since the last `reset energy`.
#pragma once

namespace kaya {

/// Works are sums over steps of force times the mean of the velocities before and after it, which is
/// exactly what changes kinetic energy in the leap-frog scheme; those of joints and zones take the mean
/// of the old and the new force. All in force times length. docs/theory/energy.md
struct Energy {
    double kinetic = 0;        ///< now, half a step back
    double start = 0;          ///< kinetic energy when the account was opened
    double gravity = 0;        ///< work of gravity on the blocks
    double boundary = 0;       ///< work of loads, prescribed velocities and pore pressure on the blocks
    double damped = 0;         ///< taken out by damping
    double joint_work = 0;     ///< put into joints: stored in them or lost
    double joint_friction = 0; ///< of it, lost in slip and failure
    double joint_lost = 0;     ///< of it, lost where contacts separated or got new geometry
    double zone_work = 0;      ///< work on zones
    double structure_work = 0; ///< work on cables, beams and liners: stored in them or lost
    double step_made = 0;      ///< time-step changes, docs/theory/energy.md (9)
    double inner_power = 0;    ///< of the forces of joints and zones on the bodies at the end of the last step
    double lag = 0;            ///< time from the velocities to the end of the last step: half of it

    double joint_stored() const { return joint_work - joint_friction - joint_lost; }
    double supplied() const { return start + gravity + boundary + step_made; }
    double accounted() const { return kinetic + joint_work + zone_work + structure_work + damped; }
    /// The length of the step before, whose second half is not in the account yet; `otherwise` if the account starts.
    double step_before(double otherwise) const { return lag > 0 ? 2 * lag : otherwise; }
    /// Residual of the account. Joints and zones have completed the last step, bodies are at its middle.
    double error() const { return supplied() - accounted() - inner_power * lag; }
};

} // namespace kaya
