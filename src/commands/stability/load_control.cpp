#include "commands/stability/load_control.hpp"

#include "commands/conditions/tables.hpp"
#include "commands/list/reactions.hpp"
#include "commands/monitors/free_fall.hpp"
#include "commands/stability/load_pattern.hpp"
#include "commands/run/run_cycles.hpp"
#include "model/kinds/nearest.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace kaya {

namespace {

/// What is scaled: a part of gravity, a variable of FISH, or both, by one factor.
class ScaledLoad {
public:
    ScaledLoad(Session& session, const lang::SolveControl& command) : session_(session), variable_(command.variable) {
        Vec3& gravity = session.engine.model.settings.gravity;
        if (command.gravity) {
            along_ = command.gravity->normalized();
            rest_ = gravity - along_ * gravity.dot(along_);
            if (!(rest_.norm() > 1e-9 * gravity.norm()))
                throw Diagnostic("there is no gravity normal to this direction, and the load is a share of it",
                                 "give it first: gravity 0 0 -9.81")
                    .at(command.place);
            factor_ = gravity.dot(along_) / rest_.norm();
        }
        if (variable_.empty()) return;
        check_symbol(session, variable_);
        if (!command.gravity) factor_ = session.engine.scripts->number(variable_, command.place);
        set(factor_);
    }

    LoadPattern pattern() const { return {session_.engine.model, along_ * rest_.norm(), variable_}; }
    double factor() const { return factor_; }
    void set(double factor) {
        factor_ = factor;
        if (!along_.isZero()) session_.engine.model.settings.gravity = rest_ + along_ * (factor * rest_.norm());
        if (!variable_.empty()) session_.engine.scripts->set(variable_, factor);
    }

private:
    Session& session_;
    Vec3 along_ = Vec3::Zero(), rest_ = Vec3::Zero();
    std::string variable_;
    double factor_ = 0;
};

/// The displacement that the user looks at, where it is not that of the loads.
class Follower {
public:
    Follower(const Model& model, const lang::SolveControl& command) : model_(model) {
        if (!command.point) return;
        along_ = command.along->normalized();
        row_ = nearest_row(model, ObjectKind::gridpoint, *command.point);
        start_ = now();
    }
    bool follows() const { return row_ != no_row; }
    double displacement() const { return now() - start_; }

private:
    double now() const { return along_.dot(model_.gridpoints.displacement[row_]); }

    const Model& model_;
    Row row_ = no_row;
    Vec3 along_ = Vec3::Zero();
    double start_ = 0;
};

/// A mean over some cycles.
struct CurveRow {
    double displacement = 0, load = 0, time = 0;
    Vec3 reaction = Vec3::Zero();
    double lost = 0, damped = 0, ratio = 0;
};

class LoadControl {
public:
    LoadControl(Session& session, const lang::SolveControl& command)
        : session_(session), model_(session.engine.model), command_(command), load_(session, command),
          pattern_(load_.pattern()), follower_(model_, command), answer_(pattern_.answer(model_)),
          before_(pattern_.velocity(model_)), damped_at_start_(model_.energy.damped) {
        paced_damped_ = damped_at_start_;
        lost_to_motion_ = damped_at_start_ + model_.energy.kinetic;
    }

    /// After a cycle: sets the next load. Returns the reason to stop, if there is one.
    std::string advanced() {
        const double step = model_.clock.time_step;
        const double velocity = pattern_.velocity(model_), factor = load_.factor();
        travelled_ += velocity * step;
        work_ += factor * pattern_.force() * velocity * step;
        sum_ += factor;
        std::string why;
        if (++cycles_ % command_.every == 0) why = add_row();
        constexpr double part = 0.2; // a variable acts one step later than gravity, and damping changes the answer
        const double missing = part * part / 4 * (wanted() - velocity) - part * (velocity - before_); // equation (2)
        const double change = missing / (step * answer_);
        before_ = velocity;
        pace();
        if (why.empty()) load_.set(factor + change);
        return why;
    }

    void tell(const std::string& why) const {
        auto& output = session_.program.output;
        output.say("solve control: stopped by " + why);
        if (rows_.empty()) return;
        const CurveRow& peak = *std::ranges::max_element(rows_, {}, &CurveRow::load);
        output.say(fmt::format("  peak load {} at displacement {}; at the end {} at {}", number_text(peak.load),
                               number_text(peak.displacement), number_text(rows_.back().load),
                               number_text(rows_.back().displacement)));
        constexpr double much = 0.05;
        if (const double share = damped_share(); share > much)
            session_.warn(
                Diagnostic(fmt::format("damping has taken {:.0f} % of the work of the load", 100 * share),
                           "that is taken out of the load, which is the less exact: go slower, and use `damp local`")
                    .at(command_.place));
    }

