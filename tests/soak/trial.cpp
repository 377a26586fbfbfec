#include "trial.hpp"

#include "tests/unit/scratch_folder.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <fmt/format.h>
#include <poll.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya::soak {

namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool reserves_all_memory = true;
#else
constexpr bool reserves_all_memory = false;
#endif

void limit(int what, rlim_t most) {
    const rlimit limit{most, most};
    ::setrlimit(static_cast<__rlimit_resource>(what), &limit);
}

/// The work of the child process; it never returns.
[[noreturn]] void work_alone(const Case& one, const fs::path& folder, const fs::path& said, const Limits& limits,
                             const Work& work) {
    ::setpgid(0, 0);
    std::signal(SIGINT, SIG_DFL); // a shell's background jobs ignore it
    const int nothing = ::open("/dev/null", O_RDONLY),
              out = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (nothing < 0 || out < 0 || ::chdir(folder.c_str()) != 0) std::_Exit(99);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 64 << 20);
    if (!reserves_all_memory) limit(RLIMIT_AS, static_cast<rlim_t>(limits.megabytes) << 20);
    std::exit(work(one.words));
}

/// Of its threads, not of its child processes.
double processor_seconds(pid_t process) {
    clockid_t clock{};
    timespec used{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// The process that does the work: the program that is started waits for one that does.
pid_t worker_of(pid_t child) {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", child));
    pid_t worker = 0;
    return children >> worker ? worker : child;
}

std::string what_it_said(const fs::path& said) {
    std::string text = test::content_of(said);
    constexpr std::size_t enough = 1 << 18;
    if (text.size() > enough) text.erase(enough / 2, text.size() - enough);
    return text;
}

std::string finding(int status, const fs::path& said) {
    if (WIFSIGNALED(status))
        return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    const int code = WEXITSTATUS(status);
    if (code > 2) return fmt::format("status {}", code);
    const std::string text = what_it_said(said);
    for (const char* fault : {"internal error:", "Sanitizer", ": runtime error:", "terminate called", "Assertion"})
        if (text.find(fault) != std::string::npos) return fmt::format("it said '{}'", fault);
    return {};
}

} // namespace

Verdict trial(const Case& one, const fs::path& folder, const fs::path& said, const Limits& limits, const Work& work) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const File& file : one.files) test::put((folder / file.name).string(), file.bytes);
    std::fflush(nullptr);
    const auto began = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    };
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process can be started");
    if (child == 0) work_alone(one, folder, said, limits, work);
    ::setpgid(child, child); // in parent and child, whichever runs first
    const int handle = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
    if (handle < 0) throw std::runtime_error("this kernel has no pidfd_open");
    Verdict verdict;
    constexpr double idle =
        30; // times the limit: a waiting process uses no processor time, and the machine may be busy
    for (pollfd ended{handle, POLLIN, 0}; ::poll(&ended, 1, 50) == 0;) {
        const double used = std::max(processor_seconds(limits.waits ? worker_of(child) : child), elapsed() / idle);
        if (used > limits.seconds) {
            verdict.finding = fmt::format("a hang: not over after {:.0f} s", elapsed());
            ::kill(-child, SIGKILL);
        } else if (used > limits.asked_after && !verdict.was_asked) {
            verdict.was_asked = true;
            ::kill(-child, SIGINT);
        }
    }
    ::close(handle);
    ::kill(-child, SIGKILL); // its child processes; the number is valid until it is waited for
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    verdict.seconds = elapsed();
    verdict.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const bool obeyed = verdict.was_asked && verdict.status == 128 + SIGINT;
    if (verdict.finding.empty() && !obeyed) verdict.finding = finding(status, said);
    return verdict;
}

} // namespace kaya::soak
