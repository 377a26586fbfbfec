#include "commands/monitors/progress.hpp"

#include "base/counted.hpp"

#include "commands/program/text_table.hpp"

#include "mechanics/step/density_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

std::string time_text(const Model& model) {
    const bool scaled = model.settings.mass_scaling != MassScaling::none && scaled_masses(model).scaled > 0;
    return number_text(model.clock.time) + (scaled ? " (scaled)" : "");
}

std::string scaling_text(const Model& model) {
    if (model.settings.mass_scaling == MassScaling::none) return {};
    const ScaledMasses masses = scaled_masses(model);
    if (masses.scaled == 0) return {};
    const double added = masses.inertial - masses.real;
    return fmt::format("density scaling: {} of {} bodies have scaled masses, {} is added to {} ({:.3g} %)",
                       masses.scaled, masses.bodies, number_text(added), number_text(masses.real),
                       100 * added / masses.real);
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Progress::Progress(Output& output, const Model& model, const Target& target)
    : output_(output), model_(model), target_(target), start_(std::chrono::steady_clock::now()),
      first_time_(model.clock.time) {}

bool Progress::advanced() {
    ++done_;
    if (--until_check_ > 0) return false;
    update();
    until_check_ = stride_;
    return true;
}

void Progress::update() {
    const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    // About fifty checks a second, whatever a cycle costs.
    const double since = now - seconds_;
    if (since < 0.01) stride_ = std::min<std::int64_t>(2 * stride_, 1 << 20);
    else if (since > 0.04) stride_ = std::max<std::int64_t>(stride_ / 2, 1);
    seconds_ = now;

    const double pause = output_.in_place() ? 0.2 : 10.0;
    if (now - shown_ < pause) return;
    shown_ = now;
    if (output_.in_place()) output_.refresh(line());
    else output_.say(line());
}

void Progress::expect(std::string task, std::optional<double> seconds_left) {
    target_.task = std::move(task);
    target_.seconds = seconds_left ? std::optional(seconds_ + *seconds_left) : std::nullopt;
}

double Progress::left() const {
    const auto cycles = static_cast<double>(done_);
    if (done_ == 0) return -1;
    double left = -1;
    if (target_.cycle) left = seconds_ / cycles * static_cast<double>(*target_.cycle - model_.clock.cycle);
    const double passed = model_.clock.time - first_time_;
    if (target_.time && passed > 0) {
        const double by_time = seconds_ / passed * (*target_.time - model_.clock.time);
        left = left < 0 ? by_time : std::min(left, by_time);
    }
    if (target_.seconds) left = std::max(0.0, *target_.seconds - seconds_);
    return left;
}

std::string Progress::line() const {
    const auto& clock = model_.clock;
    const double rate = static_cast<double>(done_) / std::max(seconds_, 1e-9);
    std::string text = target_.task.empty() ? "" : target_.task + "  ";
    text += fmt::format("cycle {}", clock.cycle);
    if (target_.cycle) text += fmt::format(" of {}", *target_.cycle);
    text += fmt::format("  time {}  ratio {:.2e}  {:.0f} cycles/s", time_text(model_), clock.average_ratio, rate);
    if (const double seconds = left(); seconds >= 0) text += fmt::format("  {} left", duration_text(seconds));
    return text;
}

void Progress::finish() {
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    output_.end_refresh();
    const auto& clock = model_.clock;
    output_.say(fmt::format("cycle {}  time {}  ratio {:.2e}  ({} in {:.2f} s, {:.0f} cycles/s)", clock.cycle,
                            time_text(model_), clock.average_ratio, counted(done_, "cycle"), seconds_,
                            static_cast<double>(done_) / std::max(seconds_, 1e-9)));
    if (const std::string scaling = scaling_text(model_); !scaling.empty()) output_.say(scaling);
}

} // namespace kaya
