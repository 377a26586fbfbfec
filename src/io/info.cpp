#include "io/info.hpp"

#include "base/counted.hpp"

#include "io/history_csv.hpp"
#include "io/save.hpp"
#include "model/whole/state_hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace kaya {

namespace {

void add_line(std::string& text, const char* name, const std::string& value) {
    text += fmt::format("{:<16}{}\n", name, value);
}

/// Deformable and rigid blocks, with their numbers of zones and gridpoints.
std::string describe_blocks(const Model& model) {
    const auto& deformable = model.blocks.deformable;
    const auto zoned =
        deformable.size() - static_cast<std::size_t>(std::count(deformable.begin(), deformable.end(), 0));
    return fmt::format("{} ({} deformable), {} gridpoints, {} zones, {} faces", model.blocks.size(), zoned,
                       model.gridpoints.size(), model.zones.size(), model.faces.size());
}

/// Contacts by joint model, in order of their names.
std::string describe_joint_models(const Model& model) {
    std::map<std::string, int> contacts_of;
    for (const Row row : model.contacts.properties)
        ++contacts_of[row == no_row ? "none" : model.joint_properties[static_cast<std::size_t>(row)].model];
    std::string text;
    for (const auto& [name, count] : contacts_of)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, counted(count, "contact"));
    return text.empty() ? "none" : text;
}

std::size_t lines_in(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) +
           (!text.empty() && text.back() != '\n' ? 1 : 0);
}

/// An item of scripts in the words of a user.
std::string what_is(const std::string& item) {
    return item == "scripts" ? "functions, variables and tables of FISH and Lua" : item;
}

} // namespace

std::string describe_save_file(const std::string& path) {
    Model model;
    const SaveExtras extras = restore_state(model, path);
    std::string text;
    add_line(text, "file", fmt::format("{} (format {})", path, extras.format));
    add_line(text, "written by", "kaya " + extras.program_version);
    add_line(text, "read by",
             fmt::format("this program and later ones; none that is older than format {}", extras.format));
    if (!extras.missing.empty())
        add_line(text, "not in it", fmt::format("{}; as in a new model", fmt::join(extras.missing, ", ")));
    if (!extras.title.empty()) add_line(text, "title", extras.title);
    const Units units = units_of(extras);
    if (units.given()) add_line(text, "units", units.name());
    add_line(text, "cycle", std::to_string(model.clock.cycle));
    add_line(text, "time",
             fmt::format("{:g}{}, step {:g}", model.clock.time,
                         model.settings.mass_scaling == MassScaling::none ? "" : " (density is scaled)",
                         model.clock.time_step));
    add_line(text, "unbalanced",
             fmt::format("force {:g}, average ratio {:g}", model.clock.unbalanced_force, model.clock.average_ratio));
    add_line(text, "blocks", describe_blocks(model));
    add_line(text, "contacts", fmt::format("{}, {} sub-contacts", model.contacts.size(), model.sub_contacts.size()));
    add_line(text, "joint models", describe_joint_models(model));
    add_line(text, "histories",
             fmt::format("{}, {}, every {}", model.histories.all.size(), counted(model.histories.time.size(), "sample"),
                         model.histories.interval == 1 ? "cycle" : counted(model.histories.interval, "cycle")));
    for (const auto& history : model.histories.all) add_line(text, "", units.in_brackets(column_title(history)));
    for (const auto& deck : extras.decks)
        add_line(text, "deck", fmt::format("{}, {}", deck.name, counted(lines_in(deck.content), "line")));
    for (const auto& script : extras.scripts)
        if (script.name == remark_item) add_line(text, "remark", script.content);
        else add_line(text, "also", fmt::format("{}, {} bytes", what_is(script.name), script.content.size()));
    add_line(text, "state hash", fmt::format("{:016x}", state_hash(model)));
    return text;
}

} // namespace kaya
