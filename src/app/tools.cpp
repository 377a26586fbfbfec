#include "app/tools.hpp"

#include "app/command_line.hpp"
#include "app/fish_help.hpp"
#include "app/run_report.hpp"

#include "base/door.hpp"
#include "commands/world/model_world.hpp"
#include "commands/session/save_session.hpp"
#include "io/field_csv.hpp"
#include "io/history_csv.hpp"
#include "base/whole_file.hpp"
#include "laws/joint_model.hpp"
#include "report/report.hpp"
#include "report/scene_data.hpp"
#include "lang/modern/language.hpp"
#include "lang/fish/reserved.hpp"
#include "lang/interp/help.hpp"
#include "lang/interp/format.hpp"
#include "lang/modern/convert.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

std::string about_field(const script::FieldInfo& field, std::string_view table) {
    std::string text = table.empty() ? fmt::format("model.{}", field.name) : fmt::format("{}.{}", table, field.name);
    if (!field.classic.empty()) text += fmt::format(", in FISH {}{}", field.classic, table.empty() ? "" : "(pointer)");
    return fmt::format("{}\n    {}{}{}\n", text, field.help, field.unit == "-" ? "" : fmt::format(" [{}]", field.unit),
                       field.writable ? "; can be set" : "");
}

/// All names of fields, for proposals: "volume", "block.volume", "b_vol".
std::vector<std::string> field_names(const ModelWorld& world) {
    std::vector<std::string> names;
    const auto add = [&](const std::vector<script::FieldInfo>& fields, const std::string& table) {
        for (const auto& field : fields) {
            names.emplace_back(field.name);
            names.push_back(fmt::format("{}.{}", table, field.name));
            if (!field.classic.empty()) names.emplace_back(field.classic);
        }
    };
    add(world.globals(), "model");
    for (const auto& table : world.tables()) add(table.fields, std::string(table.name));
    return names;
}

/// A field by its name in Lua with its object: block.volume, model.time.
std::string about_lua_field(const ModelWorld& world, std::string_view name) {
    const auto point = name.find('.');
    if (point == name.npos) return {};
    const std::string_view object = name.substr(0, point), wanted = name.substr(point + 1);
    const auto in = [&](const std::vector<script::FieldInfo>& fields, std::string_view table) -> std::string {
        for (const auto& field : fields)
            if (field.name == wanted) return about_field(field, table);
        return {};
    };
    if (object == "model") return in(world.globals(), "");
    for (const auto& table : world.tables())
        if (table.name == object) return in(table.fields, table.name);
    return {};
}

/// A quantity of the model by its name in FISH or Lua, a statement or function of FISH, or a name of FISH that is not
/// supported; empty when none of these.
std::string about_name(std::string_view name) {
    Session session{Options{}};
    const ModelWorld& world = session.world;
    std::string text = about_lua_field(world, name);
    if (text.empty()) text = about_fish(name);
    for (const auto& [modern, classic] : session.scripts->newer_names())
        if (text.empty() && modern == name && modern != classic)
            text = fmt::format("{} is the newer name of {}\n{}", modern, classic, about_name(classic));
    if (!text.empty()) return text;
    const auto add = [&](const std::vector<script::FieldInfo>& fields, std::string_view table) {
        for (const auto& field : fields)
            if (field.classic == name || field.name == name) text += about_field(field, table);
    };
    add(world.globals(), "");
    for (const auto& table : world.tables()) add(table.fields, table.name);
    if (!text.empty()) return text;
    if (const auto* reserved = fish::find_reserved_family(name)) {
        const Diagnostic message = fish::reserved_message(name, *reserved);
        return fmt::format("{}\n    {}\n", message.message, message.hint);
    }
    return {};
}

} // namespace

std::string help_text(const std::string& words) {
    if (words.empty()) return lang::help_list(lang::language());
    try {
        return lang::help_on(lang::language(), words);
    } catch (Diagnostic& problem) {
        const std::string name = lang::fold(words), text = about_name(name);
        if (!text.empty()) return text;
        // Proposes the nearest field or function if no command is near.
        if (!problem.hint.starts_with("did you mean")) {
            const Session session{Options{}};
            auto names = field_names(session.world);
            for (const auto& [built_in, writable] : session.scripts->built_in_names()) names.push_back(built_in);
            const auto near = did_you_mean(name, {names.begin(), names.end()});
            if (!near.empty()) problem.hint = fmt::format("did you mean '{}'?", near);
        }
        throw;
    }
}

