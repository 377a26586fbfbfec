#include "commands/rescue.hpp"

#include "commands/save_session.hpp"
#include "commands/session.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// A run that takes less is soon made again.
constexpr double worth_keeping = 60;

void note(Session& session, const std::string& message, const std::string& hint) {
    Diagnostic note(message, hint);
    note.severity = Severity::note;
    session.output.message(note);
}

} // namespace

std::string Rescue::file_name() {
    return fmt::format("{}-autosave{}", session_.run_name(), save_ending);
}

void Rescue::look_for_earlier() {
    const std::string name = file_name();
    std::error_code ignored;
    if (name != written_ && fs::exists(name, ignored))
        note(session_, fmt::format("an earlier run was cut off and has left '{}'", name),
             fmt::format("'kaya info {0}' says how far it was, 'restore {0}' goes on from there; this run will replace it", name));
}

void Rescue::advanced() {
    const auto now = Clock::now();
    half_way_ = false;
    if (!since_) since_ = now;
    if (held_ > 0 || !interval_ || std::chrono::duration<double>(now - *since_).count() < *interval_) return;
    since_ = now; // also when it cannot be written: it is tried again in its time
    if (write()) session_.output.say(fmt::format("cycle {} is kept in '{}'", cycle_, written_));
}

bool Rescue::write() {
    const std::string name = file_name();
    try {
        save_session(session_, name);
    } catch (const Diagnostic& problem) {
        if (!std::exchange(complained_, true))
            note(session_, fmt::format("the model could not be kept in '{}': {}", name, problem.message), "the run goes on");
        return false;
    }
    written_ = name;
    cycle_ = session_.model.clock.cycle;
    return true;
}

void Rescue::keep() {
    const double unsaved = since_ ? std::chrono::duration<double>(Clock::now() - *since_).count() : 0;
    const bool is_long = !written_.empty() || (interval_ && unsaved > std::min(*interval_, worth_keeping));
    if (since_ && is_long && !half_way_) write();
    if (!written_.empty())
        note(session_, fmt::format("the model after cycle {} is kept in '{}'", cycle_, written_),
             fmt::format("'restore {}' goes on from there", written_));
}

void Rescue::done() {
    std::error_code ignored;
    if (!written_.empty()) fs::remove(written_, ignored);
    written_.clear();
}

} // namespace kaya
