#include "system/run_copies.hpp"

#include "base/diagnostic.hpp"

#include <atomic>
#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace kaya {

namespace {

std::atomic<pid_t> original = 0;
std::atomic<bool> is_noted = false; ///< in a copy: by the process that called fork()

} // namespace

void begin_original() { original = ::getpid(); }

bool is_copy() { return original != 0 && original != ::getpid(); }

void note_copy(const Called* who, const char* what) {
    RunRecord& record = run_record();
    record.copied_in = what;
    record.copied_by = who;
}

void set_noted() { is_noted = true; }

void end_copy(const Called* who, const char* what) {
    if (!is_noted) note_copy(who, what);
    leave(0);
}

void refuse_copies() {
    RunRecord& record = run_record();
    const Called* who = record.copied_by.exchange(nullptr);
    if (who == nullptr) return;
    Diagnostic error(
        fmt::format("{} '{}' made a second process of the run in {}", who->noun, who->name, record.copied_in.load()),
        fmt::format("a model may not call fork(); the second process was ended. Its library: {}", who->file),
        Fault::run);
    error.code = "joint-model-conduct";
    throw error;
}

void leave(int status) {
    for (;;) ::syscall(SYS_exit_group, status);
}

} // namespace kaya
