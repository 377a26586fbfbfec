// save, restore, hist write, vtk write; files are written into the current folder unless they name another.
#include "commands/run/files.hpp"

#include "base/lower_case.hpp"
#include "commands/review/text_doubts.hpp"
#include "commands/session/plausible.hpp"
#include "commands/session/autosave.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/joint_files.hpp"
#include "commands/world/joint_values.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/session/save_session.hpp"
#include "commands/ranges/saved_ranges.hpp"
#include "commands/session/save_parts.hpp"

#include "io/history_csv.hpp"
#include "io/save.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// The file as named, else with the ending that `save` adds; beside the deck or in the current folder.
std::string saved_file(const Session& session, const std::string& name) {
    std::error_code ignored;
    for (const auto& candidate :
         {fs::path(name), fs::path(save_name(name)), session.deck.next_to_deck(save_name(name))})
        if (fs::is_regular_file(candidate, ignored)) return candidate.string();
    return save_name(name);
}

const std::string* find_part(const SaveExtras& extras, std::string_view name) {
    const auto found = std::ranges::find(extras.scripts, name, &SaveExtras::Item::name);
    return found == extras.scripts.end() ? nullptr : &found->content;
}

const std::string& part(const SaveExtras& extras, std::string_view name) {
    if (const std::string* found = find_part(extras, name)) return *found;
    throw Diagnostic(fmt::format("the save file has no part '{}'", name), "it was not written by this program",
                     Fault::run);
}

/// Saves of format 10, and those of models whose laws are all found by name, have no such part.
std::vector<JointFile> saved_joint_files(const SaveExtras& extras) {
    const std::string* text = find_part(extras, part_joints);
    return text == nullptr ? std::vector<JointFile>{} : joint_files_from_text(*text);
}

/// Saves of sessions without such sets have no such part.
SurfaceSets saved_surfaces(const SaveExtras& extras) {
    const std::string* text = find_part(extras, part_surfaces);
    return text == nullptr ? SurfaceSets{} : surfaces_from_text(*text);
}

/// Objects of joint models were restored as bytes; the models turn them into objects.
void wake_objects(Session& session, Model& model) {
    if (!model.sub_contacts.keeps_objects) return;
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        const auto& set = model.joint_properties[model.contacts.properties[c]];
        const JointModel& joint = session.engine.joints.get(set.model);
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s)
            if (JointObject& object = model.sub_contacts.object[s]; object.is_asleep())
                object = joint.restore_object(set.values, object.bytes());
    }
}

/// A saved model runs on with the joint models that it had: they must be here, with the same properties.
void load_joint_models(Session& session, Model& model, const std::vector<JointFile>& files,
                       const std::string& save_file) {
    for (auto& set : model.joint_properties) {
        if (set.model.find('/') != std::string::npos)
            throw Diagnostic(fmt::format("the save file names the joint model '{}' by a path", set.model),
                             "kaya saves names of joint models alone; the file was changed", Fault::run);
        const auto& properties = find_saved_model(session, set.model, files, save_file).properties;
        // Properties added to the model since then get the value that reproduces its earlier behaviour.
        while (set.values.size() < properties.size() && properties[set.values.size()].has_default())
            set.values.push_back(properties[set.values.size()].initial);
        if (properties.size() != set.values.size())
            throw Diagnostic(
                fmt::format("joint model '{}' has other properties now than when the model was saved", set.model),
                "use the library that was used then", Fault::run);
    }
    if (std::ranges::find(model.contacts.properties, no_row) != model.contacts.properties.end())
        throw Diagnostic("a contact of the save file has no joint properties", "the file was changed", Fault::run);
    wake_objects(session, model);
}

/// Histories and boundary conditions of a saved model name functions, which a restoring script must have: those of the file would replace
/// the running ones.
void refuse_missing_functions(Session& session, const Model& model, const std::string& file) {
    const auto find = [&](const std::string& expression, const std::string& who) {
        const std::string name = expression.substr(0, expression.find_first_of("( "));
        if (session.engine.scripts->knows(name)) return;
        throw Diagnostic(
            fmt::format("{} of '{}' asks for @{}, which is not defined here", who, file, name),
            "a script that restores a model continues with its own functions: define it before, or restore on a line of the deck",
            Fault::run);
    };
    for (const History& history : model.histories.all)
        if (history.source.kind == HistorySource::Kind::function)
            find(history.source.quantity, fmt::format("history {}", history.number));
    for (const TimeFunction& function : model.time_functions)
        if (function.kind == TimeFunction::Kind::script) find(function.script, "a boundary condition");
}

