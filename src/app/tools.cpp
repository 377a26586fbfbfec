#include "app/tools.hpp"

#include "commands/model_world.hpp"
#include "lang/commands/language.hpp"
#include "lang/fish/reserved.hpp"
#include "lang/interp/help.hpp"
#include "lang/interp/format.hpp"

#include <fmt/format.h>
#include <fstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

std::string about_field(const script::FieldInfo& field, std::string_view table) {
    std::string text = table.empty() ? fmt::format("model.{}", field.name) : fmt::format("{}.{}", table, field.name);
    if (!field.classic.empty()) text += fmt::format(", in FISH {}{}", field.classic, table.empty() ? "" : "(pointer)");
    return fmt::format("{}\n    {}{}{}\n", text, field.help,
                       field.unit == "-" ? "" : fmt::format(" [{}]", field.unit),
                       field.writable ? "; can be set" : "");
}

/// A quantity of the model by its name in FISH or Lua, or a name of FISH that is not supported; empty when neither.
std::string about_name(std::string_view name) {
    Model model;
    JointRegistry joints;
    const ModelWorld world(model, joints);
    std::string text;
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

/// The new text takes the place of the old one as a whole or not at all.
void replace(const fs::path& file, const std::string& text) {
    fs::path beside = file;
    beside += ".tmp";
    std::ofstream stream(beside, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code problem;
    if (stream.good()) {
        fs::permissions(beside, fs::status(file, problem).permissions(), problem);
        fs::rename(beside, file, problem);
    }
    if (stream.good() && !problem) return;
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw Diagnostic(fmt::format("'{}' cannot be written", file.string()), "is it write-protected, or the disk full?",
                     Fault::run);
}

} // namespace

std::string help_text(const std::string& words) {
    if (words.empty()) return lang::help_list(lang::classic());
    try {
        return lang::help_on(lang::classic(), words);
    } catch (const Diagnostic&) {
        const std::string text = about_name(lang::fold(words));
        if (text.empty()) throw;
        return text;
    }
}

int format_decks(const std::vector<std::string>& decks, bool in_place, Output& output) {
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const fs::path path = lang::find_deck(deck, {"."});
            const auto source = lang::read_source(path, deck);
            const std::string text = lang::format_deck(lang::classic(), source);
            if (in_place) replace(path, text);
            else output.print(text);
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

} // namespace kaya
