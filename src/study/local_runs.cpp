#include "study/local_runs.hpp"

#include "base/diagnostic.hpp"
#include "base/terminal_text.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr int most_losses = 3; ///< after that a killed run becomes a failed row
constexpr double patience = 5; ///< seconds from the request to the end
constexpr timespec poll{0, 50'000'000};
constexpr const char *output_file = "output.txt", *lock_file = ".lock";

timespec now() {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time;
}

double seconds_since(const timespec& then) {
    const timespec time = now();
    return static_cast<double>(time.tv_sec - then.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec - then.tv_nsec);
}

bool is_full(const fs::path& folder) {
    std::error_code failed;
    const auto space = fs::space(folder, failed);
    return !failed && space.available < 1'000'000;
}

/// The signals that the runner handles synchronously: they are blocked while it works.
sigset_t own_signals() {
    sigset_t set;
    ::sigemptyset(&set);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&set, signal);
    return set;
}

class Blocked {
public:
    Blocked() : set_(own_signals()) { ::sigprocmask(SIG_BLOCK, &set_, &before_); }
    ~Blocked() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
    Blocked(const Blocked&) = delete;
    Blocked& operator=(const Blocked&) = delete;
    const sigset_t& set() const { return set_; }

private:
    sigset_t set_, before_{};
};

[[noreturn]] void child(const RunCase& run, const Case& one, const fs::path& folder, const fs::path& outcome,
                        const RunLimits& limits, const Descriptor& output, pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // runs end with a study that is killed
    if (::getppid() != parent) std::_Exit(1);
    const sigset_t set = own_signals();
    ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
    const Descriptor nothing = door::null_device();
    if (!nothing || ::dup2(output.number(), STDOUT_FILENO) < 0 || ::dup2(output.number(), STDERR_FILENO) < 0 ||
        ::dup2(nothing.number(), STDIN_FILENO) < 0)
        std::_Exit(1);
    if (limits.megabytes > 0) {
        const auto bytes = static_cast<rlim_t>(limits.megabytes * 1e6);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_DATA, &limit);
    }
    int status = 3;
    try {
        if (door::enter(folder)) status = run(one, outcome);
    } catch (const Diagnostic& problem) { // an outcome that could not be written
        print_text(stderr, render(problem) + "\n");
    } catch (const std::exception& problem) { print_text(stderr, fmt::format("error: {}\n", problem.what())); }
    std::fflush(nullptr);
    std::_Exit(status);
}

} // namespace

LocalRuns::LocalRuns(const StudyFolder& folder, Options options, RunCase run, StudyProgress& progress)
    : folder_(folder), options_(std::move(options)), run_(std::move(run)), progress_(progress) {}

LocalRuns::Start LocalRuns::start(const Case& one) {
    const fs::path folder = folder_.run(one.number);
    if (const auto failed = door::make_folders(folder, Use::write))
        throw Diagnostic(fmt::format("cannot make the folder {}: {}", folder.string(), failed.message()),
                         "runs that are done are kept", Fault::run);
    FileLock lock = FileLock::of(folder / lock_file, FileLock::Kind::alone);
    if (!lock.is_held()) return Start::elsewhere;
    if (folder_.outcome(one)) {
        sweep(folder);
        return Start::done;
    }
    const Descriptor output = door::open(folder / output_file, Use::write, door::Access::renew);
    if (!output)
        throw Diagnostic(fmt::format("cannot write {}: {}", (folder / output_file).string(), std::strerror(errno)),
                         "runs that are done are kept", Fault::run);
    std::fflush(nullptr); // or both processes write the buffered output
    const pid_t parent = ::getpid();
    const pid_t id = ::fork();
    if (id < 0)
        throw Diagnostic(fmt::format("cannot start a process: {}", std::strerror(errno)), "runs that are done are kept",
                         Fault::run);
    // The child has the lock from now on.
    if (id == 0) child(run_, one, folder, folder_.outcome_file(one.number), options_.limits, output, parent);
    children_[id] = Child{&one, now(), {}, false};
    return Start::started;
}

/// Removes the files that are not kept; the files on how the run went remain.
void LocalRuns::sweep(const fs::path& folder) const {
    std::error_code ignored;
    door::remove(folder / lock_file);
    if (!options_.kept) return;
    std::vector<fs::path> unwanted;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file(ignored) || name == "outcome.toml" || name == output_file ||
            entry.path().extension() == ".journal")
            continue;
        const auto wanted = [&](const std::string& pattern) {
            return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
        };
        if (std::ranges::none_of(*options_.kept, wanted)) unwanted.push_back(entry.path());
    }
    for (const auto& path : unwanted) door::remove(path);
}

