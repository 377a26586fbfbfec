// Services of a session for the interpreter and for scripts: it runs commands and reviews decks.
#include "base/stop_point.hpp"
#include "commands/session/autosave.hpp"
#include "commands/review/deck_finding.hpp"
#include "commands/review/deck_review.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/law_conduct.hpp"
#include "lang/script/values/value_text.hpp"
#include "system/crash_report.hpp"

#include <fmt/format.h>
#include <optional>
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
    : program(given, results, messages), deck(*this), engine(*this), autosave(std::make_unique<Autosave>(*this)) {
    const Options& options = program.options;
    engine.begin(program.gate, options.joint_folders, options.trust, options.script_memory, options.host);
    engine.scripts->on_print([this](const std::string& line) { program.output.print(line); });
    engine.scripts->on_require([this] { return deck.interpreter.searched(); });
    deck.interpreter.checks.before_reading = [this](const fs::path& file) { program.gate->may_read_code(file); };
    vtk.before_writing = [this](const std::string& file) { program.output_file(file); };
}

Session::~Session() { engine.scripts.reset(); }

lang::Ended Session::run_deck(const std::string& file) {
    deck.file = file;
    autosave->find_earlier();
    const lang::Ended ended = deck.interpreter.run_file(file);
    program.output.flush();
    return ended;
}

void Session::run(const lang::BoundCommand& command) {
    const WithTeam loops(program.team());
    std::optional<StopListener> stops;
    if (program.options.host->stops_by_session()) stops.emplace([this] { stop_if_interrupted(); });
    const std::string text = command.text(), place = deck.here();
    const std::string line = text.substr(0, text.find('\n'));
    const auto at_command =
        program.options.host->at_command(place.empty() ? line : fmt::format("{} ({})", line, place));
    run_command(*this, command);
}

lang::Value Session::value(const std::string& expression, const Place& place) {
    return command_value(engine.scripts->value(expression, place), expression, place);
}

void Session::deck_read(const lang::BoundFile& file, const lang::BareNames& names) {
    DeckReview review(names, *engine.scripts, {fs::path(deck.file).parent_path(), "."}, program.options.own_joints);
    if (!engine.model.blocks.empty() || !deck.ranges.empty() || !engine.scripts->tables().empty() ||
        !engine.model.histories.all.empty())
        review.continues_a_model();
    review.models_are_in(program.options.joint_folders);
    review.file(file);
    std::vector<Diagnostic> errors;
    for (const auto& finding : review.findings()) {
        if (finding.severity != Severity::error) {
            // What the run says again when it reaches the line is said here alone, or there alone.
            if (finding.code != said_by_the_run && program.said_once.insert(finding.message).second) warn(finding);
        } else if (errors.size() < lang::most_errors_shown) errors.push_back(finding);
    }
    if (!errors.empty()) throw lang::DeckErrors(std::move(errors));
}

void Session::before(const lang::BoundCommand& command) {
    stop_if_interrupted();
    stopped_inside_ = false;
    deck.last_place = command.place;
    deck.modern_line = command.modern;
    engine.world.forget_ranges();
    deck.take_source(command.place);
    if (!program.options.echo && !program.output.logging()) return;
    const std::string text = command.text();
    const std::string line = fmt::format("{}> {}", deck.here(), text.substr(0, text.find('\n')));
    if (program.options.echo && !program.output.is_caught()) program.output.print(line);
    else program.output.log_only(line);
}

void Session::after(const lang::BoundCommand& command) {
    tell_of_arithmetic();
    if (commands_of_scripts_ > 0) return;
    review_conduct(*this);
    if (!calls_file(command)) program.tell_executed(command, {});
    stopped_after_.reset(); // a script has caught it
}

void Session::failed(const lang::BoundCommand& command) {
    if (commands_of_scripts_ > 0 || calls_file(command)) return;
    // A wish to stop that no cycle has met has met a script.
    using enum Completion::How;
    const bool inside = std::exchange(stopped_inside_, false) || interrupted_;
    const auto how = stopped_after_ ? stopped : inside ? cut_off : Completion::How::failed;
    program.tell_executed(command, {how, std::exchange(stopped_after_, std::nullopt).value_or(0)});
}

std::string Session::run_text(const std::string& text, const std::string& chunk, int line, bool caught) {
    struct Giving {
        int& commands;
        explicit Giving(int& count) : commands(count) { ++commands; }
        ~Giving() { --commands; }
    };
    std::optional<Output::Caught> printed;
    if (caught) printed.emplace(program.output);
    {
        const Giving giving(commands_of_scripts_);
        deck.interpreter.run_text(text, chunk, line);
    }
    return printed ? printed->take() : std::string{};
}

void Session::clear() {
    const bool by_script = engine.scripts->running(); // the script continues in the new model
    if (by_script) engine.scripts->refuse_while_awaited("new");
    engine.model = Model{};
    deck.ranges.clear();
    deck.surface_sets = {};
    if (by_script) engine.scripts->change_model();
    else engine.scripts->clear();
    deck.title.clear();
    deck.units = {};
    deck.property_words.clear();
    if (!by_script) program.said_once.clear();
    autosave->saved();
    engine.make_cycle();
}

} // namespace kaya
