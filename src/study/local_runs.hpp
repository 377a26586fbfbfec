// The runs of a study on this machine, each in a separate process.
#pragma once

#include "study/runs.hpp"
#include "study/study_folder.hpp"
#include "study/study_progress.hpp"

#include <functional>
#include <map>
#include <set>
#include <sys/types.h>
#include <time.h>

namespace kaya {

/// Called in a separate process, whose current folder is that of the run: runs the deck and writes the outcome, unless it was stopped from
/// outside. The return value becomes the exit status.
using RunCase = std::function<int(const Case& one, const std::filesystem::path& outcome_file)>;

class LocalRuns : public Runs {
public:
    struct Options {
        int at_once = 1;     ///< runs at one time
        bool shared = false; ///< other processes do runs of this study as well; theirs are waited for
        RunLimits limits;
        std::optional<std::vector<std::string>> kept; ///< patterns of files that are kept
    };
    LocalRuns(const StudyFolder& folder, Options options, RunCase run, StudyProgress& progress);

    std::vector<Outcome> all(const std::vector<Case>& cases) override;

private:
    struct Child {
        const Case* one = nullptr;
        timespec began{}, asked{}; ///< when its end was requested
        bool over_time = false;
    };
    enum class Start { started, elsewhere, done };

    Start start(const Case& one);
    void reap();
    void finish(const Child& child, int status, double seconds);
    void end_late_ones();
    void stop_all(int signal);
    void sweep(const std::filesystem::path& folder) const;
    std::string text_of_stop(std::size_t done, std::size_t all) const;

    const StudyFolder& folder_;
    Options options_;
    RunCase run_;
    StudyProgress& progress_;
    std::map<pid_t, Child> children_;
    std::map<std::size_t, int> losses_; ///< times that a run was killed from outside, by number
    std::vector<const Case*> again_;    ///< to be started again
};

} // namespace kaya
