#include "commands/stability/load_control.hpp"

#include "commands/monitors/free_fall.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/stability/load_curve.hpp"
#include "commands/stability/other_motion.hpp"
#include "commands/stability/push_of.hpp"
#include "model/kinds/nearest.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace kaya {

namespace {

/// The displacement that the user looks at, where it is not that of the loads.
class Follower {
public:
    Follower(const Model& model, const lang::SolveControl& command) : model_(model) {
        if (!command.point) return;
        along_ = command.along->normalized();
        const Row row = nearest_row(model, ObjectKind::gridpoint, *command.point), block = model.gridpoints.block[row];
        block_ = model.blocks.id[block];
        vertex_ = row - model.blocks.gridpoints[block].first;
        start_ = now();
    }
    bool follows() const { return vertex_ != no_row; }
    bool is_gone() const { return follows() && model_.blocks.ids.row(block_) == no_row; }
    double displacement() const { return now() - start_; }

private:
    double now() const {
        const Row first = model_.blocks.gridpoints[model_.blocks.ids.row(block_)].first;
        return along_.dot(model_.gridpoints.displacement[first + vertex_]);
    }

    const Model& model_;
    BlockId block_;
    Row vertex_ = no_row; ///< of the block
    Vec3 along_ = Vec3::Zero();
    double start_ = 0;
};

class LoadControl {
public:
    LoadControl(Session& session, const lang::SolveControl& command)
        : session_(session), model_(session.engine.model), command_(command), push_(push_of(session, command)),
          follower_(model_, command), damped_at_start_(model_.energy.damped), row_(begun()), part_(row_) {
        paced_damped_ = damped_at_start_;
        model_.clock.peak_load = model_.clock.peak_displacement = 0;
        if (push_->is_boundary()) push_->advance(0, wanted()); // a boundary moves from the first cycle
    }

    /// After a cycle: sets the next load. Returns the reason to stop, if there is one.
    std::string advanced() {
        if (push_->is_outdated()) push_->renew();
        const double velocity = push_->velocity(), load = push_->load(), moved = velocity * model_.clock.time_step;
        travelled_ += moved;
        work_ += load * push_->force() * moved;
        if (follower_.is_gone()) return "the loss of the block whose point is followed";
        for (Span* span : {&row_, &part_}) {
            span->load_sum += load;
            span->displacement_sum += counted();
            ++span->cycles;
        }
        std::string why;
        if (++cycles_ % command_.every == 0) why = add_row();
        else if (part_.cycles == part_cycles() && command_.every - row_.cycles >= part_cycles()) end_part();
        pace();
        if (why.empty()) push_->advance(velocity, wanted());
        return why;
    }

    void tell(const std::string& why) const {
        auto& output = session_.program.output;
        output.conclude("solve control: stopped by " + why);
        if (curve_.empty()) return;
        const CurveRow &peak = curve_.peak(), &last = curve_.back();
        output.conclude(fmt::format("  peak load {} at displacement {}; at the end {} at {}", number_text(peak.load),
                                    number_text(peak.displacement), number_text(last.load),
                                    number_text(last.displacement)));
        constexpr double much = 0.05;
        if (const double step = curve_.doubt_of_peak(); step > LoadCurve::much_doubt)
            session_.warn(Diagnostic(fmt::format("the peak lies between rows, and may be {:.0f} % higher", 100 * step),
                                     "the load rises that fast up to it: go slower, or take `every` below 10")
                              .at(command_.place));
        if (curve_.swings_at_peak(LoadCurve::much_doubt) > 1)
            session_.warn(
                Diagnostic(
                    "the load falls and rises again by more than 1 % several times near its peak",
                    "if that is vibration, the peak is too high by as much: add `damp contact 0.1`, or go slower")
                    .at(command_.place));
        if (const double share = damped_share(); share > much)
            session_.warn(
                Diagnostic(
                    fmt::format("damping has taken {:.0f} % of the work of the load", 100 * share),
                    "the model does not get that work, and the load is the less exact: go slower, and use `damp local`")
                    .at(command_.place));
    }

    /// Writes the curve, as far as it is known. A boundary stops.
    void end() {
        push_->end();
        store();
        const bool turns = push_->turns() && !follower_.follows();
        curve_.draw(session_, command_, turns ? "rotation [radians]" : "displacement [length]", push_->load_name());
    }

private:
    void store() const { curve_.store(session_, command_); }

    /// What damping takes of the load's work shows how far the model is from rest: it decides how fast the run goes, up to the given speed. The
    /// speed changes evenly: its jumps would be impacts.
    void pace() {
        constexpr std::int64_t span = 500; // cycles, in which the speed doubles or halves
        if (cycles_ % span == 0) {
            const double share = (model_.energy.damped - paced_damped_) / std::abs(work_ - paced_work_);
            paced_work_ = work_, paced_damped_ = model_.energy.damped;
            constexpr double calm = 0.25; // of the share that is allowed
            change_ = share > command_.damped ? -1 : share < calm * command_.damped ? 1 : 0;
        }
        pace_ = std::clamp(pace_ * std::exp2(change_ / static_cast<double>(span)), slowest, 1.0);
    }
    /// Kinetic energy, without that of velocities set from outside.
    double motion() const { return model_.energy.kinetic - model_.energy.start; }
    double wanted() const { return command_.speed * speed_ratio_ * pace_; }
    double counted() const { return follower_.follows() ? follower_.displacement() : travelled_; }

