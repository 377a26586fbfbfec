#include "jointtest/joint_curve.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "jointtest/gnuplot_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// The path point at part `t` of the segment from `a` to `b`.
PathPoint between(const PathPoint& a, const PathPoint& b, double t) {
    const auto mix = [t](double from, double to) { return from + t * (to - from); };
    PathPoint p;
    for (int k = 0; k < 2; ++k) p.shear[k] = mix(a.shear[k], b.shear[k]);
    p.time = mix(a.time, b.time);
    if (a.opening) p.opening = mix(*a.opening, *b.opening);
    if (a.stress) p.stress = mix(*a.stress, *b.stress);
    p.boundary_stiffness = mix(a.boundary_stiffness, b.boundary_stiffness);
    return p;
}

/// Drives the joint to points of the path, and stores the state of the boundary.
class Bench {
public:
    Bench(SingleJoint joint, const CurveSettings& settings) : joint_(std::move(joint)), settings_(settings) {}

    /// One step to a point.
    void go(const PathPoint& to) {
        JointStep step;
        step.time = to.time - time_;
        for (int k = 0; k < 2; ++k) step.shear[k] = to.shear[k] - joint_.shear_disp[k];
        const SingleJoint before = joint_;
        if (to.opening) {
            step.opening = *to.opening - joint_.normal_disp;
            joint_.step(step);
        } else if (to.boundary_stiffness == 0) {
            step.opening = last_opening_;
            joint_.step_to_stress(*to.stress, step);
        } else {
            against_spring(to, step);
        }
        last_opening_ = joint_.normal_disp - before.normal_disp;
        time_ = to.time;
        put_in_ += work(before);
    }

    void begin_test() { opening_at_start_ = joint_.normal_disp; }

    CurvePoint point(const PathPoint& last) const {
        CurvePoint p;
        p.time = time_;
        p.opening = joint_.normal_disp;
        const auto resistance = joint_.shear_resistance();
        for (int k = 0; k < 2; ++k)
            p.shear[k] = joint_.shear_disp[k], p.resistance[k] = resistance[k] + 0.0; // no minus zero
        p.normal_stress = joint_.normal_stress();
        p.normal_stiffness = joint_.normal_stiffness;
        p.shear_stiffness = joint_.shear_stiffness;
        p.put_in = put_in_ / joint_.area;
        p.taken_up = joint_.frictional_work / joint_.area;
        p.state = joint_.state;
        if (settings_.tangents) measure_tangents(p, last);
        return p;
    }

    const SingleJoint& joint() const { return joint_; }

private:
    /// The stress of the boundary rises with the opening: where joint and boundary meet.
    void against_spring(const PathPoint& to, JointStep step) {
        const auto boundary = [&](double opening) {
            return *to.stress + to.boundary_stiffness * (joint_.normal_disp + opening - opening_at_start_);
        };
        const auto over = [&](double opening) {
            SingleJoint trial = joint_.trial();
            step.opening = opening;
            trial.step(step);
            return trial.normal_stress() - boundary(opening);
        };
        const double scale = std::abs(*to.stress) + joint_.normal_stress();
        double opening = last_opening_;
        if (!find_opening(over, opening, scale / (joint_.normal_stiffness + to.boundary_stiffness), scale, opening))
            throw Diagnostic(fmt::format("joint model {} and the boundary do not meet", joint_.model->name),
                             "look at boundary_stiffness");
        step.opening = opening;
        joint_.step(step);
    }

    double work(const SingleJoint& before) const {
        double sum = -0.5 * (before.normal_force + joint_.normal_force) * (joint_.normal_disp - before.normal_disp);
        for (int k = 0; k < 2; ++k)
            sum -=
                0.5 * (before.shear_force[k] + joint_.shear_force[k]) * (joint_.shear_disp[k] - before.shear_disp[k]);
        return sum;
    }

    /// Derivative of answer(displacement), over a small displacement. The response to a jump does not decrease with the displacement as a
    /// stiffness does: where halving shows one, the slope after the jump is used.
    template <class Answer> static double tangent(double reported, double before, double shift, Answer answer) {
        const double whole = answer(shift) - before;
        if (!(std::abs(whole) > reported * shift)) return whole / shift;
        const double half = answer(0.5 * shift) - before;
        constexpr double like_a_jump = 0.75; // of the whole displacement: a stiffness gives a half
        return std::abs(half) > like_a_jump * std::abs(whole) ? (whole - half) / (0.5 * shift) : whole / shift;
    }

