#include "system/process_state.hpp"

#include "base/diagnostic.hpp"
#include "system/crash_report.hpp"
#include "system/door.hpp"
#include "system/run_copies.hpp"

#include <array>
#include <clocale>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

namespace kaya {

namespace {

constexpr int last_signal = 31;
constexpr int first_spare = 64; ///< file descriptors; lower ones are for who opens files

/// Which file a descriptor stands for.
struct Identity {
    dev_t device = 0;
    ino_t file = 0;
    bool is_open = false;
    bool operator==(const Identity&) const = default;
};

Identity identity_of(int stream) {
    struct stat info {};
    if (::fstat(stream, &info) != 0) return {};
    return {info.st_dev, info.st_ino, true};
}

std::string folder() {
    std::error_code gone;
    return std::filesystem::current_path(gone).string();
}

void* handler_of(const struct sigaction& action) {
    return action.sa_flags & SA_SIGINFO ? reinterpret_cast<void*>(action.sa_sigaction)
                                        : reinterpret_cast<void*>(action.sa_handler);
}

/// The program uses it to limit the time until a stop is noticed.
bool is_own_timer(int which, const itimerval& timer) {
    return which == ITIMER_REAL && timer.it_interval.tv_sec == 0 && timer.it_interval.tv_usec == 0 &&
           timer.it_value.tv_sec == 0;
}

struct State {
    pid_t process = ::getpid();
    std::string folder = kaya::folder();
    mode_t mask = 0;
    std::string locale = std::setlocale(LC_ALL, nullptr);
    std::array<Identity, 3> streams;
    std::array<int, 3> spares{};
    std::array<struct sigaction, last_signal + 1> signals{};
    sigset_t blocked{};
    std::array<rlimit, RLIM_NLIMITS> limits{};
    int priority = ::getpriority(PRIO_PROCESS, 0);
    int dumpable = ::prctl(PR_GET_DUMPABLE);
    int death = 0; ///< the signal that comes when the process that waits is gone

    State() {
        mask = ::umask(0);
        ::umask(mask);
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            streams[i] = identity_of(k);
            spares[i] = ::fcntl(k, F_DUPFD_CLOEXEC, first_spare);
        }
        for (int k = 1; k <= last_signal; ++k) ::sigaction(k, nullptr, &signals[static_cast<std::size_t>(k)]);
        ::sigprocmask(SIG_BLOCK, nullptr, &blocked);
        for (int k = 0; k < RLIM_NLIMITS; ++k)
            ::getrlimit(static_cast<__rlimit_resource>(k), &limits[static_cast<std::size_t>(k)]);
        ::prctl(PR_GET_PDEATHSIG, &death);
    }
    ~State() {
        for (const int spare : spares) ::close(spare);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

/// These return true when the state was changed; it is restored.
bool put_folder_back(State& was) { return folder() != was.folder && door::enter(was.folder); }

bool put_mask_back(State& was) { return ::umask(was.mask) != was.mask; }

bool put_locale_back(State& was) {
    if (was.locale == std::setlocale(LC_ALL, nullptr)) return false;
    std::setlocale(LC_ALL, was.locale.c_str());
    return true;
}

bool put_streams_back(State& was) {
    bool changed = false;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (identity_of(k) == was.streams[i] || !was.streams[i].is_open) continue;
        changed = true;
        if (identity_of(was.spares[i]) == was.streams[i]) ::dup2(was.spares[i], k);
    }
    return changed;
}

bool put_signals_back(State& was) {
    bool changed = false;
    for (int k = 1; k <= last_signal; ++k) {
        auto& before = was.signals[static_cast<std::size_t>(k)];
        struct sigaction now {};
        if (::sigaction(k, nullptr, &now) != 0 || handler_of(now) == handler_of(before)) continue;
        if (is_own_code(handler_of(now))) {
            before = now; // the program's own change
            continue;
        }
        ::sigaction(k, &before, nullptr);
        changed = true;
    }
    return changed;
}

bool put_blocked_back(State& was) {
    sigset_t now{};
    ::sigprocmask(SIG_BLOCK, nullptr, &now);
    bool changed = false;
    for (int k = 1; k <= last_signal; ++k)
        changed = changed || ::sigismember(&now, k) != ::sigismember(&was.blocked, k);
    if (changed) ::sigprocmask(SIG_SETMASK, &was.blocked, nullptr);
    return changed;
}

bool stop_timers(State&) {
    bool changed = false;
    for (const int which : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) {
        itimerval now{};
        const itimerval none{};
        ::getitimer(static_cast<__itimer_which>(which), &now);
        if ((now.it_value.tv_sec == 0 && now.it_value.tv_usec == 0) || is_own_timer(which, now)) continue;
        ::setitimer(static_cast<__itimer_which>(which), &none, nullptr);
        changed = true;
    }
    return changed;
}

bool put_limits_back(State& was) {
    bool changed = false;
    for (int k = 0; k < RLIM_NLIMITS; ++k) {
        const auto resource = static_cast<__rlimit_resource>(k);
        const rlimit& before = was.limits[static_cast<std::size_t>(k)];
        rlimit now{};
        ::getrlimit(resource, &now);
        if (now.rlim_cur == before.rlim_cur && now.rlim_max == before.rlim_max) continue;
        changed = true;
        if (::setrlimit(resource, &before) == 0) continue;
        now.rlim_cur = now.rlim_max; // as far as it can be
        ::setrlimit(resource, &now);
    }
    return changed;
}

bool put_priority_back(State& was) {
    if (::getpriority(PRIO_PROCESS, 0) == was.priority) return false;
    was.priority = ::setpriority(PRIO_PROCESS, 0, was.priority) == 0 ? was.priority : ::getpriority(PRIO_PROCESS, 0);
    return true;
}

bool put_process_back(State& was) {
    int death = 0;
    ::prctl(PR_GET_PDEATHSIG, &death);
    if (death == was.death && ::prctl(PR_GET_DUMPABLE) == was.dumpable) return false;
    ::prctl(PR_SET_PDEATHSIG, was.death);
    ::prctl(PR_SET_DUMPABLE, was.dumpable);
    return true;
}

constexpr struct {
    const char* what;
    bool (*put_back)(State&);
} parts[] = {
    {"the working folder", put_folder_back},
    {"the rights of new files (umask)", put_mask_back},
    {"the language of numbers and texts (setlocale)", put_locale_back},
    {"the standard streams", put_streams_back},
    {"what is done when a signal comes", put_signals_back},
    {"which signals are blocked", put_blocked_back},
    {"timers of the process", stop_timers},
    {"limits of the process (setrlimit)", put_limits_back},
    {"the priority of the process", put_priority_back},
    {"how the process ends and can be looked at (prctl)", put_process_back},
};

std::optional<State> state;

/// The state of this process: a forked process with separate work has other streams.
State& taken() {
    if (!state || state->process != ::getpid()) state.emplace();
    return *state;
}

} // namespace

void take_process_state() { taken(); }

void forget_process_state() { state.reset(); }

std::vector<std::string> put_process_state_back(std::string& who) {
    who = take_suspects();
    std::vector<std::string> changed;
    if (who.empty()) return changed;
    State& was = taken();
    for (const auto& part : parts)
        if (part.put_back(was)) changed.emplace_back(part.what);
    for (std::size_t k = 0; k < was.streams.size(); ++k) {
        if (identity_of(static_cast<int>(k)) == was.streams[k] || !was.streams[k].is_open) continue;
        note_reason(fmt::format("{} closed the standard streams", who));
        leave(static_cast<int>(Fault::run)); // the process that waits can print it
    }
    return changed;
}

} // namespace kaya
