#include "laws/crash_report.hpp"

#include "base/diagnostic.hpp"
#include "base/terminal_text.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <mutex>
#include <tuple>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" const char __executable_start, etext; // linker symbols: the range of the program's code

namespace kaya {

/// Data that the signal handler may read.
struct CrashReport {
    using Call = AtWork::Call;
};

namespace {

thread_local const CrashReport::Call* volatile at_work = nullptr; // a signal arrives in the thread that caused it
std::atomic<bool> reporting = false;
std::atomic<void (*)()> act_before_end = nullptr;

std::atomic<const AtCommand*> at_command = nullptr;

/// The call of a foreign model that began last, in any thread.
std::atomic<const Called*> called_last = nullptr;
std::atomic<const char*> last_work = nullptr;

/// The present call of a thread, visible to other threads.
struct alignas(64) Desk {
    std::atomic<bool> taken = false;
    std::atomic<const Called*> who = nullptr;
    std::atomic<const char*> what = nullptr;
};
Desk desks[256];

/// The desk of this thread; none where there are more threads than desks.
struct DeskLease {
    Desk* desk = nullptr;
    DeskLease() {
        for (Desk& each : desks) {
            bool free = false;
            if (!each.taken.compare_exchange_strong(free, true)) continue;
            desk = &each;
            return;
        }
    }
    ~DeskLease() {
        if (desk == nullptr) return;
        desk->who = nullptr;
        desk->taken = false;
    }
};

Desk* own_desk() {
    thread_local const DeskLease lease;
    return lease.desk;
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

/// Whether a library is in one of the program's folders: next to the program or where it is installed.
bool ships(const std::string& file) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path(),
                   folder = fs::weakly_canonical(file, ignored).parent_path();
    for (const fs::path& own : {program, program.parent_path() / "lib/kaya"})
        for (const char* kind : {"joints", "zones"})
            if (folder == own / kind) return true;
    return false;
}

/// A sentence in a fixed buffer: a signal handler may neither allocate nor print.
class Sentence {
public:
    Sentence& operator<<(const char* text) {
        std::string_view rest = text == nullptr ? "" : text;
        while (!rest.empty()) {
            const auto character = first_for_terminal(rest);
            if (length_ + character.size > sizeof text_) break;
            std::copy_n(character.bytes, character.size, text_ + length_);
            length_ += character.size;
            rest.remove_prefix(character.taken);
        }
        return *this;
    }
    Sentence& operator<<(long number) {
        char digits[24];
        std::size_t at = sizeof digits;
        digits[--at] = '\0';
        const bool negative = number < 0;
        unsigned long rest = negative ? 0ul - static_cast<unsigned long>(number) : static_cast<unsigned long>(number);
        do {
            digits[--at] = static_cast<char>('0' + rest % 10);
            rest /= 10;
        } while (rest > 0);
        if (negative) digits[--at] = '-';
        return *this << digits + at;
    }
    void write() const {
        std::size_t done = 0;
        while (done < length_) {
            const ssize_t n = ::write(STDERR_FILENO, text_ + done, length_ - done);
            if (n <= 0) return;
            done += static_cast<std::size_t>(n);
        }
    }

private:
    char text_[1024];
    std::size_t length_ = 0;
};

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
    if (const AtCommand* command = at_command.load()) sentence << "\n  the command: " << command->text();
}

constexpr const char* what_is_left = "\n  the program ends here; files that were saved before are whole\n";

void report(int signal, siginfo_t* info, void*) {
    // Restores the default first: a second crash, here or later, ends the program.
    std::signal(signal, SIG_DFL);
    const char* deed = deed_of(signal, info->si_code);
    Sentence sentence;
    if (const CrashReport::Call* call = at_work) {
        sentence << "\nerror: " << call->who->noun << " '" << call->who->name.c_str() << "' crashed in " << call->what;
        add_place(sentence, call->rows);
        sentence << ": it" << deed << "\n  its library: " << call->who->file.c_str();
        add_command(sentence);
    } else if (const Called* last = called_last.load()) {
        sentence << "\nerror: the program" << deed << "; called last was " << last->noun << " '" << last->name.c_str()
                 << "', in " << last_work.load() << "\n  its library: " << last->file.c_str();
        add_command(sentence);
        sentence
            << "\n  a model that writes past its columns, or continues in another thread, does harm after its call; 'kaya jtest' looks for that";
    } else {
        sentence << "\nerror: the program" << deed;
        add_command(sentence);
        sentence << "\n  this is an error of kaya: please report it with the input";
    }
    sentence << what_is_left;
    sentence.write();
    last_act();
    raise(signal);
}

[[noreturn]] void leave(int status) {
    for (;;) ::syscall(SYS_exit_group, status);
}

/// exit() runs this in the thread that called it, and so do _exit() and _Exit() of a library.
void refuse_exit() {
    const CrashReport::Call* call = at_work;
    if (call == nullptr) return;
    Sentence sentence;
    sentence << "\nerror: " << call->who->noun << " '" << call->who->name.c_str() << "' ended the program by exit() in "
             << call->what;
    add_place(sentence, call->rows);
    sentence << "\n  its library: " << call->who->file.c_str()
             << "\n  a model that fails returns the row and writes a sentence to batch->message" << what_is_left;
    if (::ftrylockfile(stdout) == 0) ::fflush_unlocked(stdout);
    sentence.write();
    last_act();
    leave(static_cast<int>(Fault::run));
}

/// Whether a function that is called from there belongs to the program and not to a library.
bool is_own(const void* place) { return place >= &__executable_start && place < &etext; }

/// The models that are at work in all threads, each once; false when there are none.
bool add_models_at_work(Sentence& sentence) {
    const Called* said[std::size(desks)];
    std::size_t count = 0;
    for (const Desk& desk : desks) {
        const Called* who = desk.who.load();
        if (who == nullptr) continue;
        bool again = false;
        for (std::size_t k = 0; k < count; ++k) again = again || said[k] == who;
        if (again) continue;
        said[count++] = who;
        sentence << (count > 1 ? ", " : "") << who->noun << " '" << who->name.c_str() << "' (" << desk.what.load()
                 << " of " << who->file.c_str() << ")";
    }
    return count > 0;
}

} // namespace