/// Restores the scripts of a file with its model; the previous model is restored when that fails.
void restore_scripts(Session& session, Model& model, const script::ScriptState& scripts) {
    const script::ScriptState scripts_before = session.engine.scripts->state();
    std::swap(session.engine.model, model);
    try {
        session.engine.scripts->restore(scripts);
    } catch (...) {
        std::swap(session.engine.model, model);
        session.engine.scripts->restore(scripts_before);
        throw;
    }
}

} // namespace

void save_as(Session& session, const std::string& name) {
    settle_forces(session); // a restored model continues as this one does
    save_session(session, save_name(name));
    session.autosave->saved();
}

void run(Session& session, const lang::Save& command) { save_as(session, command.file); }

void run(Session& session, const lang::Restore& command) {
    // Everything that can fail comes first; until then the session is unchanged.
    const bool by_script = session.engine.scripts->running(); // the script continues with the other model
    if (by_script) session.engine.scripts->refuse_while_awaited("restore");
    Model model;
    const std::string file = saved_file(session, command.file);
    session.program.gate->may_read(file);
    const SaveExtras extras = restore_state(model, file);
    load_joint_models(session, model, saved_joint_files(extras), file);
    NamedRanges ranges = ranges_from_text(part(extras, part_ranges));
    SurfaceSets surfaces = saved_surfaces(extras);
    const script::ScriptState scripts = script::from_bytes(part(extras, part_scripts));

    if (by_script) {
        refuse_missing_functions(session, model, file);
        session.engine.scripts->change_model(&scripts);
        std::swap(session.engine.model, model);
    } else {
        restore_scripts(session, model, scripts);
    }
    session.deck.ranges = std::move(ranges);
    session.deck.surface_sets = std::move(surfaces);
    session.deck.title = extras.title;
    session.deck.units = units_of(extras);
    if (!extras.missing.empty())
        session.note_once(fmt::format("'{}' was saved by kaya {}, which did not have these yet: {}", file,
                                      extras.program_version, fmt::join(extras.missing, ", ")),
                          session.engine.model.settings.triangular_outer_faces
                              ? "outer faces of cells stay triangles; all else has the values of a new model"
                              : "they have the values of a new model");
    session.deck.property_words.clear();
    session.engine.make_cycle();
    session.autosave->saved();
}

namespace {

/// The number of a history by its name, or by its number as a text.
std::int64_t history_number(const Histories& histories, const std::string& name) {
    std::vector<std::string_view> known;
    for (const History& history : histories.all) {
        if (equal_ignoring_case(history.label, name) || std::to_string(history.number) == name) return history.number;
        known.push_back(history.label);
    }
    const auto near = did_you_mean(name, known);
    throw Diagnostic(fmt::format("there is no history '{}'", name),
                     near.empty() ? "histories have their names, or the numbers in which they were made"
                                  : fmt::format("did you mean '{}'?", near));
}

} // namespace

void run(Session& session, const lang::HistoryWrite& command) {
    warn_of(session, doubts_of(command));
    const auto& histories = session.engine.model.histories;
    try {
        if (histories.all.empty()) throw Diagnostic("there are no histories to write", "hist records one: hist unbal");
        std::vector<std::int64_t> numbers = command.numbers;
        for (const auto& name : command.names) numbers.push_back(history_number(histories, name));
        std::optional<std::int64_t> versus = command.versus;
        if (!command.versus_name.empty()) versus = history_number(histories, command.versus_name);
        const std::string file =
            command.file.empty() ? fs::path(session.deck.file).stem().string() + ".csv" : command.file;
        write_history_csv(histories, session.program.output_file(file), numbers, versus, session.deck.units);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::VtkWrite& command) {
    OwnValues values;
    for (const auto& joint : session.engine.joints.loaded())
        for (auto& value : joint_values(*joint))
            values[joint->name][value.name] = [of = std::move(value.of)](const Model& model, Row row) {
                return of(model, row).value_or(std::nan(""));
            };
    session.vtk.write(session.engine.model, command.file, values);
}

void run(Session& session, const lang::Ignored& command) {
    session.note_once(fmt::format("'{}' is read and ignored", command.word), command.instead);
}

void add_handlers(HandlerTable& table, lang::FileCommands list) { fill(table, list); }

} // namespace kaya
