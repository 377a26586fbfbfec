#include "commands/session/autosave.hpp"

#include "base/terminal_text.hpp"
#include "commands/session/save_session.hpp"
#include "commands/session/session.hpp"
#include "model/whole/state_hash.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Seconds: a shorter run is quickly repeated.
constexpr double worth_keeping = 60;

void note(Session& session, const std::string& message, const std::string& hint) {
    Diagnostic note(message, hint);
    note.severity = Severity::note;
    session.program.output.message(note);
}

} // namespace

std::string Autosave::file_name() { return fmt::format("{}-autosave{}", session_.run_name(), save_ending); }

void Autosave::find_earlier() {
    const std::string name = file_name();
    std::error_code ignored;
    if (name != written_ && fs::exists(name, ignored))
        note(session_, fmt::format("an earlier run was cut off and left '{}'", name),
             fmt::format(
                 "'kaya info {0}' says how far it was, 'restore {0}' continues from there; this run will replace it",
                 name));
}

double Autosave::unsaved() const { return since_ ? std::chrono::duration<double>(Clock::now() - *since_).count() : 0; }

bool Autosave::is_long() const {
    return typed_ || (since_ && (!written_.empty() || (interval_ && unsaved() > std::min(*interval_, worth_keeping))));
}

bool Autosave::is_new() const {
    return session_.engine.model.blocks.size() > 0 && state_hash(session_.engine.model) != saved_hash_;
}

void Autosave::before_typed() {
    constexpr std::chrono::milliseconds unnoticed{50};
    if (failed_cycle_ == 0) last_good_.offer(session_, unnoticed); // the model after a failed cycle is unusable
}

void Autosave::saved() {
    since_.reset();
    failed_cycle_ = 0;
    last_good_.drop();
    if (typed_) saved_hash_ = state_hash(session_.engine.model);
}

void Autosave::begins() {
    failed_cycle_ = 0; // a later cycle accepts the model in this state
    last_good_.lose_track();
    offer_copy();
}

void Autosave::advanced() {
    failed_cycle_ = 0;
    if (!since_) since_ = Clock::now();
    offer_copy();
    if (held_ > 0 || !interval_ || unsaved() < *interval_) return;
    since_ = Clock::now(); // also when it cannot be written: it is tried again in its time
    if (!write()) return;
    session_.program.output.say(fmt::format("cycle {} is kept in '{}'", cycle_, written_));
    last_good_.take(session_); // which costs less than the file: an older copy would be of no use
}

void Autosave::offer_copy() {
    if (held_ == 0 && is_long()) last_good_.offer(session_);
}

bool Autosave::into_file(const std::function<void(const std::string&)>& save, std::int64_t cycle) {
    const std::string name = file_name();
    try {
        save(name);
    } catch (const Diagnostic& problem) {
        if (!std::exchange(complained_, true))
            note(session_, fmt::format("the model could not be kept in '{}': {}", name, problem.message),
                 "the run continues");
        return false;
    }
    written_ = name;
    cycle_ = cycle;
    return true;
}

bool Autosave::write() {
    return into_file([&](const std::string& name) { save_session(session_, name); }, session_.engine.model.clock.cycle);
}

void Autosave::write_before_failure() {
    if (last_good_.empty() || (!written_.empty() && last_good_.cycle() < cycle_)) return; // the file is as good
    const auto write_copy = [&](const std::string& name) {
        session_.program.output_file(name);
        last_good_.write(name, fmt::format("the state before cycle {}, which failed: {}", failed_cycle_, why_));
    };
    // The certain state is written first.
    if (!into_file(write_copy, last_good_.cycle()) || last_good_.cycle() == failed_cycle_ - 1) return;
    try {
        last_good_.run_on(session_, failed_cycle_ - 1);
    } catch (const Diagnostic&) {
        return; // a joint model that does not do the same twice
    }
    into_file(write_copy, last_good_.cycle());
}

void Autosave::keep() {
    if (kept_ || (typed_ && !is_new())) return;
    if (is_long() && failed_cycle_ > 0) write_before_failure();
    else if (is_long()) write();
    if (written_.empty()) return;
    kept_ = true;
    const std::string before = failed_cycle_ == 0 ? ""
                               : cycle_ + 1 == failed_cycle_
                                   ? ", before the one that failed,"
                                   : fmt::format(", {} cycles before the one that failed,", failed_cycle_ - cycle_);
    note(session_, fmt::format("the model after cycle {}{} is kept in '{}'", cycle_, before, written_),
         fmt::format("'restore {}' continues from there", written_));
}

void Autosave::keep_copy() {
    if (last_good_.empty() || last_good_.is_void()) return;
    const std::string name = file_name();
    try {
        session_.program.output_file(name);
        last_good_.write(name, "the last copy before the program ended in the midst of a command");
    } catch (const Diagnostic& problem) {
        print_text(stderr, fmt::format("\nthe model could not be kept in '{}': {}\n", name, problem.message));
        return;
    }
    print_text(stderr, fmt::format("\nthe model after cycle {0} is kept in '{1}': 'restore {1}' continues from there\n",
                                   last_good_.cycle(), name));
}

void Autosave::done() {
    if (kept_) return;
    if (!written_.empty()) door::remove(written_);
    written_.clear();
}

} // namespace kaya