    /// Small further steps without time: closing, and on in the direction of the last motion.
    void measure_tangents(CurvePoint& p, const PathPoint& last) const {
        const double scale = std::max(std::abs(p.normal_stress), 1e-6 * p.normal_stiffness) / p.normal_stiffness;
        p.normal_tangent = tangent(p.normal_stiffness, p.normal_stress, 1e-5 * scale, [&](double shift) {
            SingleJoint closer = joint_.trial();
            closer.step({-shift, {}, 0});
            return closer.normal_stress();
        });
        double shift[2] = {joint_.shear_disp[0] - last.shear[0], joint_.shear_disp[1] - last.shear[1]};
        const double length = std::hypot(shift[0], shift[1]);
        if (!(length > 0)) return;
        for (double& part : shift) part /= length;
        p.shear_tangent = tangent(p.shear_stiffness, p.resistance[0] * shift[0] + p.resistance[1] * shift[1],
                                  1e-2 * length, [&](double step) {
                                      SingleJoint further = joint_.trial();
                                      further.step({0, {step * shift[0], step * shift[1]}, 0});
                                      const auto resistance = further.shear_resistance();
                                      return resistance[0] * shift[0] + resistance[1] * shift[1];
                                  });
    }

    SingleJoint joint_;
    CurveSettings settings_;
    double time_ = 0, last_opening_ = 0, opening_at_start_ = 0, put_in_ = 0;
};

/// Reports each kind of odd behaviour once.
class StepChecks {
public:
    explicit StepChecks(std::vector<Finding>& findings) : findings_(findings) {}

    void compare(std::size_t step, const CurvePoint& before, const CurvePoint& now) {
        constexpr double slack = 1.02; // a tangent over a finite step is not the one at its end
        if (now.normal_tangent > slack * std::max(now.normal_stiffness, before.normal_stiffness))
            say(0, step,
                fmt::format("normal stiffness is {:.4g}, the model reports {:.4g}: a run can blow up",
                            now.normal_tangent, now.normal_stiffness));
        if (now.shear_tangent > slack * std::max(now.shear_stiffness, before.shear_stiffness))
            say(1, step,
                fmt::format("shear stiffness is {:.4g}, the model reports {:.4g}: a run can blow up", now.shear_tangent,
                            now.shear_stiffness));
        const double shift = std::hypot(now.shear[0] - before.shear[0], now.shear[1] - before.shear[1]);
        const double change =
            std::hypot(now.resistance[0] - before.resistance[0], now.resistance[1] - before.resistance[1]);
        const double strength = std::hypot(before.resistance[0], before.resistance[1]);
        // Elastic motion, and the part that a change of normal stress brings, explain so much of a change.
        const double relative = before.normal_stress > 0 ? std::abs(now.normal_stress / before.normal_stress - 1) : 1;
        const double explained =
            slack * std::max(now.shear_stiffness, before.shear_stiffness) * shift + 1.1 * relative * strength;
        if (change > explained + 1e-9 * strength)
            say(2, step,
                fmt::format("shear stress jumps from {:.4g} to {:.4g}", strength,
                            std::hypot(now.resistance[0], now.resistance[1])));
        highest_ = std::max(highest_, now.put_in);
        // A step across a kink is off by its share of the whole.
        if (now.put_in < -1e-3 * highest_)
            say(3, step,
                fmt::format("the joint has returned {:.3g} more than was put in: it creates energy", -now.put_in));
        if (now.taken_up > now.put_in + 1e-3 * highest_)
            say(4, step,
                fmt::format("frictional_work is {:.4g}, but only {:.4g} was put in", now.taken_up, now.put_in));
    }

private:
    void say(std::size_t kind, std::size_t step, std::string text) {
        if (said_[kind]) return;
        said_[kind] = true;
        findings_.push_back({step, std::move(text)});
    }

    std::vector<Finding>& findings_;
    bool said_[5] = {};
    double highest_ = 0;
};

} // namespace

