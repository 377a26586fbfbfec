// One cycle of the explicit scheme: the only place where the order of the phases stands.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/hooks.hpp"
#include "mechanics/phase_times.hpp"
#include "model/model.hpp"

#include <memory>
#include <string>
#include <vector>

namespace kaya {

enum class ContactChange;
struct StepSums;

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

    const std::vector<PhaseTime>& timing() const { return times_.all(); }

    /// While one stands, nobody reads or writes stresses of zones between cycles, and no hook or script does inside: cycles may keep
    /// them where they are quickest at hand. The zones have them again when the last one goes, or after bring_up_to_date().
    class Unwatched {
    public:
        explicit Unwatched(Cycle& cycle) : cycle_(cycle) { ++cycle_.unwatched_; }
        ~Unwatched() {
            --cycle_.unwatched_;
            cycle_.bring_up_to_date();
        }
        Unwatched(const Unwatched&) = delete;
        Unwatched& operator=(const Unwatched&) = delete;

    private:
        Cycle& cycle_;
    };
    void bring_up_to_date() const;

    /// Elastic energy of all zones by their stress, as of the last prepare().
    double energy_in_zones() const;

    Hooks hooks;

private:
    struct Lists;

    void make_lists();
    void take_zone_laws();

    void begin();
    void move(StepSums& sums);
    void strain(StepSums& sums);
    double run_structures(double step);
    ContactChange refresh_contacts();
    void gather(StepSums& sums);
    void close_account(const StepSums& sums);
    void limit_step(const StepSums& sums, ContactChange change, bool may_grow);
    void record();
    void run_hooks(const std::vector<std::function<void()>>& list);

    Model& model_;
    JointRegistry& joints_;
    std::unique_ptr<Lists> lists_;
    int unwatched_ = 0;
    PhaseTimes times_;
};

} // namespace kaya