void LocalRuns::finish(const Child& child, int status, double seconds) {
    const Case& one = *child.one;
    auto outcome = folder_.outcome(one);
    if (outcome && outcome->end != Outcome::End::done && is_full(folder_.path())) {
        door::remove(folder_.outcome_file(one.number)); // it does not describe the run
        throw Diagnostic(fmt::format("the disk is full: {}", folder_.path().string()),
                         "make room; the same command does the remaining runs", Fault::run);
    }
    if (!outcome) {
        outcome.emplace();
        outcome->seconds = seconds;
        const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        const bool from_outside = signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP ||
                                  (WIFEXITED(status) && WEXITSTATUS(status) != 3);
        if (child.over_time) {
            outcome->end = Outcome::End::limit;
            outcome->message = fmt::format("took more than {} s", options_.limits.seconds);
        } else if (from_outside && ++losses_[one.number] < most_losses) {
            again_.push_back(&one);
            return;
        } else {
            outcome->end = from_outside ? Outcome::End::lost : Outcome::End::crashed;
            outcome->message = signal != 0 ? fmt::format("ended by signal {} ({})", signal, ::strsignal(signal))
                                           : fmt::format("ended without an outcome; see {}",
                                                         (folder_.run(one.number) / output_file).string());
        }
        write_outcome(folder_.outcome_file(one.number), one, *outcome);
    }
    sweep(folder_.run(one.number));
    progress_.one_done(outcome->end == Outcome::End::done);
}

void LocalRuns::reap() {
    int status = 0;
    for (pid_t id = 0; (id = ::waitpid(-1, &status, WNOHANG)) > 0;) {
        const auto found = children_.find(id);
        if (found == children_.end()) continue;
        const Child child = found->second;
        children_.erase(found);
        finish(child, status, seconds_since(child.began));
    }
}

void LocalRuns::end_late_ones() {
    if (options_.limits.seconds <= 0) return;
    for (auto& [id, child] : children_) {
        if (!child.over_time && seconds_since(child.began) > options_.limits.seconds) {
            child.over_time = true;
            child.asked = now();
            ::kill(id, SIGTERM);
        } else if (child.over_time && seconds_since(child.asked) > patience) {
            ::kill(id, SIGKILL);
        }
    }
}

void LocalRuns::stop_all(int signal) {
    for (const auto& [id, child] : children_) ::kill(id, signal == SIGINT ? SIGINT : SIGTERM);
    const timespec began = now();
    const sigset_t set = own_signals();
    while (!children_.empty()) {
        if (seconds_since(began) > patience)
            for (const auto& [id, child] : children_) ::kill(id, SIGKILL);
        ::sigtimedwait(&set, nullptr, &poll);
        for (pid_t id = 0; (id = ::waitpid(-1, nullptr, WNOHANG)) > 0;) children_.erase(id);
    }
}

std::vector<Outcome> LocalRuns::all(const std::vector<Case>& cases) {
    std::vector<const Case*> left;
    std::error_code ignored;
    for (const auto& one : cases) // a lock next to an outcome: the study was killed before it swept the run
        if (!folder_.outcome(one) || fs::exists(folder_.run(one.number) / lock_file, ignored)) left.push_back(&one);
    progress_.begin(cases.size(), cases.size() - left.size());
    std::ranges::reverse(left);         // taken from the back
    std::vector<const Case*> elsewhere; // other processes do them
    const Blocked blocked;
    const auto stop = [&](int signal) {
        stop_all(signal);
        progress_.end();
        std::size_t done = 0;
        for (const auto& one : cases) done += folder_.outcome(one) ? 1 : 0;
        throw Diagnostic(fmt::format("stopped: {} of {} runs are done", done, cases.size()),
                         "the same command does the remaining runs", Fault::run);
    };
    try {
        while (!left.empty() || !children_.empty() || !elsewhere.empty() || !again_.empty()) {
            left.insert(left.end(), again_.begin(), again_.end());
            again_.clear();
            while (!left.empty() && children_.size() < static_cast<std::size_t>(options_.at_once)) {
                const Case* one = left.back();
                left.pop_back();
                const Start started = start(*one);
                if (started == Start::elsewhere) elsewhere.push_back(one);
                if (started == Start::done) progress_.one_done(true);
            }
            siginfo_t heard{};
            if (const int signal = ::sigtimedwait(&blocked.set(), &heard, &poll); signal > 0 && signal != SIGCHLD)
                stop(signal);
            reap();
            end_late_ones();
            if (left.empty() && children_.empty())
                std::swap(left, elsewhere); // done by now, or given up by the other process
        }
    } catch (...) {
        stop_all(SIGTERM);
        throw;
    }
    progress_.end();
    std::vector<Outcome> outcomes;
    for (const auto& one : cases) outcomes.push_back(folder_.outcome(one).value_or(Outcome{}));
    return outcomes;
}

} // namespace kaya
