#include "app/run_report.hpp"

#include "app/thinned.hpp"

#include "commands/session/save_session.hpp"
#include "report/scene_data.hpp"
#include "laws/joint_model.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <numeric>

namespace kaya {

namespace {

constexpr std::size_t most_states = 24, most_bytes = 4'000'000; ///< a page of less than 10 MB opens at once

std::size_t bytes_of(const std::vector<ReportState>& states) {
    return std::accumulate(states.begin(), states.end(), std::size_t{0},
                           [](std::size_t sum, const ReportState& state) { return sum + state.scene.size(); });
}

} // namespace

std::function<LawNames(const std::string&)> law_names_of(JointRegistry& joints) {
    return [&joints](const std::string& name) {
        LawNames names;
        if (name.find_first_of("/.") != std::string::npos) return names;
        try {
            const JointModel& model = joints.get(name);
            for (const auto& property : model.properties) names.properties.push_back(property.name);
            names.states = model.states;
        } catch (const Diagnostic&) { // its values are shown without their names
        }
        return names;
    };
}

RunReport::RunReport(Session& session, std::optional<int> port) : session_(session) {
    if (port) {
        server_ = std::make_unique<PageServer>(*port);
        session_.program.output.say(fmt::format("watch: {}", server_->address()));
        session_.program.output.flush();
    }
    session_.program.listen(*this);
}

RunReport::~RunReport() { session_.program.forget(*this); }

// By cycles and not by seconds: the same run gives the same page.
void RunReport::cycled() {
    if (!is_wanted()) return;
    const Model& model = session_.engine.model;
    course_.sample(model);
    if (server_ && std::chrono::steady_clock::now() - shown_ >= pause_ && server_->is_read()) show();
    const std::int64_t cycle = model.clock.cycle;
    if (!states_.empty() && cycle <= states_.back().cycle) states_.clear(); // another model, or this one from before
    if (states_.empty()) centre_ = report_centre(model), interval_ = first_interval;
    else if (cycle - states_.back().cycle < interval_) return;
    states_.push_back(report_state(model, centre_));
    while (states_.size() > 1 && (states_.size() > most_states || bytes_of(states_) > most_bytes)) {
        states_ = thinned(std::move(states_));
        interval_ *= 2;
    }
}

void RunReport::show() {
    const auto before = std::chrono::steady_clock::now();
    server_->show(page());
    shown_ = std::chrono::steady_clock::now();
    pause_ = std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(2), 20 * (shown_ - before));
}

std::string RunReport::page() {
    Model& model = session_.engine.model;
    ReportOrder order;
    order.source = "run";
    order.course = course_.curves();
    order.warnings = session_.program.warning_texts;
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - began_).count();
    order.took = seconds < 60 ? fmt::format("{} s", seconds) : fmt::format("{} min {} s", seconds / 60, seconds % 60);
    order.file = std::filesystem::path(session_.deck.file).filename().string();
    order.version = program_version();
    order.law_names = law_names_of(session_.engine.joints);
    if (!states_.empty() && states_.back().cycle > model.clock.cycle) states_.clear();
    order.centre = states_.empty() ? report_centre(model) : centre_;
    order.before = states_;
    if (!states_.empty() && states_.back().cycle == model.clock.cycle)
        order.before.pop_back(); // the writer adds the present state itself
    return report_of(model, session_extras(session_), order);
}

void RunReport::write() {
    if (!session_.program.report) return;
    const std::string name = session_.run_name() + ".html";
    write_whole_file(session_.program.output_file(name), page());
    session_.program.output.say(fmt::format("report: {}", name));
}

} // namespace kaya
