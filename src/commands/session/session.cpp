#include "commands/session/session.hpp"

#include "lang/script/values/value_text.hpp"
#include "laws/arithmetic.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "system/crash_report.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

namespace fs = std::filesystem;

} // namespace

void Session::warn_once_here(Diagnostic far) {
    if (said_once.insert("far:" + here()).second) warn(std::move(far)); // a loop may query many places
}

const lang::RangePhrase* Session::range_phrase(const std::string& name) {
    const auto found = ranges.find(lang::fold(name));
    return found == ranges.end() ? nullptr : &found->second;
}

bool Session::asks_for_objects(const lang::RangePhrase& range) { return kaya::asks_for_objects(ranges, range); }

void Session::interrupt() noexcept {
    interrupted_ = true;
    scripts->interrupt();
}

bool Session::is_deaf() const noexcept { return interrupted_ && commands_of_scripts_ == 0 && scripts->is_deaf(); }

void Session::stop_if_interrupted() {
    if (!interrupted_.exchange(false)) return;
    stopped_inside_ = true;
    throw Diagnostic(fmt::format("stopped by the user after cycle {}", model.clock.cycle), {}, Fault::run);
}

void Session::stop_after_cycle() {
    if (stop_after == model.clock.cycle) {
        stop_after.reset();
        interrupted_ = true;
    }
    if (!interrupted_) return;
    stopped_after_ = model.clock.cycle;
    stop_if_interrupted();
}

bool Session::scripts_act_in_cycles() const {
    using enum script::Moment;
    for (const auto moment : {before_cycle, after_forces, after_cycle})
        if (scripts->has_hooks(moment)) return true;
    return !callbacks.empty() || std::ranges::any_of(model.time_functions, [](const TimeFunction& f) {
        return f.kind == TimeFunction::Kind::script;
    }) || std::ranges::any_of(model.histories.all, [](const History& h) {
        return h.source.kind == HistorySource::Kind::function;
    });
}

void Session::warn(Diagnostic warning) { show_warning(warning.at(interpreter.current_place())); }

void Session::tell_of_arithmetic() {
    const auto tell = [this](const LawTable& law, const char* noun) {
        if (law.arithmetic() == 0 || !said_once.insert("arithmetic:" + law.file.string()).second) return;
        Diagnostic warning(
            fmt::format("{} '{}' changes {}; the program puts it back after each call", noun, law.name,
                        text_of_changes(law.arithmetic())),
            fmt::format("build it without -ffast-math and -Ofast, and without calls that change the rounding: {}",
                        law.file.string()));
        warning.code = "joint-model-arithmetic";
        warn(std::move(warning));
    };
    for (const auto& law : joints.loaded()) tell(*law, joint_law.noun);
    for (const auto& law : joints.zones.loaded()) tell(*law, zone_law.noun);
}

void Session::note_once(const std::string& message, const std::string& hint) {
    if (said_once.insert(message).second) show_note(Diagnostic(message, hint).at(interpreter.current_place()));
}

void Session::warn_once(const std::string& message, const std::string& hint) {
    if (said_once.insert(message).second) warn(Diagnostic(message, hint).at(interpreter.current_place()));
}

std::string Session::run_name() {
    const std::string stem = stem_of_deck(deck);
    const auto taken = names_.take(stem);
    if (taken.is_new && taken.by_other) {
        Diagnostic note(fmt::format("another run of '{}' is running in this folder", stem),
                        fmt::format("the journal and the autosave of this one are called '{}'", taken.name));
        show_note(note);
    }
    return taken.name;
}

fs::path Session::input_file(const std::string& name) {
    const fs::path found = next_to_deck(name);
    gate->may_read(found);
    files_read.insert(found.string());
    return found;
}

std::string Session::symbol_text(const std::string& expression) {
    return script::to_text(scripts->value(expression, interpreter.current_place()), &world);
}

} // namespace kaya
