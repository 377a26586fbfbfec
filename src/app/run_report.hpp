// `set report on`: the page of a run, with its states over time.
#pragma once

#include "app/page_server.hpp"
#include "app/run_course.hpp"
#include "commands/session/session.hpp"
#include "report/report.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Names of joint models; none of a model that is given by a path or cannot be loaded.
std::function<LawNames(const std::string& model)> law_names_of(JointRegistry& joints);

/// Watches a session and writes its page at the end.
class RunReport : private Listener {
public:
    /// `port`: for watching the run in a browser (0: any free one); none: no server.
    RunReport(Session& session, std::optional<int> port);
    ~RunReport() override;
    RunReport(const RunReport&) = delete;
    RunReport& operator=(const RunReport&) = delete;

    /// Writes the page, named after the deck, if the run asked for one. Throws Diagnostic.
    void write();

private:
    void cycled() override;
    bool reads_model() const override { return is_wanted(); }
    bool is_wanted() const { return session_.program.report || server_; }
    void show();
    std::string page();

    Session& session_;
    std::vector<ReportState> states_;
    Vec3 centre_ = Vec3::Zero();
    std::int64_t interval_ = first_interval; ///< cycles between two states
    RunCourse course_;
    std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
    std::unique_ptr<PageServer> server_;
    std::chrono::steady_clock::time_point shown_{}; ///< when the last page was made
    std::chrono::steady_clock::duration pause_{};   ///< until the next: pages take a small part of the time

    static constexpr std::int64_t first_interval = 50;
};

} // namespace kaya
