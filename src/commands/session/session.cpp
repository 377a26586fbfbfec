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
    if (program.said_once.insert("far:" + deck.here()).second) warn(std::move(far)); // a loop may query many places
}

const lang::RangePhrase* Session::range_phrase(const std::string& name) {
    const auto found = deck.ranges.find(lang::fold(name));
    return found == deck.ranges.end() ? nullptr : &found->second;
}

bool Session::asks_for_objects(const lang::RangePhrase& range) { return kaya::asks_for_objects(deck.ranges, range); }

void Session::interrupt() noexcept {
    interrupted_ = true;
    engine.scripts->interrupt();
}

bool Session::is_deaf() const noexcept {
    return interrupted_ && commands_of_scripts_ == 0 && engine.scripts->is_deaf();
}

void Session::stop_if_interrupted() {
    if (!interrupted_.exchange(false)) return;
    stopped_inside_ = true;
    throw Diagnostic(fmt::format("stopped by the user after cycle {}", engine.model.clock.cycle), {}, Fault::run);
}

void Session::stop_after_cycle() {
    if (stop_after == engine.model.clock.cycle) {
        stop_after.reset();
        interrupted_ = true;
    }
    if (!interrupted_) return;
    stopped_after_ = engine.model.clock.cycle;
    stop_if_interrupted();
}

bool Session::scripts_act_in_cycles() const {
    using enum script::Moment;
    for (const auto moment : {before_cycle, after_forces, after_cycle})
        if (engine.scripts->has_hooks(moment)) return true;
    return !engine.callbacks.empty() || std::ranges::any_of(engine.model.time_functions, [](const TimeFunction& f) {
        return f.kind == TimeFunction::Kind::script;
    }) || std::ranges::any_of(engine.model.histories.all, [](const History& h) {
        return h.source.kind == HistorySource::Kind::function;
    });
}

void Session::warn(Diagnostic warning) { program.show_warning(warning.at(deck.interpreter.current_place())); }

void Session::tell_of_arithmetic() {
    const auto tell = [this](const LawTable& law, const char* noun) {
        if (law.arithmetic() == 0 || !program.said_once.insert("arithmetic:" + law.file.string()).second) return;
        Diagnostic warning(
            fmt::format("{} '{}' changes {}; the program puts it back after each call", noun, law.name,
                        text_of_changes(law.arithmetic())),
            fmt::format("build it without -ffast-math and -Ofast, and without calls that change the rounding: {}",
                        law.file.string()));
        warning.code = "joint-model-arithmetic";
        warn(std::move(warning));
    };
    for (const auto& law : engine.joints.loaded()) tell(*law, joint_law.noun);
    for (const auto& law : engine.joints.zones.loaded()) tell(*law, zone_law.noun);
}

void Session::note_once(const std::string& message, const std::string& hint) {
    if (program.said_once.insert(message).second)
        program.show_note(Diagnostic(message, hint).at(deck.interpreter.current_place()));
}

void Session::warn_once(const std::string& message, const std::string& hint) {
    if (program.said_once.insert(message).second) warn(Diagnostic(message, hint).at(deck.interpreter.current_place()));
}

std::string Session::run_name() {
    const std::string stem = stem_of_deck(deck.file);
    const auto taken = names_.take(stem);
    if (taken.is_new && taken.by_other) {
        Diagnostic note(fmt::format("another run of '{}' is running in this folder", stem),
                        fmt::format("the journal and the autosave of this one are called '{}'", taken.name));
        program.show_note(note);
    }
    return taken.name;
}

fs::path Session::input_file(const std::string& name) {
    const fs::path found = deck.next_to_deck(name);
    program.gate->may_read(found);
    program.files_read.insert(found.string());
    return found;
}

std::string Session::symbol_text(const std::string& expression) {
    return script::to_text(engine.scripts->value(expression, deck.interpreter.current_place()), &engine.world);
}

} // namespace kaya
