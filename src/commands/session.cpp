#include "commands/session.hpp"

#include "commands/deck_finding.hpp"
#include "commands/deck_review.hpp"
#include "commands/handlers.hpp"
#include "commands/law_conduct.hpp"
#include "commands/new_contacts.hpp"
#include "lang/script/value_text.hpp"
#include "laws/arithmetic.hpp"
#include "laws/crash_report.hpp"
#include "laws/guard.hpp"
#include "mechanics/contact_properties.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// Commands accept numbers, texts and vectors of scripts; pointers have no meaning to them.
lang::Value command_value(const script::Value& value, const std::string& expression, const Place& place) {
    if (const auto* truth = std::get_if<bool>(&value)) return *truth;
    if (const auto* number = std::get_if<std::int64_t>(&value)) return *number;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
    if (std::holds_alternative<std::monostate>(value)) return std::monostate{};
    const auto kind =
        std::holds_alternative<script::Handle>(value) ? std::string_view("pointer") : script::type_name(value);
    throw Diagnostic(fmt::format("'{}' is a {}, which a command cannot use", expression, kind),
                     "give a number, a text or a vector")
        .at(place);
}

bool calls_file(const lang::BoundCommand& command) {
    return command.spec->flow == lang::Flow::call;
} // its commands represent it

} // namespace

Session::Session(const Options& given, std::FILE* results, std::FILE* messages)
    : Program(given, results, messages), Deck(static_cast<lang::InterpreterHost&>(*this)),
      Engine(static_cast<WorldHost&>(*this)) {
    fence_all_calls(options.strict);
    begin(gate, options.joint_folders, options.trust, options.script_memory);
    scripts->on_print([this](const std::string& line) { output.print(line); });
    scripts->on_require([this] { return interpreter.searched(); });
    interpreter.checks.before_reading = [this](const fs::path& file) { gate->may_read_code(file); };
    vtk.before_writing = [this](const std::string& file) { output_file(file); };
}

Session::~Session() { scripts.reset(); }

lang::Ended Session::run_deck(const std::string& file) {
    deck = file;
    autosave.find_earlier();
    const lang::Ended ended = interpreter.run_file(file);
    output.flush();
    return ended;
}

void Session::run(const lang::BoundCommand& command) {
    const std::string text = command.text(), place = here();
    const std::string line = text.substr(0, text.find('\n'));
    const AtCommand at_command(place.empty() ? line : fmt::format("{} ({})", line, place));
    run_command(*this, command);
}

lang::Value Session::value(const std::string& expression, const Place& place) {
    return command_value(scripts->value(expression, place), expression, place);
}

void Session::deck_read(const lang::BoundFile& file, const lang::BareNames& names) {
    DeckReview review(names, *scripts, {fs::path(deck).parent_path(), "."}, options.own_joints);
    if (!model.blocks.empty() || !ranges.empty() || !scripts->tables().empty() || !model.histories.all.empty())
        review.continues_a_model();
    review.models_are_in(options.joint_folders);
    review.file(file);
    std::vector<Diagnostic> errors;
    for (const auto& finding : review.findings()) {
        if (finding.severity != Severity::error) {
            // What the run says again when it reaches the line is said here alone, or there alone.
            if (finding.code != said_by_the_run && said_once.insert(finding.message).second) warn(finding);
        } else if (errors.size() < lang::most_errors_shown) errors.push_back(finding);
    }
    if (!errors.empty()) throw lang::DeckErrors(std::move(errors));
}

void Session::before(const lang::BoundCommand& command) {
    stop_if_interrupted();
    stopped_inside_ = false;
    last_place = command.place;
    modern_line = command.modern;
    world.forget_ranges();
    take_source(command.place);
    if (!options.echo && !output.logging()) return;
    const std::string text = command.text();
    const std::string line = fmt::format("{}> {}", here(), text.substr(0, text.find('\n')));
    if (options.echo && !output.is_caught()) output.print(line);
    else output.log_only(line);
}