    /// Writes the curve, as far as it is known.
    void store() const {
        if (command_.table) {
            auto& table = session_.engine.scripts->tables()[*command_.table];
            table.points.clear();
            for (const CurveRow& row : rows_) table.points.push_back({row.displacement, row.load});
        }
        if (command_.file.empty()) return;
        std::string text = "displacement,load,time,reaction_x,reaction_y,reaction_z,lost,damped,ratio\n";
        for (const CurveRow& row : rows_)
            text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", row.displacement,
                                row.load, row.time, row.reaction.x(), row.reaction.y(), row.reaction.z(), row.lost,
                                row.damped, row.ratio);
        write_whole_file(session_.program.output_file(command_.file), text);
    }

private:
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
    double wanted() const { return command_.speed * speed_ratio_ * pace_; }
    double counted() const { return follower_.follows() ? follower_.displacement() : travelled_; }

    std::string add_row() {
        CurveRow row{counted(), sum_ / static_cast<double>(command_.every), model_.clock.time};
        sum_ = 0;
        const double lost_to_motion = model_.energy.damped + model_.energy.kinetic;
        row.load -=
            (lost_to_motion - lost_to_motion_) / (pattern_.force() * (travelled_ - travelled_at_row_)); // equation (3)
        lost_to_motion_ = lost_to_motion;
        row.reaction = reactions_of(model_, [](Row) { return false; }).reaction;
        row.lost = model_.energy.joint_friction;
        row.damped = model_.energy.damped;
        row.ratio = model_.clock.average_ratio;
        if (follower_.follows()) follow(row.displacement - (rows_.empty() ? 0 : rows_.back().displacement));
        travelled_at_row_ = travelled_;
        rows_.push_back(row);
        peak_ = std::max(peak_, row.load);
        if (!pattern_.is_of(model_)) pattern_ = load_.pattern();
        answer_ = pattern_.answer(model_);
        constexpr std::size_t few = 64;
        if (rows_.size() >= few && std::has_single_bit(rows_.size())) store(); // what a run leaves that is cut off
        return reason(row);
    }

    std::string reason(const CurveRow& row) const {
        if (row.displacement >= command_.to) return "displacement " + number_text(command_.to);
        constexpr double begun = 0.01; // of the displacement
        if (row.displacement > begun * command_.to && peak_ > 0 && row.load <= command_.below * peak_)
            return command_.below > 0 ? fmt::format("a load of {} of its peak", number_text(command_.below))
                                      : "a load of 0: it falls by itself";
        if (free_fall(model_)) return "the fall of a body";
        return {};
    }

    /// The loads move as fast as the followed displacement needs, by the ratio of both in the last row.
    void follow(double gained) {
        constexpr double most = 16;
        const double travelled = travelled_ - travelled_at_row_;
        if (gained > 0 && travelled > 0) speed_ratio_ = std::clamp(travelled / gained, 1 / most, most);
    }

    double damped_share() const { return work_ > 0 ? (rows_.back().damped - damped_at_start_) / work_ : 0; }

    static constexpr double slowest = 1.0 / 64; ///< share of the speed at the start, and while damping takes too much

    Session& session_;
    Model& model_;
    const lang::SolveControl& command_;
    ScaledLoad load_;
    LoadPattern pattern_;
    Follower follower_;
    double answer_, before_; ///< of the load; velocity a cycle ago
    double damped_at_start_;
    double travelled_ = 0, travelled_at_row_ = 0, speed_ratio_ = 1, work_ = 0, sum_ = 0, peak_ = 0, pace_ = slowest,
           paced_work_ = 0, paced_damped_ = 0, change_ = 1, lost_to_motion_ = 0;
    std::int64_t cycles_ = 0;
    std::vector<CurveRow> rows_;
};

} // namespace

void push_over(Session& session, const lang::SolveControl& command) {
    Limits none;
    none.cycles = 0;
    advance_until(session, none); // masses and contacts of now
    LoadControl control(session, command);
    Limits limits;
    limits.ends = [&] { return control.advanced(); };
    try {
        const RunEnd end = advance_until(session, limits);
        session.engine.world.stopped_by = end.why;
        control.store();
        control.tell(end.why);
    } catch (...) {
        control.store();
        throw;
    }
}

} // namespace kaya
