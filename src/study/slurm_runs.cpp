#include "study/slurm_runs.hpp"

#include "base/pattern.hpp"
#include "base/sha256.hpp"
#include "study/command_output.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <sys/stat.h>
#include <thread>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr int most_lost_batches = 5;      ///< batches in a row without a new outcome
constexpr double poll_interval = 0.5;     ///< seconds between two checks of the outcomes
constexpr int polls_per_question = 4;     ///< number of checks for each query of the queue
constexpr double queue_patience = 300;    ///< seconds for which sbatch may be without a controller
constexpr std::size_t usual_tasks = 1000; ///< of an array, when Slurm does not report its limit

/// In quotes for sh.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

bool nobody_answers(const std::string& said) {
    static const Pattern words(
        "unable to contact|connection refused|connection timed out|socket timed out|communication connection failure|temporarily|zero bytes were transmitted",
        Pattern::Letters::of_either_case);
    return words.is_in(said);
}

std::string without_end(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

} // namespace

SlurmRuns::SlurmRuns(const StudyFolder& folder, Options options, StudyProgress& progress)
    : folder_(folder), options_(std::move(options)), progress_(progress),
      name_("kaya-" + sha256(folder.path().string()).substr(0, 16)) {
    if (const auto failed = door::make_folders(folder_.path() / "slurm", Use::write))
        throw Diagnostic(
            fmt::format("cannot make the folder {}: {}", (folder_.path() / "slurm").string(), failed.message()), {},
            Fault::run);
}

std::vector<Case> SlurmRuns::left_of(const std::vector<Case>& cases) const {
    std::vector<Case> left;
    for (const auto& one : cases)
        if (!folder_.outcome(one)) left.push_back(one);
    return left;
}

std::size_t SlurmRuns::most_tasks() const {
    const auto said = output_of({"scontrol", "show", "config"});
    static const Pattern size("MaxArraySize\\s*=\\s*([0-9]{1,9})");
    const auto found = size.all(said.output, 1);
    if (said.status != 0 || found.empty()) return usual_tasks;
    return std::max<std::size_t>(2, std::stoul(found.front())) - 1; // the first index that is too large
}

void SlurmRuns::wait(double seconds, const std::vector<Case>& cases) {
    for (double waited = 0; waited < seconds; waited += 0.1) {
        if (options_.stop != nullptr && *options_.stop)
            throw Diagnostic(fmt::format("stopped: {} of {} runs are done, and the jobs continue",
                                         cases.size() - left_of(cases).size(), cases.size()),
                             fmt::format("the same command follows them; scancel --name={} ends them", name_),
                             Fault::run);
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

void SlurmRuns::submit(const std::vector<Case>& left) {
    int number = 1;
    std::error_code ignored;
    while (fs::exists(folder_.path() / "slurm" / fmt::format("batch-{}.toml", number), ignored)) ++number;
    const std::string batch = fmt::format("batch-{}", number);
    write_cases(folder_.path() / "slurm" / (batch + ".toml"), left);
    const std::size_t per_task = (left.size() + most_tasks() - 1) / most_tasks(),
                      tasks = (left.size() + per_task - 1) / per_task;
    std::string words;
    for (const auto& word : options_.program) words += quoted(word) + " ";
    const fs::path script = folder_.path() / "slurm" / (batch + ".sh");
    write_whole_file(
        script.string(),
        fmt::format("#!/bin/sh\nexec {}study work {} {} \"$SLURM_ARRAY_TASK_ID\" --per-task {} --from {}\n", words,
                    quoted(folder_.path().string()), batch, per_task, quoted(options_.from.string())));
    std::vector<std::string> command{"sbatch",
                                     "--parsable",
                                     "--job-name=" + name_,
                                     fmt::format("--array=1-{}", tasks),
                                     "--cpus-per-task=1",
                                     "--output=" + (folder_.path() / "slurm" / (batch + "-%a.txt")).string(),
                                     "--chdir=" + folder_.path().string()};
    command.insert(command.end(), options_.sbatch.begin(), options_.sbatch.end());
    command.push_back(script.string());
    for (double waited = 0;; waited += 2) {
        const auto said = output_of(command);
        if (said.status == 0) {
            progress_.say(fmt::format("submitted {} runs as job {}", left.size(), without_end(said.output)));
            return;
        }
        if (said.status == 127)
            throw Diagnostic("there is no sbatch here", "omit --slurm to run on this machine", Fault::run);
        if (!nobody_answers(said.output) || waited > queue_patience)
            throw Diagnostic("sbatch: " + without_end(said.output), "the runs that are done are kept", Fault::run);
        wait(2, left);
    }
}

bool SlurmRuns::has_jobs() {
    const auto said = output_of({"squeue", "--noheader", "--name=" + name_, "--format=%i"});
    if (said.status == 127)
        throw Diagnostic("there is no squeue here", "omit --slurm to run on this machine", Fault::run);
    if (said.status != 0) { // usually it is being restarted: jobs continue without it
        if (!deaf_) progress_.say("the queue does not answer: " + without_end(said.output));
        deaf_ = true;
        return true;
    }
    if (deaf_) progress_.say("the queue answers again");
    deaf_ = false;
    return !without_end(said.output).empty();
}

/// Until all outcomes exist, or no job is left.
void SlurmRuns::follow(const std::vector<Case>& cases) {
    std::set<std::size_t> there;
    for (const auto& one : cases)
        if (folder_.outcome(one)) there.insert(one.number);
    for (int poll = 1; there.size() < cases.size(); ++poll) {
        const bool over = poll % polls_per_question == 0 && !has_jobs();
        for (const auto& one : cases) {
            if (there.contains(one.number)) continue;
            const auto outcome = folder_.outcome(one);
            if (!outcome) continue;
            there.insert(one.number);
            progress_.one_done(outcome->end == Outcome::End::done);
        }
        if (over) return;
        wait(poll_interval, cases);
    }
}

std::vector<Outcome> SlurmRuns::all(const std::vector<Case>& cases) {
    auto left = left_of(cases);
    progress_.begin(cases.size(), cases.size() - left.size());
    if (!left.empty() && has_jobs()) {
        progress_.say("jobs of an earlier call are in the queue: they are followed");
        follow(cases);
        left = left_of(cases);
    }
    for (int losses = 0; !left.empty();) {
        submit(left);
        follow(cases);
        const auto still = left_of(cases);
        losses = still.size() < left.size() ? 0 : losses + 1;
        left = still;
        if (!left.empty()) progress_.say(fmt::format("{} runs were lost and are submitted again", left.size()));
        if (losses == most_lost_batches)
            throw Diagnostic(fmt::format("{} runs have no outcome after {} tries", left.size(), most_lost_batches),
                             fmt::format("look at {}", (folder_.path() / "slurm").string()), Fault::run);
    }
    progress_.end();
    std::vector<Outcome> outcomes;
    for (const auto& one : cases) outcomes.push_back(*folder_.outcome(one));
    return outcomes;
}

std::vector<Case> cases_of_task(const StudyFolder& folder, const std::string& batch, std::size_t task,
                                std::size_t per_task) {
    const auto all = read_cases(folder.path() / "slurm" / (batch + ".toml"));
    const std::size_t first = (task - 1) * per_task;
    if (task < 1 || first >= all.size()) throw Diagnostic(fmt::format("{} has no task {}", batch, task));
    return {all.begin() + static_cast<std::ptrdiff_t>(first),
            all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first + per_task))};
}

} // namespace kaya
