#include "joints/crash_report.hpp"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <unistd.h>

namespace kaya {

/// What the signal handler may look at.
struct CrashReport {
    using Call = AtWork::Call;
};

namespace {

thread_local const CrashReport::Call* volatile at_work = nullptr;
std::atomic<bool> reporting = false;

/// A stack for the handler, in case that the thread's own is full. It goes with the thread.
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

/// A sentence in a fixed buffer: a signal handler may neither allocate nor print.
class Sentence {
public:
    Sentence& operator<<(const char* text) {
        for (; text && *text && length_ < sizeof text_; ++text) text_[length_++] = *text;
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

const char* name_of(int signal) {
    switch (signal) {
    case SIGSEGV: return "it used memory that is not its own (SIGSEGV)";
    case SIGBUS: return "it used memory that is not there (SIGBUS)";
    case SIGFPE: return "it divided a whole number by zero (SIGFPE)";
    case SIGILL: return "it met an instruction that this machine does not have (SIGILL)";
    default: return "it gave up (SIGABRT)";
    }
}

/// Where in the batch: a model that works row by row says so, of others only the ends are known.
void add_place(Sentence& sentence, const kaya_jbatch& batch, const std::int32_t* numbers) {
    const auto number = [numbers](std::size_t row) {
        return numbers ? static_cast<long>(numbers[row]) : static_cast<long>(row);
    };
    const char* what = numbers ? "sub-contact " : "row ";
    if (batch.n == 0) return;
    if (batch.row < batch.n)
        sentence << ", at " << what << number(batch.row);
    else
        sentence << ", between " << what << number(0) << " and " << what << number(batch.n - 1);
}

void report(int signal) {
    // The old meaning comes back first: a second crash, in here or after it, ends the program.
    std::signal(signal, SIG_DFL);
    if (const CrashReport::Call* call = at_work) {
        Sentence sentence;
        sentence << "\nerror: " << call->noun << " '" << call->model << "' crashed in " << call->what;
        if (call->batch) add_place(sentence, *call->batch, call->numbers);
        sentence << ": " << name_of(signal) << "\n  its library: " << call->file
                 << "\n  the program ends here; files that were saved before are whole\n";
        sentence.write();
    }
    raise(signal);
}

} // namespace

void report_crashes() {
    if (reporting.exchange(true)) return;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        struct sigaction action {};
        action.sa_handler = report;
        action.sa_flags = SA_ONSTACK | SA_NODEFER;
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
}

AtWork::AtWork(const char* model, const char* file, const char* what, const kaya_jbatch* batch,
               const std::int32_t* numbers, const char* noun)
    : call_{model, file, what, batch, numbers, noun}, before_(at_work) {
    if (reporting.load(std::memory_order_relaxed)) {
        thread_local SpareStack spare;
        static_cast<void>(spare);
    }
    at_work = &call_;
}

AtWork::~AtWork() { at_work = before_; }

} // namespace kaya
