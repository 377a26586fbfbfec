// One cycle of the explicit scheme: the only place where the order of the phases stands.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace kaya {

struct MotionSums;
struct JointSums;
struct HistorySums;
struct ZoneSums;

/// Where scripts and programs are called inside a cycle. They may read all and write fields; a change
/// of structure from inside waits for the end of the cycle.
struct Hooks {
    std::vector<std::function<void()>> before_cycle, after_forces, after_cycle;
    /// Value of a deck's function or variable, for histories of it and for what it histories.
    std::function<double(const std::string&)> script_value;
    /// Value of a numbered table at x, for what it histories.
    std::function<double(std::int64_t, double)> table_value;
};

/// Seconds spent in each phase since the program started, for `list timing`.
struct PhaseTime {
    const char* phase;
    double seconds = 0;
    std::int64_t calls = 0;
};

class Cycle {
public:
    Cycle(Model& model, JointRegistry& joints);
    ~Cycle();

    /// Contacts found, joint models given to contacts that have none, masses and time step computed.
    /// Called by advance() when something changed; safe to call at any time. Throws Diagnostic
    /// (density not given, zero stiffness, a required joint property missing, ...), model unchanged.
    void prepare();

    /// One cycle. Throws Diagnostic with Fault::run when a joint model fails or a number is not finite.
    void advance();

    /// The body that limits the time step and why, in words.
    std::string time_step_report();

    const std::vector<PhaseTime>& timing() const;

    /// Elastic energy of all zones by their stress, as of the last prepare(): p^2/(2 K) + s:s/(4 G) per volume.
    double energy_in_zones() const;

    Hooks hooks;

private:
    struct Scratch;

    void make_lists();
    void take_zone_laws();
    void adapt_viscosity(const MotionSums& motion);
    void keep_account(const HistorySums& prescribed, const MotionSums& motion, const JointSums& joint_sums,
                      const ZoneSums& zone_sums, double cable_work, double inner_power);
    void run_hooks(const std::vector<std::function<void()>>& list);

    Model& model_;
    JointRegistry& joints_;
    std::unique_ptr<Scratch> scratch_;
};

} // namespace kaya
