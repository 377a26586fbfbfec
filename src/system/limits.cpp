#include "system/limits.hpp"

#include "base/diagnostic.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

namespace kaya {

namespace {

constexpr rlim_t least_stack = 1 << 20, usual_stack = 8 << 20;
constexpr std::size_t least_files = 64; ///< besides those that are open: half of them for --watch
constexpr rlim_t usual_files = 1024;

/// To `usual` where the limit is lower, or as far as it goes.
rlimit raised(__rlimit_resource what, rlim_t usual) {
    rlimit limit{};
    ::getrlimit(what, &limit);
    if (limit.rlim_cur < usual) {
        limit.rlim_cur = std::min(usual, limit.rlim_max);
        ::setrlimit(what, &limit);
        ::getrlimit(what, &limit);
    }
    return limit;
}

void require_stack() {
    rlimit before{};
    ::getrlimit(RLIMIT_STACK, &before);
    if (before.rlim_cur >= least_stack) return;
    const rlim_t got = raised(RLIMIT_STACK, usual_stack).rlim_cur;
    if (got < least_stack)
        throw Diagnostic(
            fmt::format("the stack is limited to {} kB, and kaya needs {} kB", got / 1024, least_stack / 1024),
            "raise the limit in the shell, and start kaya again: ulimit -s 8192", Fault::run);
    // Threads have what the limit was when the program was loaded.
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, got);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
}

/// 0 when so many files can be opened besides those that are; else the reason.
int why_no_files() {
    std::array<Descriptor, least_files> opened;
    for (auto& one : opened) {
        one = door::null_device();
        if (!one) return errno == EMFILE || errno == ENFILE ? errno : 0; // otherwise there is no /dev/null here
    }
    return 0;
}

void require_files() {
    const int reason = why_no_files();
    if (reason == 0) return;
    const rlim_t got = raised(RLIMIT_NOFILE, usual_files).rlim_cur;
    const int still = why_no_files();
    if (still == ENFILE)
        throw Diagnostic("too many open files: the whole system has no more",
                         "end programs that hold many, and start kaya again", Fault::run);
    if (still == EMFILE)
        throw Diagnostic(
            fmt::format(
                "too many open files: a program may have {} here, and kaya needs {} besides those that are open", got,
                least_files),
            "raise the limit in the shell, and start kaya again: ulimit -n 1024", Fault::run);
}

} // namespace

void require_stack_and_files() {
    require_stack();
    require_files();
}

} // namespace kaya
