// Reports the running command, and the running joint model or zone model, when the program crashes, ends unexpectedly or hangs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kaya {

/// A law whose functions are called. It lives as long as the program, so that a report can name it at any time.
struct Called {
    std::string name, file;
    const char* noun; ///< "joint model"
    bool foreign;     ///< it does not ship with the program
};

/// The same one for the same three texts. Not for signal handlers.
const Called* called(const std::string& name, const std::string& file, const char* noun);

/// Installs the reports. A crash (a bad address, a division by zero, abort(), a stack overflow) is reported on the standard error before it
/// ends the program: the command, and the model that runs in the crashed thread with its file, its function and the sub-contact. If none
/// runs there, the foreign model that was called last is named: it may have damaged memory that is used later. A model that calls exit(),
/// or _exit(), ends the program with status 2 and a message. Ctrl-C names the running models.
void report_crashes();

/// The program's version of _exit() and _Exit(): `caller` is the address of the call.
[[noreturn]] void end_by_exit(const void* caller, int status);

/// For a signal handler: ends the program by the signal, after naming the models that are at work.
void end_at_once(int signal);

/// Sets what is called before the program ends inside a command: by a crash, by exit() of a model, by a second Ctrl-C. It runs in a signal
/// handler. Null: nothing.
void set_last_act(void (*act)());
void last_act();

/// For a signal handler: says that the program waits for the models that are at work, if there are any.
void tell_whom_it_waits_for();

/// Rows of a batch that a law works on. The law writes its position to `row`; until then the position is unknown.
struct AtRows {
    std::size_t rows = 0;
    const std::size_t* row = nullptr;      ///< of the batch
    const std::int32_t* numbers = nullptr; ///< of the rows that users see; NULL: they follow `first`
    std::int32_t first = 0;                ///< number of the first row; 0: the report gives rows
    const char* noun = "sub-contact";      ///< of a numbered row
};

/// While it lives, the program runs a command; of nested commands the inner one is reported. For the main thread only.
class AtCommand {
public:
    /// The text is copied as far as there is room, without control characters.
    explicit AtCommand(std::string_view text);
    ~AtCommand();
    AtCommand(const AtCommand&) = delete;
    AtCommand& operator=(const AtCommand&) = delete;

    const char* text() const { return text_; }

private:
    char text_[200];
    const AtCommand* before_;
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
