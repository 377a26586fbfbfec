// The runs of a study as jobs of Slurm.
#pragma once

#include "study/runs.hpp"
#include "study/study_folder.hpp"
#include "study/study_progress.hpp"

#include <atomic>

namespace kaya {

/// Submits the remaining runs as an array of jobs and follows it. Lost jobs are submitted again; jobs of an interrupted call are followed.
/// Needs only sbatch, squeue and a folder that all machines share.
class SlurmRuns : public Runs {
public:
    struct Options {
        std::vector<std::string> program;        ///< that does the tasks of a batch, and its first words
        std::filesystem::path from;              ///< the folder of the study's file, which the tasks read
        std::vector<std::string> sbatch;         ///< further options of the user
        const std::atomic<bool>* stop = nullptr; ///< requests the end of this call; the jobs continue
    };
    SlurmRuns(const StudyFolder& folder, Options options, StudyProgress& progress);

    std::vector<Outcome> all(const std::vector<Case>& cases) override;

private:
    std::vector<Case> left_of(const std::vector<Case>& cases) const;
    void submit(const std::vector<Case>& left);
    bool has_jobs();
    void follow(const std::vector<Case>& cases);
    void wait(double seconds, const std::vector<Case>& cases);
    std::size_t most_tasks() const;

    const StudyFolder& folder_;
    Options options_;
    StudyProgress& progress_;
    std::string name_;  ///< of the jobs: the same in each call
    bool deaf_ = false; ///< the queue does not answer at present, which has been reported
};

/// The cases of one task of a batch; tasks count from 1. Throws Diagnostic.
std::vector<Case> cases_of_task(const StudyFolder& folder, const std::string& batch, std::size_t task,
                                std::size_t per_task);

} // namespace kaya