    /// Cycles of a row, or of a part of it, and what the model had when they began.
    struct Span {
        double travelled, damped, motion;
        double load_sum = 0, displacement_sum = 0;
        std::int64_t cycles = 0;
    };
    Span begun() const { return {travelled_, model_.energy.damped, motion()}; }

    /// Of a part of a row: half of the cycles that the control of the load takes (equation (2)), so that its mean is steady.
    std::int64_t part_cycles() const {
        constexpr std::int64_t shortest = 10, most_parts = 100;
        return std::max(shortest, (command_.every + most_parts - 1) / most_parts);
    }
    void end_part() {
        parts_.push_back(row_of(part_));
        part_ = begun();
    }

    CurveRow row_of(const Span& span) const {
        const auto cycles = static_cast<double>(span.cycles);
        CurveRow row{span.displacement_sum / cycles, span.load_sum / cycles, model_.clock.time};
        const double gained = motion() - span.motion, damped = model_.energy.damped - span.damped;
        const double work = push_->force() * (travelled_ - span.travelled); // of a load of 1
        row.pushed = row.load;
        const double share = (std::abs(gained) + std::abs(damped)) / std::abs(row.load * work);
        constexpr double jump = 0.1; // of a crack or the like: the boundary feels nothing of its energy
        if (work != 0 && (share < jump || !push_->is_boundary())) row.load -= (gained + damped) / work; // equation (4)
        row.reaction = push_->reaction();
        row.lost = model_.energy.joint_friction;
        row.damped = model_.energy.damped;
        row.ratio = model_.clock.average_ratio;
        row.stored = model_.energy.joint_stored();
        row.zone_work = model_.energy.zone_work;
        row.at_rest = std::max(share, row.ratio) <= command_.damped;
        return row;
    }

    std::string add_row() {
        const CurveRow row = row_of(row_);
        if (!parts_.empty()) end_part();
        if (follower_.follows()) follow(counted() - counted_at_row_);
        row_ = part_ = begun();
        counted_at_row_ = counted();
        curve_.add(row, std::exchange(parts_, {}));
        if (curve_.peak_is_at_rest()) {
            model_.clock.peak_load = curve_.peak().load;
            model_.clock.peak_displacement = curve_.peak().displacement;
        }
        push_->renew();
        constexpr std::uint64_t few = 64;
        const auto rows = static_cast<std::uint64_t>(cycles_ / command_.every);
        if (rows >= few && std::has_single_bit(rows)) store(); // what a run leaves that is cut off
        return reason(row);
    }

    std::string reason(const CurveRow& row) const {
        if (counted() >= command_.to) return "displacement " + number_text(command_.to);
        constexpr double begun = 0.01; // of the displacement
        const double peak = curve_.peak().load;
        if (row.displacement > begun * command_.to && peak > 0 && curve_.stays_below(command_.below * peak))
            return command_.below > 0 ? fmt::format("a load of {} of its peak", number_text(command_.below))
                                      : push_->end_of_load();
        if (free_fall(model_)) return "the fall of a body";
        return {};
    }

    /// The loads move as fast as the followed displacement needs, by the ratio of both in the last row.
    void follow(double gained) {
        constexpr double most = 16;
        const double travelled = travelled_ - row_.travelled;
        if (gained > 0 && travelled > 0) speed_ratio_ = std::clamp(travelled / gained, 1 / most, most);
    }

    double damped_share() const { return work_ > 0 ? (curve_.back().damped - damped_at_start_) / work_ : 0; }

    static constexpr double slowest = 1.0 / 64; ///< share of the speed at the start, and while damping takes too much

    Session& session_;
    Model& model_;
    const lang::SolveControl& command_;
    std::unique_ptr<Push> push_;
    Follower follower_;
    double damped_at_start_;
    double travelled_ = 0, counted_at_row_ = 0, speed_ratio_ = 1, work_ = 0, pace_ = slowest, paced_work_ = 0,
           paced_damped_ = 0, change_ = 1;
    std::int64_t cycles_ = 0;
    Span row_, part_;
    std::vector<CurveRow> parts_; ///< of the row that has begun
    LoadCurve curve_;
};

} // namespace

void push_over(Session& session, const lang::SolveControl& command) {
    Limits none;
    none.cycles = 0;
    advance_until(session, none); // masses and contacts of now
    refuse_other_motion(session, command);
    LoadControl control(session, command);
    Limits limits;
    limits.ends = [&] { return control.advanced(); };
    try {
        const RunEnd end = advance_until(session, limits);
        session.engine.world.stopped_by = end.why;
        control.end();
        control.tell(end.why);
    } catch (...) {
        control.end();
        throw;
    }
}

} // namespace kaya
