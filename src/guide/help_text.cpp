#include "guide/help_text.hpp"

#include "commands/session/session.hpp"
#include "commands/world/model_world.hpp"
#include "guide/fish_help.hpp"
#include "lang/fish/reserved.hpp"
#include "lang/interp/help.hpp"
#include "lang/modern/language.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

std::string about_field(const script::FieldInfo& field, std::string_view table, const Units& units) {
    std::string text = table.empty() ? fmt::format("model.{}", field.name) : fmt::format("{}.{}", table, field.name);
    if (!field.classic.empty()) text += fmt::format(", in FISH {}{}", field.classic, table.empty() ? "" : "(pointer)");
    return fmt::format("{}\n    {}{}{}\n", text, field.help,
                       field.unit == "-" ? "" : fmt::format(" [{}]", units.label(field.unit)),
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
std::string about_lua_field(const ModelWorld& world, std::string_view name, const Units& units) {
    const auto point = name.find('.');
    if (point == name.npos) return {};
    const std::string_view object = name.substr(0, point), wanted = name.substr(point + 1);
    const auto in = [&](const std::vector<script::FieldInfo>& fields, std::string_view table) -> std::string {
        for (const auto& field : fields)
            if (field.name == wanted) return about_field(field, table, units);
        return {};
    };
    if (object == "model") return in(world.globals(), "");
    for (const auto& table : world.tables())
        if (table.name == object) return in(table.fields, table.name);
    return {};
}

/// A quantity of the model by its name in FISH or Lua, a statement or function of FISH, or a name of FISH that is not
/// supported; empty when none of these.
std::string about_name(std::string_view name, const Units& units) {
    Session session{Options{}};
    const ModelWorld& world = session.engine.world;
    std::string text = about_lua_field(world, name, units);
    if (text.empty()) text = about_fish(name);
    for (const auto& [modern, classic] : session.engine.scripts->newer_names())
        if (text.empty() && modern == name && modern != classic)
            text = fmt::format("{} is the newer name of {}\n{}", modern, classic, about_name(classic, units));
    if (!text.empty()) return text;
    const auto add = [&](const std::vector<script::FieldInfo>& fields, std::string_view table) {
        for (const auto& field : fields)
            if (field.classic == name || field.name == name) text += about_field(field, table, units);
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

std::string help_text(const std::string& words, const Units& units) {
    if (words.empty()) return lang::help_list(lang::language());
    try {
        return lang::help_on(lang::language(), words, units);
    } catch (Diagnostic& problem) {
        const std::string name = lang::fold(words), text = about_name(name, units);
        if (!text.empty()) return text;
        // Proposes the nearest field or function if no command is near.
        if (!problem.hint.starts_with("did you mean")) {
            const Session session{Options{}};
            auto names = field_names(session.engine.world);
            for (const auto& [built_in, writable] : session.engine.scripts->built_in_names()) names.push_back(built_in);
            const auto near = did_you_mean(name, {names.begin(), names.end()});
            if (!near.empty()) problem.hint = fmt::format("did you mean '{}'?", near);
        }
        throw;
    }
}

} // namespace kaya
