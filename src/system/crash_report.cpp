#include "system/crash_report.hpp"

#include "base/diagnostic.hpp"
#include "system/run_copies.hpp"
#include "system/sentence.hpp"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <optional>
#include <pthread.h>
#include <sys/prctl.h>
#include <unistd.h>

// Symbols of the linker: the range of the code of the file, program or library, that contains this.
extern "C" __attribute__((visibility("hidden"))) const char __ehdr_start, etext;

namespace kaya {

/// Data that the signal handler may read.
struct CrashReport {
    using Call = AtWork::Call;
};

namespace {

thread_local const CrashReport::Call* volatile at_work = nullptr; // a signal arrives in the thread that caused it
std::atomic<bool> reporting = false;
std::atomic<void (*)()> act_before_end = nullptr;

/// The desk of a thread in a record; none where there are more threads than desks. A forked process has a copy of the lease and shares the
/// desk: it leaves it to the process that took it.
struct DeskLease {
    RunRecord::Desk* desk = nullptr;
    explicit DeskLease(RunRecord& record) : record_(record) {
        for (RunRecord::Desk& each : record.desks) {
            bool free = false;
            if (!each.taken.compare_exchange_strong(free, true)) continue;
            desk = &each;
            return;
        }
    }
    ~DeskLease() {
        if (desk == nullptr || ::getpid() != process_) return;
        desk->who = nullptr;
        desk->taken = false;
    }
    bool is_of(const RunRecord& record) const { return &record_ == &record; }

private:
    const RunRecord& record_;
    const pid_t process_ = ::getpid();
};

RunRecord::Desk* own_desk() {
    thread_local std::optional<DeskLease> lease;
    RunRecord& record = run_record();
    if (!lease || !lease->is_of(record)) lease.emplace(record); // a forked process that began another record
    return lease->desk;
}

void sit_down(const Called* who, const char* what) {
    RunRecord::Desk* const desk = own_desk();
    if (desk == nullptr) return;
    if (what != nullptr) desk->what.store(what, std::memory_order_relaxed);
    desk->who.store(who, std::memory_order_release);
}

/// An alternative stack for the handler, in case the thread's own is full. Released with the thread.
struct SpareStack {
    alignas(16) char bytes[32768];
    SpareStack() {
        stack_t stack{};
        stack.ss_sp = bytes;
        stack.ss_size = sizeof bytes;
        sigaltstack(&stack, nullptr);
    }
    ~SpareStack() {
        stack_t none{};
        none.ss_flags = SS_DISABLE;
        sigaltstack(&none, nullptr);
    }
};

/// Once for each thread.
void keep_spare_stack() {
    thread_local const SpareStack spare;
    static_cast<void>(spare);
}

/// Follows "it" or "the program".
const char* deed_of(int signal, int code) {
    switch (signal) {
    case SIGSEGV: return " used memory that is not its own (SIGSEGV)";
    case SIGBUS: return " used memory that is not there (SIGBUS)";
    case SIGFPE:
        return code == FPE_INTDIV ? " divided a whole number by zero (SIGFPE)"
                                  : " asked to be stopped by arithmetic without a result, and met some (SIGFPE)";
    case SIGILL: return " met an instruction that this machine does not have (SIGILL)";
    default: return " gave up (SIGABRT)";
    }
}

/// The row in the batch: reported by models that work row by row; for others only the first and last row are known.
void add_place(Sentence& sentence, const AtRows& at) {
    if (at.rows == 0) return;
    const auto number = [&at](std::size_t row) {
        return at.numbers ? static_cast<long>(at.numbers[row]) : at.first + static_cast<long>(row);
    };
    const char* noun = at.numbers || at.first > 0 ? at.noun : "row";
    if (*at.row < at.rows) sentence << ", at " << noun << " " << number(*at.row);
    else sentence << ", between " << noun << " " << number(0) << " and " << number(at.rows - 1);
}

void add_command(Sentence& sentence) {
    if (run_record().command[0] != '\0') sentence << "\n  the command: " << run_record().command;
}

/// Writes it; the process that waits for the run then prints nothing.
void tell(const Sentence& sentence) {
    if (sentence.write()) run_record().is_told = true;
}

constexpr const char* what_is_left = "\n  the program ends here; files that were saved before are whole\n";

void report(int signal, siginfo_t* info, void*) {
    // Restores the default first: a second crash, here or later, ends the program.
    std::signal(signal, SIG_DFL);
    if (is_copy()) end_copy(run_record().called_last, run_record().last_work);
    const char* deed = deed_of(signal, info->si_code);
    Sentence sentence;
    if (const CrashReport::Call* call = at_work) {
        sentence << "\nerror: " << call->who->noun << " '" << call->who->name << "' crashed in " << call->what;
        add_place(sentence, call->rows);
        sentence << ": it" << deed << "\n  its library: " << call->who->file;
        add_command(sentence);
    } else if (const Called* last = run_record().called_last.load()) {
        sentence << "\nerror: the program" << deed << "; called last was " << last->noun << " '" << last->name
                 << "', in " << run_record().last_work.load() << "\n  its library: " << last->file;
        add_command(sentence);
        sentence
            << "\n  a model that writes past its columns, or continues in another thread, does harm after its call; 'kaya jtest' looks for that";
    } else {
        sentence << "\nerror: the program" << deed;
        add_command(sentence);
        sentence << "\n  this is an error of kaya: please report it with the input";
    }
    sentence << what_is_left;
    tell(sentence);
    last_act();
    raise(signal);
}

/// Runs in the thread that called exit(), _exit() or _Exit(), if a library did.
void refuse_exit() {
    const CrashReport::Call* call = at_work;
    if (call == nullptr) return;
    if (is_copy()) end_copy(call->who, call->what);
    Sentence sentence;
    sentence << "\nerror: " << call->who->noun << " '" << call->who->name << "' ended the program by exit() in "
             << call->what;
    add_place(sentence, call->rows);
    sentence << "\n  its library: " << call->who->file
             << "\n  a model that fails returns the row and writes a sentence to batch->message" << what_is_left;
    if (::ftrylockfile(stdout) == 0) ::fflush_unlocked(stdout);
    tell(sentence);
    last_act();
    leave(static_cast<int>(Fault::run));
}

/// exit() runs this. An end by the program's own code, such as os.exit() of a trusted deck, is valid; an end by a thread that a law has left
/// behind is not.
void at_exit(int status, void*) {
    refuse_exit();
    if (::gettid() == ::getpid()) note_end(status);
}

/// Around fork() of a law; the program forks where none is at work.
void note_fork() {
    if (const CrashReport::Call* call = at_work) note_copy(call->who, call->what);
}
void begin_forked() {
    if (!at_work) return begin_original();
    set_noted();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

} // namespace

bool is_own_code(const void* place) { return place >= &__ehdr_start && place < &etext; }

bool add_models_at_work(Sentence& sentence) {
    const RunRecord& record = run_record();
    const Called* said[RunRecord::most_threads];
    std::size_t count = 0;
    for (const RunRecord::Desk& desk : record.desks) {
        const Called* who = desk.who.load();
        if (who == nullptr) continue;
        bool again = false;
        for (std::size_t k = 0; k < count; ++k) again = again || said[k] == who;
        if (again) continue;
        said[count++] = who;
        sentence << (count > 1 ? ", " : "") << who->noun << " '" << who->name << "' (" << desk.what.load() << " of "
                 << who->file << ")";
    }
    return count > 0;
}

void end_at_once(int signal) {
    std::signal(signal, SIG_DFL);
    Sentence sentence;
    sentence << "\nstopped in ";
    if (add_models_at_work(sentence)) {
        sentence << "\n";
        tell(sentence);
    }
    last_act();
    raise(signal);
}

void set_last_act(void (*act)()) { act_before_end = act; }

void last_act() {
    if (const auto act = act_before_end.load()) act();
}

void tell_whom_it_waits_for() {
    Sentence sentence;
    sentence << "\nwaiting for ";
    if (!add_models_at_work(sentence)) return;
    sentence << ", which does not come back; Ctrl-C again ends the program\n";
    sentence.write();
}

void report_crashes() {
    if (reporting.exchange(true)) return;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        struct sigaction action {};
        action.sa_sigaction = report;
        action.sa_flags = SA_ONSTACK | SA_NODEFER | SA_SIGINFO;
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
    if (std::signal(SIGINT, end_at_once) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
    ::on_exit(at_exit, nullptr);
    keep_spare_stack();
    begin_original();
    ::pthread_atfork(nullptr, note_fork, begin_forked);
}

WaitsFor::WaitsFor(const Called* who, const char* what) { sit_down(who, what); }

WaitsFor::~WaitsFor() { sit_down(nullptr, nullptr); }

AtWork::AtWork(const Called* who, const char* what, const AtRows& rows) : call_{who, what, rows}, before_(at_work) {
    if (reporting.load(std::memory_order_relaxed)) keep_spare_stack();
    at_work = &call_;
    if (who->foreign) {
        RunRecord& record = run_record();
        record.called_last.store(who, std::memory_order_relaxed);
        record.last_work.store(what, std::memory_order_relaxed);
        if (!who->is_suspected.load(std::memory_order_relaxed)) who->is_suspected = true;
    }
    sit_down(who, what);
}

AtWork::~AtWork() {
    if (call_.who->foreign && is_copy()) end_copy(call_.who, call_.what);
    at_work = before_;
    sit_down(before_ ? before_->who : nullptr, before_ ? before_->what : nullptr);
}

void note_thread() {
    if (const CrashReport::Call* call = at_work) call->who->starts_threads = true;
}

void end_by_exit(const void* caller, int status) {
    if (!is_own_code(caller)) refuse_exit();
    else note_end(status);
    leave(status);
}

} // namespace kaya

// These functions of the program take precedence over those of the C library for all loaded libraries. Otherwise a joint model that calls
// them would end a run without a message and with status 0. Exit handlers do not run at such an exit, so nothing else is lost.
extern "C" {
__attribute__((noreturn)) void _exit(int status) { kaya::end_by_exit(__builtin_return_address(0), status); }
__attribute__((noreturn)) void _Exit(int status) { kaya::end_by_exit(__builtin_return_address(0), status); }
__attribute__((noreturn)) void quick_exit(int status) noexcept {
    kaya::end_by_exit(__builtin_return_address(0), status);
}
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they define it, too
// The program cannot check threads that a model leaves behind, so it notes which models start some.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
                              void* argument) {
    using Function = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    static const auto next = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "pthread_create"));
    kaya::note_thread();
    return next(thread, attributes, function, argument);
}
#endif
