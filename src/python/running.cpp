#include "python/running.hpp"

#include "commands/session/autosave.hpp"
#include "commands/session/given_parameters.hpp"
#include "lang/interp/lexer.hpp"
#include "system/interrupt_signal.hpp"

#include <array>
#include <atomic>
#include <fmt/format.h>
#include <optional>

namespace kaya::python {

namespace py = pybind11;

namespace {

std::atomic<Session*> listening = nullptr;
std::atomic<bool> asked = false;

/// Python's own action of Ctrl-C waits for the interpreter, which waits for the session: so the session is notified at once.
class OnInterrupt {
public:
    explicit OnInterrupt(Session& session) {
        if (!is_main_thread() || listening != nullptr) return; // signals belong to the main thread
        asked = false;
        listening = &session;
        signal_.emplace([] {
            asked = true;
            if (Session* heard = listening; heard != nullptr) heard->interrupt();
        });
    }
    ~OnInterrupt() {
        if (!signal_) return;
        signal_.reset();
        listening = nullptr;
    }
    OnInterrupt(const OnInterrupt&) = delete;
    OnInterrupt& operator=(const OnInterrupt&) = delete;

    bool was_asked() const { return signal_ && asked.exchange(false); }

private:
    std::optional<InterruptSignal> signal_;
};

script::Moment moment_of(const std::string& name) {
    using enum script::Moment;
    if (name == "before_cycle") return before_cycle;
    if (name == "after_forces") return after_forces;
    if (name == "after_cycle") return after_cycle;
    throw py::value_error("'" + name + "' is not before_cycle, after_forces or after_cycle");
}

} // namespace

PythonSession::PythonSession(const py::function& out, const py::function& messages, const Options& options)
    : out_(stream_to(out)), messages_(stream_to(messages)) {
    const py::gil_scoped_release others;
    session_ = std::make_unique<Session>(options, out_.get(), messages_.get());
    session_->deck.file = "python";
    session_->autosave->set_interval(std::nullopt); // the caller keeps the model
}

PythonSession::~PythonSession() {
    session_->engine.callbacks.clear(); // they hold objects of Python
    const py::gil_scoped_release others;
    session_.reset();
}

Session& PythonSession::session() {
    if (running_ && !inside_call_) throw std::runtime_error("the model runs in another thread");
    return *session_;
}

void PythonSession::refuse_borrowed() const {
    if (*borrowed_ > 0)
        throw py::buffer_error(
            "arrays that look into the model are alive: delete them (and their slices) before it changes, or copy them");
}

void PythonSession::run(const std::function<void(Session&)>& work) {
    Session& session = this->session();
    refuse_borrowed();
    if (inside_call_) { // of a function inside a cycle: the run around it has the signals
        const py::gil_scoped_release others;
        return work(session);
    }
    const OnInterrupt signals(session);
    std::exception_ptr failed;
    running_ = true;
    {
        const py::gil_scoped_release others;
        try {
            try {
                session.stop_if_interrupted();
            } catch (const Diagnostic&) { asked = false; } // a wish for the command before
            work(session);
        } catch (...) { failed = std::current_exception(); }
        try {
            session.program.output.end_refresh(); // a run that an exception has ended leaves its line
            session.program.output.flush();
        } catch (...) {
            if (!failed) failed = std::current_exception();
        }
    }
    running_ = false;
    if (raised_) {
        const py::error_already_set raised = *std::exchange(raised_, std::nullopt);
        throw raised;
    }
    if (signals.was_asked()) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw py::error_already_set();
    }
    if (failed) std::rethrow_exception(failed);
}

std::string PythonSession::text(const std::string& commands, const std::string& name, bool caught) {
    std::string printed;
    run([&](Session& session) {
        if (session.engine.inside_cycle) {
            printed = session.engine.world.command(commands, name, 1, caught);
            return;
        }
        std::optional<Output::Caught> catching;
        if (caught) catching.emplace(session.program.output);
        session.deck.interpreter.run_text(commands, name);
        if (catching) printed = catching->take();
    });
    return printed;
}

namespace {

/// Parameters of one run: neither earlier values hold in it, nor these in later runs.
class GivenForOneRun {
public:
    GivenForOneRun(Session& session, const std::vector<std::string>& names) : session_(session), names_(names) {
        forget();
    }
    ~GivenForOneRun() { forget(); }
    GivenForOneRun(const GivenForOneRun&) = delete;

private:
    void forget() {
        for (const auto& name : names_) session_.deck.parameters.erase(lang::fold(name));
    }

    Session& session_;
    const std::vector<std::string>& names_;
};

} // namespace

void PythonSession::deck(const std::string& file, const std::map<std::string, std::string>& parameters) {
    run([&](Session& session) {
        const auto words = words_of_decks({file});
        std::vector<std::string> names;
        for (const auto& [name, value] : parameters) {
            if (words) words->require(name, Place{});
            names.push_back(name);
        }
        const GivenForOneRun given(session, names);
        for (const auto& [name, value] : parameters)
            session.deck.interpreter.run_text(fmt::format("param '{}' = {}", name, value), "python");
        session.run_deck(file);
        warn_of_unused_parameters(session, names, words ? &*words : nullptr);
    });
}

void PythonSession::call(const py::function& function) {
    if (raised_) return; // the run is about to stop
    const py::gil_scoped_acquire hold;
    inside_call_ = true;
    try {
        function();
        refuse_borrowed();
    } catch (py::error_already_set& problem) { raised_ = problem; } catch (const std::exception& problem) {
        PyErr_SetString(PyExc_BufferError, problem.what());
        raised_.emplace();
    }
    inside_call_ = false;
    if (raised_) session_->interrupt();
}

int PythonSession::call_in_cycles(const py::function& function, const std::string& moment, std::int64_t interval) {
    if (interval < 1) throw py::value_error("the interval is at least 1 cycle");
    auto& callbacks = session().engine.callbacks;
    const int number = callbacks.empty() ? 1 : callbacks.back().number + 1;
    callbacks.push_back({number, moment_of(moment), interval, [this, called = kept(function)] { call(*called); }});
    return number;
}

void PythonSession::leave_out(int number) {
    std::erase_if(session().engine.callbacks, [number](const Engine::Callback& one) { return one.number == number; });
}

} // namespace kaya::python