JointCurve follow_path(const JointModel& model, const std::vector<double>& values, const LoadPath& path,
                       const CurveSettings& settings) {
    Bench bench(SingleJoint(model, values, settings.area), settings);
    JointCurve curve;
    StepChecks checks(curve.findings);
    const auto note = [&](const PathPoint& last) {
        curve.points.push_back(bench.point(last));
        const auto& history = bench.joint().history;
        curve.history.emplace_back(history.begin(),
                                   history.begin() + static_cast<std::ptrdiff_t>(model.history.size()));
        const std::size_t n = curve.points.size();
        if (n > 1) checks.compare(n - 1, curve.points[n - 2], curve.points[n - 1]);
    };
    // To the first point in a straight line from zero, which is not part of the test.
    PathPoint nothing = path.points.front();
    nothing.shear = {};
    if (nothing.opening) nothing.opening = 0.0;
    if (nothing.stress) nothing.stress = 0.0;
    PathPoint first = path.points.front();
    first.boundary_stiffness = 0;
    nothing.boundary_stiffness = 0;
    const std::size_t steps_to_start = settings.steps_to_start > 0 ? settings.steps_to_start : settings.steps;
    StopPoints stops;
    for (std::size_t k = 1; k <= steps_to_start; ++k) {
        stops.pass();
        bench.go(between(nothing, first, static_cast<double>(k) / static_cast<double>(steps_to_start)));
    }
    bench.begin_test();
    note(path.points.front());
    curve.at_path.push_back(0);
    for (std::size_t piece = 1; piece < path.points.size(); ++piece) {
        PathPoint last = path.points[piece - 1];
        for (std::size_t k = 1; k <= settings.steps; ++k) {
            const PathPoint to = between(path.points[piece - 1], path.points[piece],
                                         static_cast<double>(k) / static_cast<double>(settings.steps));
            stops.pass();
            bench.go(to);
            note(last);
            last = to;
        }
        curve.at_path.push_back(curve.points.size() - 1);
    }
    return curve;
}

CsvTable curve_table(const JointCurve& curve, const JointModel& model) {
    CsvTable table;
    const auto add = [&](const char* name, auto value) {
        std::vector<double> column;
        for (const auto& p : curve.points) column.push_back(value(p));
        table.add(name, std::move(column));
    };
    add("time", [](const CurvePoint& p) { return p.time; });
    add("normal_displacement", [](const CurvePoint& p) { return p.opening; });
    add("shear_displacement", [](const CurvePoint& p) { return p.shear[0]; });
    add("shear_displacement_y", [](const CurvePoint& p) { return p.shear[1]; });
    add("normal_stress", [](const CurvePoint& p) { return p.normal_stress; });
    add("shear_stress", [](const CurvePoint& p) { return p.resistance[0]; });
    add("shear_stress_y", [](const CurvePoint& p) { return p.resistance[1]; });
    add("normal_stiffness", [](const CurvePoint& p) { return p.normal_stiffness; });
    add("normal_tangent", [](const CurvePoint& p) { return p.normal_tangent; });
    add("shear_stiffness", [](const CurvePoint& p) { return p.shear_stiffness; });
    add("shear_tangent", [](const CurvePoint& p) { return p.shear_tangent; });
    add("put_in", [](const CurvePoint& p) { return p.put_in; });
    add("frictional_work", [](const CurvePoint& p) { return p.taken_up; });
    add("state", [](const CurvePoint& p) { return static_cast<double>(p.state); });
    for (std::size_t k = 0; k < model.history.size(); ++k) {
        std::vector<double> column;
        for (const auto& row : curve.history) column.push_back(row[k]);
        table.add(model.history[k].name, std::move(column));
    }
    return table;
}

std::string curve_figure(const JointCurve& curve, const std::string& title) {
    std::string script = "$curve << EOD\n";
    constexpr std::size_t most_points = 800; // enough for the eye
    const std::size_t every = std::max<std::size_t>(1, curve.points.size() / most_points);
    for (std::size_t i = 0; i < curve.points.size(); i += every) {
        const auto& p = curve.points[i];
        script += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", p.shear[0], p.resistance[0], p.normal_stress, p.opening);
    }
    script += "EOD\n";
    // A path without shear is a closure test.
    const bool sheared = std::any_of(curve.points.begin(), curve.points.end(),
                                     [&](const CurvePoint& p) { return p.shear[0] != curve.points.front().shear[0]; });
    if (!sheared)
        return fmt::format("{}set title {}\nset xlabel \"closure\"\nset ylabel \"normal stress\"\nset key off\n"
                           "plot $curve using (-$4):3 with lines lw 2\n",
                           script, gnuplot_text(title));
    return fmt::format(
        "{}set multiplot layout 2,1 title {}\nset xlabel \"shear displacement\"\n"
        "set key outside top center horizontal\nset ylabel \"stress\"\n"
        "plot $curve using 1:2 with lines lw 2 title \"shear\", $curve using 1:3 with lines lw 1.5 title \"normal\"\n"
        "set ylabel \"opening\"\nset key off\nplot $curve using 1:4 with lines lw 2\nunset multiplot\n",
        script, gnuplot_text(title));
}

} // namespace kaya
