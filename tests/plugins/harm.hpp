// What a foreign model can do to the program that calls it, by name; tests/plugins/harms says what the program has to say to each.
// The environment chooses: KAYA_HARM=MOMENT:NAME.
#pragma once

#include <atomic>
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
#include <pthread.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace harm {

/// The name of the harm that is chosen for a moment, or nothing.
inline std::string_view chosen(std::string_view moment) {
    const char* order = std::getenv("KAYA_HARM");
    if (order == nullptr) return {};
    const std::string_view text(order);
    const auto colon = text.find(':');
    return text.substr(0, colon) == moment ? text.substr(colon + 1) : std::string_view{};
}

// The compiler must not see that these have no end, or no address.
[[gnu::noinline]] inline int deeper(volatile int* depth) {
    volatile char room[4096];
    *depth = *depth + 1;
    room[0] = static_cast<char>(*depth);
    return *depth > 0 ? deeper(depth) + room[0] : 0;
}
[[gnu::noinline]] inline void write_nowhere() {
    volatile int zero = 0;
    *reinterpret_cast<volatile int*>(static_cast<std::size_t>(zero) + 16) = 1;
}
inline void loop() {
    for (volatile double again = 1; again > 0;) again = 1;
}
inline void replace_program(const char* file) {
    char* const arguments[] = {const_cast<char*>(file), nullptr};
    ::execv(file, arguments);
}
/// A program that no folder holds.
inline void replace_program_from_memory() {
    const int memory = ::memfd_create("harm", 0);
    const int program = ::open("/bin/true", O_RDONLY);
    char bytes[65536];
    for (ssize_t n = 0; (n = ::read(program, bytes, sizeof bytes)) > 0;)
        if (::write(memory, bytes, static_cast<std::size_t>(n)) != n) return;
    char* const arguments[] = {const_cast<char*>("true"), nullptr};
    ::fexecve(memory, arguments, environ);
}
inline void vfork_and_exit() {
    if (::vfork() == 0) ::_exit(0);
}
inline void fork_and(void (*in_child)()) {
    if (::fork() == 0) in_child();
}
inline void take_memory() {
    for (;;) {
        auto* const more = new char[1 << 24];
        std::memset(more, 1, 1 << 24);
    }
}
inline void use_huge_malloc() {
    auto* const huge = static_cast<volatile char*>(std::malloc(std::size_t{1} << 46));
    huge[0] = 1;
}
inline void leak() { // a little, and never released
    for (int k = 0; k < 64; ++k) static_cast<volatile char*>(std::malloc(1024))[0] = 1;
}
inline void leave_thread() {
    static std::atomic<int> begun = 0;
    if (begun++ == 0) std::thread([] { std::this_thread::sleep_for(std::chrono::seconds(100)); }).detach();
}
inline void crash_in_thread() {
    static std::atomic<int> begun = 0;
    if (begun++ > 0) return;
    std::thread([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        write_nowhere();
    }).detach();
}
inline void fork_once_and_loop() {
    static std::atomic<int> forked = 0;
    if (forked++ == 0 && ::syscall(SYS_fork) == 0) loop();
}
template <class Work> void once_in_thread(Work work) {
    static std::atomic<int> begun = 0;
    if (begun++ == 0) std::thread(work).join();
}
inline void stop_once() {
    static std::atomic<int> stopped = 0;
    if (stopped++ == 0) ::raise(SIGSTOP);
}
inline void limit(__rlimit_resource what, rlim_t to) {
    rlimit now{};
    ::getrlimit(what, &now);
    now.rlim_cur = to;
    ::setrlimit(what, &now);
}
inline void time_out(__itimer_which which) {
    const itimerval timer{{0, 0}, {5, 0}};
    ::setitimer(which, &timer, nullptr);
}
inline void cut_small_numbers() {
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#else
    std::fesetround(FE_UPWARD);
#endif
}
struct Odd {
    int number;
};

struct Harm {
    const char* name;
    void (*act)();
};