void Session::after(const lang::BoundCommand& command) {
    tell_of_arithmetic();
    if (commands_of_scripts_ > 0) return;
    review_conduct(*this);
    if (!calls_file(command)) tell_executed(command, {});
    stopped_after_.reset(); // a script has caught it
}

void Session::failed(const lang::BoundCommand& command) {
    if (commands_of_scripts_ > 0 || calls_file(command)) return;
    // A wish to stop that no cycle has met has met a script.
    using enum Completion::How;
    const bool inside = std::exchange(stopped_inside_, false) || interrupted_;
    const auto how = stopped_after_ ? stopped : inside ? cut_off : Completion::How::failed;
    tell_executed(command, {how, std::exchange(stopped_after_, std::nullopt).value_or(0)});
}

std::string Session::run_text(const std::string& text, const std::string& chunk, int line, bool caught) {
    struct Giving {
        int& commands;
        explicit Giving(int& count) : commands(count) { ++commands; }
        ~Giving() { --commands; }
    };
    std::optional<Output::Caught> printed;
    if (caught) printed.emplace(output);
    {
        const Giving giving(commands_of_scripts_);
        interpreter.run_text(text, chunk, line);
    }
    return printed ? printed->take() : std::string{};
}

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

std::vector<Row> Session::pick_rows(ObjectKind kind, const lang::RangePhrase& range, bool hidden_too) {
    if (info_of(kind).found_late) find_joints(*this);
    auto rows = select(model, kind, test_of(kind, range), hidden_too);
    if (!rows.empty()) return rows;
    const std::size_t tested = select(model, kind, {}, hidden_too).size();
    const std::size_t hidden = hidden_too ? 0 : select(model, kind, {}, true).size() - tested;
    const char* things = info_of(kind).plural;
    std::string text = tested > 0   ? fmt::format("0 of {} {} matched", tested, things)
                       : hidden > 0 ? fmt::format("all {} are hidden", things)
                                    : fmt::format("there are no {}", things);
    std::string hint = "the command has no effect";
    if (tested > 0 && hidden > 0) hint += fmt::format("; {} hidden {} were ignored", hidden, things);
    warn(Diagnostic(std::move(text), std::move(hint)).at(range.place));
    return rows;
}

RangeExtras Session::range_extras(bool excavated) {
    return {.joints = &joints,
            .ground = [this](const std::string& file) { return read_ground(input_file(file).string()); },
            .excavated = excavated};
}

RangeTest Session::test_of(ObjectKind kind, const lang::RangePhrase& range) {
    // Surface elements need contacts.
    if (has_element(ranges, range, lang::RangeElement::Kind::surface)) find_joints(*this);
    RangeTest test = range_test(model, ranges, range, kind, range_extras(false));
    if (!test) return test;
    constexpr int rows_between = 256; // rows between two checks for interruption
    return [this, test = std::move(test), left = rows_between](const Model& of, ObjectKind of_kind, Row row) mutable {
        if (--left == 0) {
            left = rows_between;
            stop_if_interrupted();
        }
        return test(of, of_kind, row);
    };
}

std::vector<Row> Session::pick(ObjectKind kind, const lang::RangePhrase& range) {
    return pick_rows(kind, range, false);
}

std::vector<Row> Session::pick_hidden_too(ObjectKind kind, const lang::RangePhrase& range) {
    return pick_rows(kind, range, true);
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

void Session::clear() {
    const bool by_script = scripts->running(); // the script continues in the new model
    if (by_script) scripts->refuse_while_awaited("new");
    model = Model{};
    ranges.clear();
    surface_sets = {};
    if (by_script) scripts->change_model();
    else scripts->clear();
    title.clear();
    units = {};
    property_places.clear();
    if (!by_script) said_once.clear();
    autosave.saved();
    make_cycle();
}

} // namespace kaya
