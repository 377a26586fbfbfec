// `set report on`: the page of a run, with the states that it went through.
#pragma once

#include "app/run_course.hpp"
#include "commands/session.hpp"
#include "report/report.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace kaya {

/// Names of the properties of joint models, in their order; none of a model that is given by a path or cannot be loaded.
std::function<std::vector<std::string>(const std::string& model)> property_names_of(JointRegistry& joints);

/// Watches a session and writes its page at the end.
class RunReport {
public:
    explicit RunReport(Session& session);
    ~RunReport();
    RunReport(const RunReport&) = delete;
    RunReport& operator=(const RunReport&) = delete;

    /// The page, named after the deck, when the run asked for one. Throws Diagnostic.
    void write();

private:
    void look();

    Session& session_;
    std::vector<ReportState> states_;
    Vec3 centre_ = Vec3::Zero();
    std::int64_t interval_ = first_interval; ///< cycles between two states
    RunCourse course_;
    std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();

    static constexpr std::int64_t first_interval = 50;
};

} // namespace kaya
