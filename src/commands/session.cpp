#include "commands/session.hpp"

#include "base/parallel.hpp"
#include "commands/deck_review.hpp"
#include "commands/handlers.hpp"
#include "commands/joint_values.hpp"
#include "commands/lua_joint_models.hpp"
#include "lang/commands/language.hpp"
#include "lang/fish/compiler.hpp"
#include "mechanics/contact_properties.hpp"
#include "laws/arithmetic.hpp"
#include "lang/script/value_text.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// Commands take numbers, texts and vectors of scripts; a pointer means nothing to them.
lang::Value command_value(const script::Value& value, const std::string& expression, const Place& place) {
    if (const auto* truth = std::get_if<bool>(&value)) return *truth;
    if (const auto* number = std::get_if<std::int64_t>(&value)) return *number;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
    if (std::holds_alternative<std::monostate>(value)) return std::monostate{};
    throw Diagnostic(fmt::format("'{}' is a pointer, which a command cannot use", expression),
                     "give a number, a text or a vector")
        .at(place);
}

/// The points of a table for joint models; its name is a number.
std::optional<JointTables::Points> table_points(script::Scripts& scripts, const std::string& name) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
    const auto& tables = scripts.tables();
    const auto found = tables.find(number);
    if (found == tables.end()) return std::nullopt;
    JointTables::Points points;
    for (const auto& point : found->second.points) {
        points.x.push_back(point.x);
        points.y.push_back(point.y);
    }
    return points;
}

/// Bytes that scripts may take: a text that is doubled too often shall end with a message, not take the machine down.
std::size_t memory_for_scripts(std::size_t megabytes) {
    if (megabytes > 0) return megabytes << 20;
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(page) : 0;
}

} // namespace

