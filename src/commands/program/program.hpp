// The program around a run: options of the command line, output, files and listeners.
#pragma once

#include "commands/program/host.hpp"
#include "commands/program/output.hpp"
#include "system/door.hpp"

#include "lang/interp/binder.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace kaya {

/// Options of the command line.
struct Options {
    std::string colour = "auto";  ///< of messages: auto (on a terminal, unless NO_COLOR is set), always, never
    int threads = 0;              ///< 0: one for each core
    bool strict = false;          ///< warnings are errors
    bool quiet = false;           ///< results and messages only
    std::optional<bool> progress; ///< a line that is renewed in place; empty: on a terminal, unless quiet
    bool echo = false;            ///< each command is shown before it runs
    bool trust = false;           ///< scripts may use the whole of Lua: files, other programs
    std::shared_ptr<Host> host = std::make_shared<Host>(); ///< what owns the process
    std::size_t script_memory = 0;                         ///< megabytes for scripts; 0: no separate limit
    std::vector<std::filesystem::path> joint_folders;      ///< folders searched for joint models
    std::vector<std::filesystem::path> own_joints; ///< those of the program; their models are loaded for reading a deck
};

/// How a command of a deck ended.
struct Completion {
    enum class How {
        done,
        stopped, ///< by the user, after a cycle
        cut_off, ///< by the user, inside a script: a replay cannot repeat it
        failed
    };
    How how = How::done;
    std::int64_t cycle = 0; ///< after which it was stopped
};

/// A follower of a run: the journal, the report.
class Listener {
public:
    virtual ~Listener() = default;
    /// Called for each command of decks after its run; commands of scripts are part of the command that ran the script.
    virtual void executed(const lang::BoundCommand&, const Completion&) {}
    /// Called after each cycle.
    virtual void cycled() {}
    /// Whether cycled() reads the model beyond its clock.
    virtual bool reads_model() const { return false; }
};

class Program {
public:
    Program(const Options& given, std::FILE* results, std::FILE* messages);

    /// Adds a listener; it is called until it is removed.
    void listen(Listener& listener) { listeners_.push_back(&listener); }
    void forget(Listener& listener) { std::erase(listeners_, &listener); }
    void tell_executed(const lang::BoundCommand& command, const Completion& completion) const;
    void tell_cycled() const;
    bool any_listener_reads() const;

    /// Shows a warning whose place is set; under `--strict` throws it as an error.
    void show_warning(Diagnostic warning);
    /// Shows a note whose place is set.
    void show_note(Diagnostic note);

    /// The name of a file that is going to be written, when the gate lets it through. Throws Diagnostic.
    const std::string& output_file(const std::string& name);

    /// Threads of the loops of this session, at least 1.
    void set_threads(int count);

    /// Null: loops use the threads of the process.
    const ThreadTeam* team() const { return team_.get(); }

    Options options;
    std::shared_ptr<Gate> gate = door::gate(); ///< of the process; an open one when there is none
    Output output;
    std::string log_file = "kaya.log";      ///< of the next `set log on`
    bool report = false;                    ///< the run ends with a page: set report on
    std::size_t warnings = 0;               ///< shown so far
    std::vector<std::string> warning_texts; ///< the first hundred of them
    std::set<std::string> said_once;        ///< notes that are not repeated
    std::vector<std::string> files_written; ///< names of files that commands have written, in their order
    std::set<std::string> files_read;       ///< names of files that commands have read, decks not among them

private:
    std::vector<Listener*> listeners_;
    std::unique_ptr<ThreadTeam> team_;
};

/// "0.1.0"
const char* program_version();

} // namespace kaya
