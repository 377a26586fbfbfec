#include "app/parent.hpp"

#include "base/ask_again.hpp"
#include "system/door.hpp"
#include "system/ending.hpp"
#include "system/run_copies.hpp"
#include "system/run_record.hpp"

#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace kaya {

namespace {

/// A debugger, or a tracer of system calls, would look at the wrong process.
bool is_traced() {
    std::istringstream status(door::system_text("/proc/self/status"));
    std::string word, number;
    while (status >> word)
        if (word == "TracerPid:") return status >> number && number != "0";
    return false;
}

/// The terminal sends such a signal to the whole process group.
bool comes_from_terminal(const siginfo_t& info) {
    const int signal = info.si_signo;
    return info.si_code == SI_KERNEL && (signal == SIGINT || signal == SIGQUIT || signal == SIGTSTP ||
                                         signal == SIGTTIN || signal == SIGTTOU || signal == SIGWINCH);
}

/// The default action of a signal, on this process.
void suffer(int signal) {
    std::signal(signal, SIG_DFL);
    sigset_t one;
    ::sigemptyset(&one);
    ::sigaddset(&one, signal);
    ::raise(signal);
    ::sigprocmask(SIG_UNBLOCK, &one, nullptr);
    ::sigprocmask(SIG_BLOCK, &one, nullptr); // it was stopped and is continued
}

/// A stop now would take a request to continue away that came after the run was stopped.
bool is_to_continue() {
    sigset_t pending;
    ::sigpending(&pending);
    return ::sigismember(&pending, SIGCONT) == 1;
}

bool is_copy_of_run(pid_t process) {
    namespace fs = std::filesystem;
    const std::string folder = fmt::format("/proc/{}", process);
    std::error_code ignored;
    return fs::read_symlink(folder + "/exe", ignored) == fs::read_symlink("/proc/self/exe", ignored) &&
           door::system_text((folder + "/cmdline").c_str()) == door::system_text("/proc/self/cmdline");
}

/// Copies of the run that a foreign model left behind: this process adopts orphans.
std::vector<pid_t> left_copies() {
    std::vector<pid_t> copies;
    std::istringstream children(door::system_text(fmt::format("/proc/self/task/{}/children", ::getpid()).c_str()));
    for (pid_t process = 0; children >> process;)
        if (is_copy_of_run(process)) copies.push_back(process);
    return copies;
}

/// Whether no orphan is left. Reaps those that have ended.
bool are_orphans_gone() {
    pid_t ended = 0;
    do ended = ::waitpid(-1, nullptr, WNOHANG);
    while (ended > 0);
    return ended < 0;
}

/// Ends copies that are left. Orphans that are about to end get a moment, such as the process that waits to become the painter. Returns whether
/// a copy was left.
bool end_left_copies() {
    if (run_record().called_last == nullptr || ask_again(are_orphans_gone)) return false;
    bool found = false;
    for (auto copies = left_copies(); !copies.empty(); copies = left_copies())
        for (const pid_t process : copies) {
            found = true;
            ::kill(process, SIGKILL);
            ::waitpid(process, nullptr, 0);
        }
    return found;
}

/// The wait status of the run's end. All signals must be blocked.
int wait_for(pid_t run, const sigset_t& all) {
    for (;;) {
        siginfo_t heard{};
        const int signal = ::sigwaitinfo(&all, &heard);
        if (signal < 0) continue;
        if (signal != SIGCHLD) {
            if (!comes_from_terminal(heard)) ::kill(run, signal);
            continue;
        }
        int status = 0;
        while (::waitpid(run, &status, WNOHANG | WUNTRACED) == run) {
            if (!WIFSTOPPED(status)) return status;
            tell_stop(WSTOPSIG(status));
            if (!is_to_continue()) suffer(WSTOPSIG(status));
        }
    }
}

[[noreturn]] void end_as(const Ending& end) {
    if (end.signal != 0) {
        const rlimit none{0, 0}; // the run's own memory is in its core
        ::setrlimit(RLIMIT_CORE, &none);
        suffer(end.signal);
    }
    constexpr int ended_by_signal = 128; // the first process of a container cannot be ended by one
    leave(end.signal != 0 ? ended_by_signal + end.signal : end.status);
}

} // namespace

int run_in_child(const std::function<int()>& work) {
    run_record();                  // before there are two processes
    std::signal(SIGCHLD, SIG_DFL); // ignored, it would take the status away
    if (is_traced()) return work();
    sigset_t all, before;
    ::sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, &before);
    const pid_t parent = ::getpid(), run = ::fork();
    if (run > 0) {
        ::prctl(PR_SET_CHILD_SUBREAPER, 1);
        const int status = wait_for(run, all);
        if (end_left_copies() && status == 0)
            note_reason("a second process of the run was left behind: a model called fork(); it was ended");
        end_as(tell_ending(status));
    }
    if (run == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) leave(1);
        run_record().process = ::getpid();
    }
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    return work();
}

} // namespace kaya
