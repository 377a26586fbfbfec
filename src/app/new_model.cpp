#include "app/new_model.hpp"

#include "app/model_templates.hpp"
#include "base/diagnostic.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

std::string filled(std::string text, const std::string& name) {
    constexpr std::string_view mark = "@NAME@";
    for (auto at = text.find(mark); at != text.npos; at = text.find(mark, at + name.size()))
        text.replace(at, mark.size(), name);
    return text;
}

bool can_be_typed(const std::string& name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    return !name.empty() && name[0] >= 'a' && name[0] <= 'z' && std::all_of(name.begin(), name.end(), allowed);
}

} // namespace

std::vector<fs::path> write_new_model(std::span<const std::string_view> kinds, const NewModel& model) {
    const std::string& name = model.name;
    if (!can_be_typed(name))
        throw Diagnostic(fmt::format("'{}' cannot be the name of a model", name),
                         "use lower-case letters, digits, hyphens and underscores, a letter first");
    if (std::ranges::find(model.taken, name) != model.taken.end())
        throw Diagnostic(fmt::format("there is a model named '{}' already", name),
                         fmt::format("two models of one name cannot be loaded: take another, such as my-{}", name));
    const fs::path folder = model.in / name;
    if (fs::exists(folder))
        throw Diagnostic(fmt::format("{} is there already", folder.string()), "give another name, or remove it");
    if (const auto failed = door::make_folders(folder, Use::write))
        throw Diagnostic(fmt::format("the folder {} cannot be made: {}", folder.string(), failed.message()), {},
                         Fault::run);
    std::vector<fs::path> files;
    for (const auto& each : model_templates()) {
        if (std::ranges::find(kinds, each.kind) == kinds.end()) continue;
        files.push_back(folder / filled(std::string(each.file), name));
        write_whole_file(files.back().string(), filled(std::string(each.text), name));
    }
    return files;
}

} // namespace kaya