namespace {

/// Calls `work(path, source, name)` for each deck; mistakes are shown. Returns the exit status.
template <class Work> int for_each_deck(const std::vector<std::string>& decks, Output& output, Work work) {
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const fs::path path = lang::find_deck(deck, {"."});
            if (!work(path, lang::read_source(path, deck), deck)) status = static_cast<int>(Fault::deck);
        } catch (const lang::DeckErrors& errors) {
            for (const auto& error : errors.all) output.message(error);
            status = static_cast<int>(Fault::deck);
        } catch (const Diagnostic& error) {
            output.message(error);
            status = static_cast<int>(error.fault);
        }
    }
    return status;
}

} // namespace

int format_decks(const std::vector<std::string>& decks, Formatting what, Output& output) {
    return for_each_deck(decks, output, [&](const fs::path& path, const lang::Source& source, const std::string& deck) {
        const std::string text = lang::format_deck(lang::language(), source);
        if (what == Formatting::write) write_whole_file(path.string(), text);
        else if (what == Formatting::show) output.print_deck(text);
        else if (file_text(path) != text) {
            output.print(fmt::format("{} is not in its long form", deck));
            return false;
        }
        return true;
    });
}

int convert_decks(const std::vector<std::string>& decks, const std::string& to, bool write, Output& output) {
    return for_each_deck(decks, output, [&](const fs::path& path, const lang::Source& source, const std::string&) {
        const auto converted = lang::convert_deck(source, to == "modern" ? lang::To::modern : lang::To::classic);
        for (const auto& note : converted.kept) output.message(note);
        if (write) write_whole_file(path.string(), converted.text);
        else output.print_deck(converted.text);
        return true;
    });
}

std::string write_report(const std::vector<std::string>& saved, const std::string& page,
                         const std::vector<fs::path>& joint_folders) {
    ReportOrder order;
    order.source = "saved model";
    order.version = program_version();
    JointRegistry joints;
    joints.set_path(joint_folders);
    order.property_names = property_names_of(joints);
    // The last one is the model of the tables; the earlier ones are its history.
    Model model;
    SaveExtras extras;
    std::string file;
    for (std::size_t i = 0; i < saved.size(); ++i) {
        file = find_saved(saved[i]);
        extras = restore_state(model, file);
        if (i == 0) order.centre = report_centre(model);
        if (i + 1 < saved.size()) order.before.push_back(report_state(model, order.centre));
    }
    order.file = fs::path(file).filename().string();
    std::string name = page;
    if (name.empty()) {
        name = file.ends_with(save_ending) ? file.substr(0, file.size() - save_ending.size()) : file;
        name += ".html";
    }
    write_whole_file(name, report_of(model, extras, order));
    return name;
}

std::vector<std::string> export_saved(const std::string& saved, const std::string& folder, bool paraview) {
    const std::string file = find_saved(saved);
    Model model;
    const SaveExtras extras = restore_state(model, file);
    const std::string bare = file.ends_with(save_ending) ? file.substr(0, file.size() - save_ending.size()) : file;
    const fs::path into = folder.empty() ? fs::path(bare + "-tables") : fs::path(folder);
    if (const auto problem = door::make_folders(into, Use::write))
        throw Diagnostic(fmt::format("cannot make the folder {}: {}", into.string(), problem.message()),
                         "give another: --into FOLDER", Fault::run);
    std::vector<std::string> written;
    const auto write = [&](const std::string& name, const std::string& text) {
        written.push_back((into / name).string());
        write_whole_file(written.back(), text);
    };
    for (const ObjectKind kind : exported_kinds())
        write(fmt::format("{}.csv", info_of(kind).file), field_csv(model, kind));
    write("fields.csv", field_list_csv());
    if (!model.histories.all.empty()) write("histories.csv", history_csv(model.histories, {}, {}, units_of(extras)));
    for (std::size_t i = 0; i < extras.decks.size(); ++i)
        write(fmt::format("deck-{}-{}", i + 1, fs::path(extras.decks[i].name).filename().string()),
              extras.decks[i].content);
    if (!paraview) return written;
    const auto files = VtkSeries().write(model, (into / fs::path(bare).filename()).string());
    written.insert(written.end(), files.begin(), files.end());
    return written;
}

} // namespace kaya