const Called* called(const std::string& name, const std::string& file, const char* noun) {
    static std::mutex lock;
    static auto* const all =
        new std::map<std::tuple<std::string, std::string, std::string>, Called>; // outlives all exits
    const std::lock_guard guard(lock);
    const auto known = all->find({name, file, noun});
    if (known != all->end()) return &known->second;
    return &all->try_emplace({name, file, noun}, Called{name, file, noun, !ships(file)}).first->second;
}

void end_at_once(int signal) {
    std::signal(signal, SIG_DFL);
    Sentence sentence;
    sentence << "\nstopped in ";
    if (add_models_at_work(sentence)) {
        sentence << "\n";
        sentence.write();
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
    std::atexit(refuse_exit);
    keep_spare_stack();
}

AtCommand::AtCommand(std::string_view text) : before_(at_command) {
    std::size_t length = 0;
    for (; length < text.size() && length + 1 < sizeof text_; ++length) {
        const auto letter = static_cast<unsigned char>(text[length]);
        text_[length] = letter < ' ' || letter == 0x7f ? '?' : text[length];
    }
    text_[length] = '\0';
    at_command = this;
}

AtCommand::~AtCommand() { at_command = before_; }

AtWork::AtWork(const Called* who, const char* what, const AtRows& rows) : call_{who, what, rows}, before_(at_work) {
    if (reporting.load(std::memory_order_relaxed)) keep_spare_stack();
    at_work = &call_;
    if (who->foreign) {
        called_last.store(who, std::memory_order_relaxed);
        last_work.store(what, std::memory_order_relaxed);
    }
    if (Desk* desk = own_desk()) {
        desk->what.store(what, std::memory_order_relaxed);
        desk->who.store(who, std::memory_order_release);
    }
}

AtWork::~AtWork() {
    at_work = before_;
    if (Desk* desk = own_desk()) desk->who.store(before_ ? before_->who : nullptr, std::memory_order_relaxed);
}

void end_by_exit(const void* caller, int status) {
    if (!is_own(caller)) refuse_exit();
    leave(status);
}

} // namespace kaya

// These functions of the program take precedence over those of the C library for all loaded libraries. Otherwise a joint model that calls
// them would end a run without a message and with status 0. Exit handlers do not run at such an exit, so nothing else is lost.
extern "C" {
[[noreturn]] void _exit(int status) { kaya::end_by_exit(__builtin_return_address(0), status); }
[[noreturn]] void _Exit(int status) { kaya::end_by_exit(__builtin_return_address(0), status); }
}
