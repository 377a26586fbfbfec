// Reports the running command, and the running joint model or zone model, when the program crashes, ends unexpectedly or hangs.
#pragma once

#include "system/run_record.hpp"

#include <cstddef>
#include <cstdint>

namespace kaya {

class Sentence;

/// Installs the reports. A crash (a bad address, a division by zero, abort(), a stack overflow) is reported on the standard error before it
/// ends the program: the command, and the model that runs in the crashed thread with its file, its function and the sub-contact. If none
/// runs there, the foreign model that was called last is named: it may have damaged memory that is used later. A model that calls exit(),
/// _exit() or quick_exit(), ends the program with status 2 and a message. Ctrl-C names the running models. A process
/// that a model forks ends when it returns from the call.
void report_crashes();

/// Whether code at that place belongs to the program and not to a library.
bool is_own_code(const void* place);

/// The program's version of _exit(), _Exit() and quick_exit(): `caller` is the address of the call.
[[noreturn]] void end_by_exit(const void* caller, int status);

/// Notes that the law that is at work in this thread, if there is one, starts a thread.
void note_thread();

/// For a signal handler: ends the program by the signal, after naming the models that are at work.
void end_at_once(int signal);

/// Sets what is called before the program ends inside a command: by a crash, by exit() of a model, by a second Ctrl-C. It runs in a signal
/// handler. Null: nothing.
void set_last_act(void (*act)());
void last_act();

/// For a signal handler: says that the program waits for the models that are at work, if there are any.
void tell_whom_it_waits_for();

/// Adds the laws that are at work in all threads, each once; false when there are none.
bool add_models_at_work(Sentence& sentence);

/// Rows of a batch that a law works on. The law writes its position to `row`; until then the position is unknown.
struct AtRows {
    std::size_t rows = 0;
    const std::size_t* row = nullptr;      ///< of the batch
    const std::int32_t* numbers = nullptr; ///< of the rows that users see; NULL: they follow `first`
    std::int32_t first = 0;                ///< number of the first row; 0: the report gives rows
    const char* noun = "sub-contact";      ///< of a numbered row
};

/// While it lives, this thread waits for a process that tries a law: Ctrl-C names the law.
class WaitsFor {
public:
    WaitsFor(const Called* who, const char* what);
    ~WaitsFor();
    WaitsFor(const WaitsFor&) = delete;
    WaitsFor& operator=(const WaitsFor&) = delete;
};

/// While it lives, a law is at work in this thread. Costs a few stores; nothing is allocated.
class AtWork {
public:
    /// `what` is "run", "initialise", ...; it must outlive all reports, as literals do.
    AtWork(const Called* who, const char* what, const AtRows& rows = {});
    ~AtWork();
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;

private:
    friend struct CrashReport;
    struct Call {
        const Called* who;
        const char* what;
        AtRows rows;
    } call_;
    const Call* before_;
};

} // namespace kaya
