// One cycle of the explicit scheme; the order of the phases is defined here only.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/common/hooks.hpp"
#include "mechanics/common/phase_times.hpp"
#include "model/tables/model.hpp"

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

    /// Finds contacts, gives joint models to contacts without one, computes masses and the time step. advance() calls it when something
    /// changed; it is safe to call at any time. Throws Diagnostic (missing density, zero stiffness, a missing joint property, ...) and
    /// leaves the model unchanged.
    void prepare();

    /// Runs one cycle. Throws Diagnostic with Fault::run when a joint model fails or a value is not finite.
    void advance();

    /// Describes the body that limits the time step and the reason.
    std::string time_step_report();

    const std::vector<PhaseTime>& timing() const { return times_.all(); }

    /// While an Unwatched exists, zone stresses are not read or written between cycles, nor by hooks and scripts inside them, and may be
    /// cached; they are written back when the last one is destroyed or by bring_up_to_date().
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

    /// Elastic energy of all zones from their stress, as of the last prepare().
    double energy_in_zones() const;

    Hooks hooks;

private:
    struct Lists;

    /// Why lists are made again. After a restore the columns of contacts keep their values.
    enum class Since { restored, changed };
    void make_lists(Since since);
    void use_large_pages();
    void take_zone_laws();

    void begin();
    void move(StepSums& sums);
    bool counts_water() const;
    void strain(StepSums& sums);
    double run_structures(double step);
    ContactChange refresh_contacts();
    void gather(StepSums& sums);
    void close_account(const StepSums& sums);
    void limit_step(const StepSums& sums, ContactChange change, bool may_grow);
    void record(double kick);
    void run_hooks(const std::vector<std::function<void()>>& list);

    Model& model_;
    JointRegistry& joints_;
    std::unique_ptr<Lists> lists_;
    int unwatched_ = 0;
    PhaseTimes times_;
};

} // namespace kaya