// clang-format off
inline constexpr Harm harms[] = {
    {"exit", [] { std::exit(0); }},
    {"exit-7", [] { std::exit(7); }},
    {"quick-exit", [] { std::quick_exit(0); }},
    {"underscore-exit", [] { ::_exit(0); }},
    {"exit-group", [] { ::syscall(SYS_exit_group, 0); }},
    {"exit-group-5", [] { ::syscall(SYS_exit_group, 5); }},
    {"pthread-exit", [] { ::pthread_exit(nullptr); }},
    {"abort", [] { std::abort(); }},
    {"terminate", [] { std::terminate(); }},
    {"trap", [] { __builtin_trap(); }},
    {"exec", [] { replace_program("/bin/true"); }},
    {"exec-memory", [] { replace_program_from_memory(); }},
    {"fork", [] { fork_and([] {}); }},
    {"fork-call", [] { ::syscall(SYS_fork); }},
    {"fork-call-loop", [] { fork_once_and_loop(); }},
    {"vfork-exit", [] { vfork_and_exit(); }},
    {"fork-exit", [] { fork_and([] { std::exit(0); }); }},
    {"fork-crash", [] { fork_and([] { write_nowhere(); }); }},
    {"fork-loop", [] { fork_and(loop); }},
    {"kill-9", [] { ::kill(::getpid(), SIGKILL); }},
    {"kill-group", [] { ::kill(0, SIGKILL); }},
    {"kill-parent", [] { ::kill(::getppid(), SIGKILL); }},
    {"stop", [] { stop_once(); }},
    {"kill-15", [] { ::kill(::getpid(), SIGTERM); }},
    {"kill-11", [] { ::kill(::getpid(), SIGSEGV); }},
    {"kill-10", [] { ::raise(SIGUSR1); }},
    {"kill-14", [] { std::signal(SIGALRM, SIG_DFL); ::raise(SIGALRM); }},
    {"ends-as-asked", [] { std::signal(SIGTERM, SIG_DFL); ::raise(SIGTERM); }},
    {"null-write", [] { write_nowhere(); }},
    {"stack", [] { volatile int depth = 0; deeper(&depth); }},
    {"divide", [] { volatile int zero = 0; zero = 100 / zero; }},
    {"throw-number", [] { throw 7; }},
    {"throw-null", [] { throw nullptr; }},
    {"throw-struct", [] { throw Odd{1}; }},
    {"throw-text", [] { throw "a text"; }},
    {"throw-exception", [] { throw std::runtime_error("the wear table is empty"); }},
    {"throw-control", [] { throw std::runtime_error("a \033[31mred\007 word"); }},
    {"loop", [] { loop(); }},
    {"huge-malloc", [] { use_huge_malloc(); }},
    {"take-memory", [] { take_memory(); }},
    {"leak", [] { leak(); }},
    {"close-all", [] { ::syscall(SYS_close_range, 0, ~0u, 0); }},
    {"close-output", [] { ::close(STDOUT_FILENO); }},
    {"close-errors", [] { ::close(STDERR_FILENO); }},
    {"chdir", [] { static_cast<void>(::chdir("/") == 0); }},
    {"umask", [] { ::umask(0777); }},
    {"locale", [] { std::setlocale(LC_ALL, std::setlocale(LC_ALL, "C.UTF-8") ? "C.UTF-8" : "POSIX"); }},
    {"round", [] { std::fesetround(FE_UPWARD); }},
    {"cut-small", [] { cut_small_numbers(); }},
    {"trap-arithmetic", [] { ::feenableexcept(FE_DIVBYZERO); }},
    {"ignore-interrupt", [] { std::signal(SIGINT, SIG_IGN); }},
    {"handle-crashes", [] { std::signal(SIGSEGV, [](int) {}); }},
    {"block-signals", [] { sigset_t all; ::sigfillset(&all); ::sigprocmask(SIG_BLOCK, &all, nullptr); }},
    {"alarm", [] { ::alarm(5); }},
    {"timer", [] { time_out(ITIMER_PROF); }},
    {"orphan", [] { ::prctl(PR_SET_PDEATHSIG, 0); }},
    {"limit-files", [] { limit(RLIMIT_FSIZE, 100); }},
    {"limit-open", [] { limit(RLIMIT_NOFILE, 5); }},
    {"nice", [] { ::setpriority(PRIO_PROCESS, 0, 19); }},
    {"thread", [] { leave_thread(); }},
    {"thread-exit", [] { once_in_thread([] { std::exit(0); }); }},
    {"thread-quick-exit", [] { once_in_thread([] { std::quick_exit(0); }); }},
    {"thread-exit-group", [] { once_in_thread([] { ::syscall(SYS_exit_group, 0); }); }},
    {"thread-throw", [] { once_in_thread([] { throw std::runtime_error("in a thread"); }); }},
    {"thread-crash", [] { crash_in_thread(); }},
};
// clang-format on

/// Does what is chosen for the moment, if it is one of these.
inline void at(std::string_view moment) {
    const auto name = chosen(moment);
    if (name.empty()) return;
    for (const Harm& each : harms)
        if (each.name == name) return each.act();
}

/// When it is unloaded, and when it is loaded.
struct Life {
    Life() { at("load"); }
    ~Life() { at("unload"); }
};

} // namespace harm