Session::Session(const Options& given, std::FILE* results, std::FILE* messages)
    : options(given), output(results, messages), world(model, joints), interpreter(lang::classic(), [this](const lang::BoundCommand& command) { run_command(*this, command); }) {
    output.quiet = options.quiet;
    set_threads(options.threads > 0 ? options.threads
                                    : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
    joints.set_path(options.joint_folders);
    add_lua_loader(joints);
    joints.before_loading = joints.zones.before_loading = [this](const fs::path& file) { gate->may_load(file); };
    joints.tables().set_source([this](const std::string& name) { return table_points(*scripts, name); });

    script::Options script_options;
    script_options.trusted = options.trust;
    script_options.gate = gate;
    script_options.memory = memory_for_scripts(options.script_memory);
    scripts = std::make_unique<script::Scripts>(world, script_options);
    scripts->on_print([this](const std::string& line) { output.print(line); });
    scripts->on_require([this] { return interpreter.searched(); });
    world.run_command = [this](const std::string& text, const std::string& chunk, int line, bool caught) {
        std::optional<Output::Caught> printed;
        if (caught) printed.emplace(output);
        ++commands_of_scripts_;
        try {
            interpreter.run_text(text, chunk, line);
        } catch (...) {
            --commands_of_scripts_;
            throw;
        }
        --commands_of_scripts_;
        return printed ? printed->take() : std::string{};
    };

    world.note = [this](const std::string& message) { note_once(message); };
    world.warn = [this](Diagnostic warning) {
        if (said_once.insert("far:" + here()).second) warn(std::move(warning)); // a loop may ask for many places
    };
    world.range_phrase = [this](const std::string& name) -> const lang::RangePhrase* {
        const auto found = ranges.find(lang::fold(name));
        return found == ranges.end() ? nullptr : &found->second;
    };
    world.range_test_of = [this](ObjectKind kind, const lang::RangePhrase& range) { return test_of(kind, range); };
    world.asks_for_objects = [this](const lang::RangePhrase& range) { return asks_for_objects(ranges, range); };

    interpreter.values = [this](const std::string& expression, const Place& place) {
        return command_value(scripts->value(expression, place), expression, place);
    };
    interpreter.on_warning = [this](const Diagnostic& warning) { warn(warning); };
    interpreter.before_command = [this](const lang::BoundCommand& command) { show_command(command); };
    interpreter.after_command = [this](const lang::BoundCommand& command) {
        tell_of_arithmetic();
        const bool calls = command.spec->flow == lang::Flow::call; // the commands of the file stand for it
        if (executed && commands_of_scripts_ == 0 && !calls) executed(command, Completion{});
        if (commands_of_scripts_ == 0) stopped_after_.reset(); // a script has caught it
    };
    interpreter.failed_command = [this](const lang::BoundCommand& command) {
        const bool calls = command.spec->flow == lang::Flow::call;
        if (!executed || commands_of_scripts_ > 0 || calls) return;
        // A wish to stop that no cycle has met has met a script.
        using enum Completion::How;
        const bool inside = std::exchange(stopped_inside_, false) || interrupted_;
        const auto how = stopped_after_ ? stopped : inside ? cut_off : failed;
        executed(command, {how, std::exchange(stopped_after_, std::nullopt).value_or(0)});
    };
    interpreter.checks = deck_checks();
    interpreter.deck_read = [this](const lang::BoundFile& file, const lang::BareNames& names) { review(file, names); };
    interpreter.checks.before_reading = [this](const fs::path& file) { gate->may_read_code(file); };
    vtk.before_writing = [this](const std::string& file) { output_file(file); };
    make_cycle();
}

Session::~Session() { scripts.reset(); }

void Session::make_cycle() {
    cycle = std::make_unique<Cycle>(model, joints);
    const auto hook = [this](script::Moment moment) {
        return [this, moment] {
            if (!scripts->has_hooks(moment)) return;
            world.forget_ranges(); // shapes and places are others than in the cycle before
            scripts->run_hooks(moment, model.clock.cycle);
        };
    };
    cycle->hooks.before_cycle.push_back(hook(script::Moment::before_cycle));
    cycle->hooks.after_forces.push_back(hook(script::Moment::after_forces));
    cycle->hooks.after_cycle.push_back(hook(script::Moment::after_cycle));
    cycle->hooks.table_value = [this](std::int64_t number, double x) {
        const auto& tables = scripts->tables();
        const auto found = tables.find(number);
        if (found == tables.end()) throw Diagnostic(fmt::format("there is no table {}", number), {}, Fault::run);
        return found->second.at(x);
    };
    cycle->hooks.script_value = [this](const std::string& expression) {
        const auto own = recorded_own_value(*this, expression);
        return own ? *own : scripts->number(expression);
    };
}

lang::Ended Session::run_deck(const std::string& file) {
    deck = file;
    autosave.find_earlier();
    const lang::Ended ended = interpreter.run_file(file);
    output.flush();
    return ended;
}

void Session::review(const lang::BoundFile& file, const lang::BareNames& names) {
    DeckReview review(names, *scripts, {fs::path(deck).parent_path(), "."});
    review.file(file);
    std::vector<Diagnostic> errors;
    for (const auto& finding : review.findings()) {
        if (finding.severity != Severity::error) warn(finding);
        else if (errors.size() < lang::most_errors_shown) errors.push_back(finding);
    }
    if (!errors.empty()) throw lang::DeckErrors(std::move(errors));
}

void Session::show_command(const lang::BoundCommand& command) {
    stop_if_interrupted();
    stopped_inside_ = false;
    last_place = command.place;
    world.forget_ranges();
    const auto& source = command.place.source;
    // What a script gives is part of a deck that has been read; it may be very many texts.
    if (source->is_file && (sources.empty() || sources.back() != source))
        if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
    if (!options.echo && !output.logging()) return;
    const std::string text = command.text();
    const std::string line = fmt::format("{}> {}", here(), text.substr(0, text.find('\n')));
    if (options.echo && !output.is_caught())
        output.print(line);
    else
        output.log_only(line);
}

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

void Session::warn(Diagnostic warning) {
    warning.at(interpreter.current_place());
    if (options.strict) {
        warning.severity = Severity::error;
        throw warning;
    }
    warning.severity = Severity::warning;
    ++warnings;
    if (warning_texts.size() < 100) warning_texts.push_back(render(warning));
    output.message(warning);
}

void Session::tell_of_arithmetic() {
    const auto tell = [this](const LawTable& law, const char* noun) {
        if (law.arithmetic() == 0 || !said_once.insert("arithmetic:" + law.file.string()).second) return;
        Diagnostic warning(fmt::format("{} '{}' changes {}; the program puts it back after each call", noun, law.name,
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
    if (!said_once.insert(message).second) return;
    Diagnostic note(message, hint);
    note.severity = Severity::note;
    output.message(note.at(interpreter.current_place()));
}

std::vector<Row> Session::pick_rows(ObjectKind kind, const lang::RangePhrase& range, bool hidden_too) {
    auto rows = select(model, kind, test_of(kind, range), hidden_too);
    if (!rows.empty()) return rows;
    const std::size_t tested = select(model, kind, {}, hidden_too).size();
    const std::size_t hidden = hidden_too ? 0 : select(model, kind, {}, true).size() - tested;
    const char* things = plural_of(kind);
    std::string text = tested > 0   ? fmt::format("0 of {} {} matched", tested, things)
                       : hidden > 0 ? fmt::format("all {} are hidden", things)
                                    : fmt::format("there are no {}", things);
    std::string hint = "the command has no effect";
    if (tested > 0 && hidden > 0) hint += fmt::format("; {} hidden {} were not looked at", hidden, things);
    warn(Diagnostic(std::move(text), std::move(hint)).at(range.place));
    return rows;
}

RangeExtras Session::range_extras(bool excavated) {
    return {.joints = &joints, .ground = [this](const std::string& file) { return read_ground(input_file(file).string()); }, .excavated = excavated};
}

RangeTest Session::test_of(ObjectKind kind, const lang::RangePhrase& range) {
    // What lies on the surface is told by contacts.
    if (has_element(ranges, range, lang::RangeElement::Kind::surface)) find_contacts(model, joints);
    RangeTest test = range_test(model, ranges, range, kind, range_extras(false));
    if (!test) return test;
    constexpr int rows_between = 256; // two looks whether the user wants to stop
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
        Diagnostic note(fmt::format("another run of '{}' is going on in this folder", stem),
                        fmt::format("the journal and the autosave of this one are called '{}'", taken.name));
        note.severity = Severity::note;
        output.message(note);
    }
    return taken.name;
}

std::string Session::here() const {
    const Place place = interpreter.current_place();
    return place ? fmt::format("{}:{}", place.source->name, place.line) : std::string{};
}

fs::path Session::next_to_deck(const std::string& name) const {
    const fs::path adjacent = fs::path(deck).parent_path() / name;
    std::error_code ignored;
    return fs::exists(adjacent, ignored) ? adjacent : fs::path(name);
}

fs::path Session::input_file(const std::string& name) {
    const fs::path found = next_to_deck(name);
    gate->may_read(found);
    files_read.insert(found.string());
    return found;
}

const std::string& Session::output_file(const std::string& name) {
    gate->may_write(name);
    return name;
}

std::string Session::symbol_text(const std::string& expression) {
    return script::to_text(scripts->value(expression, interpreter.current_place()), &world);
}

void Session::clear() {
    const bool by_script = scripts->running(); // which goes on in the new model
    if (by_script) scripts->refuse_while_awaited("new");
    model = Model{};
    ranges.clear();
    if (by_script) scripts->change_model();
    else scripts->clear();
    world.rows_moved();
    title.clear();
    property_places.clear();
    if (!by_script) said_once.clear();
    autosave.saved();
    make_cycle();
}

lang::Checks deck_checks() {
    // A function that does not compile is found before the first command runs, not hours later. What its names
    // mean is known when it is defined; names that are not supported are refused whatever they mean.
    lang::Checks checks;
    checks.command = [](const std::any& command) {
        if (const auto* function = std::any_cast<lang::FishDefinition>(&command))
            fish::generate(fish::read_function(function->text, function->place), [](std::string_view) { return fish::Meaning{}; });
        else if (const auto* chunk = std::any_cast<lang::LuaChunk>(&command))
            script::check_lua_text(chunk->text, chunk->place);
    };
    return checks;
}

const char* program_version() { return KAYA_VERSION; }

} // namespace kaya
