// A session that Python owns: commands with the interpreter lock released, stopped by Ctrl-C, and functions of Python in its cycles.
#pragma once

#include "commands/session/session.hpp"
#include "python/columns.hpp"
#include "python/streams.hpp"

#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>

namespace kaya::python {

class PythonSession {
public:
    /// `out` and `messages` are functions that take a text. Joint models are searched in `joints`, those of kaya in `own_joints`.
    PythonSession(const pybind11::function& out, const pybind11::function& messages, const Options& options);
    ~PythonSession();
    PythonSession(const PythonSession&) = delete;
    PythonSession& operator=(const PythonSession&) = delete;

    /// Runs commands. Returns what they print when `caught`, else "". Throws what the session throws, and the exception of a function of
    /// Python that stopped it; KeyboardInterrupt after Ctrl-C.
    std::string text(const std::string& commands, const std::string& name, bool caught);
    /// Runs a deck with parameters: a name, and the value as `param` reads it. Throws Diagnostic for a name that the deck does not mention.
    void deck(const std::string& file, const std::map<std::string, std::string>& parameters);
    /// Runs `work` with the session, in the same way.
    void run(const std::function<void(Session&)>& work);

    /// Calls `function` in the cycles whose number is a multiple of `interval`: before_cycle, after_forces, after_cycle. Returns a number
    /// for `leave_out`.
    int call_in_cycles(const pybind11::function& function, const std::string& moment, std::int64_t interval);
    void leave_out(int number);

    /// Ends the run after the present cycle. May be called by any thread.
    void interrupt() { session_->interrupt(); }
    /// The session between runs, and for functions inside a cycle. Throws RuntimeError while another thread runs it.
    Session& session();
    const Borrowed& borrowed() const { return borrowed_; }

private:
    void call(const pybind11::function& function);
    void refuse_borrowed() const;

    Stream out_, messages_;
    Borrowed borrowed_ = std::make_shared<std::atomic<std::int64_t>>(0);
    std::unique_ptr<Session> session_;
    std::optional<pybind11::error_already_set> raised_; ///< by a function inside a cycle
    bool running_ = false;
    bool inside_call_ = false;
};

} // namespace kaya::python
