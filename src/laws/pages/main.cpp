// joint_pages MODELS PAGES [--check]: puts the tables of properties and of history of every joint model in the folder MODELS, or of every
// zone model if the folder is called `zones`, into its page in the folder PAGES. The rest of a page is written by hand and kept. With
// --check nothing is written, and the status is 1 when a page does not agree with its model.
#include "base/diagnostic.hpp"
#include "laws/joint_model.hpp"
#include "system/generated_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using kaya::LawTable;
using Lines = std::vector<std::string>;

std::string limits_of(const LawTable::Property& p) {
    if (std::isinf(p.minimum) && std::isinf(p.maximum)) return "any";
    if (std::isinf(p.maximum)) return fmt::format("from {:g}", p.minimum);
    if (std::isinf(p.minimum)) return fmt::format("to {:g}", p.maximum);
    return fmt::format("{:g} to {:g}", p.minimum, p.maximum);
}

std::string initial_of(const LawTable::Property& p) {
    if (!std::isnan(p.initial)) return fmt::format("{:g}", p.initial);
    return p.optional ? "not given" : "must be given";
}

std::string in_code(const std::string& words) { return words.empty() ? "" : fmt::format("`{}`", words); }

Lines property_table(const LawTable& model) {
    Lines rows = {"| name | other words | unit | limits | initial | meaning |", "|---|---|---|---|---|---|"};
    for (const auto& p : model.properties)
        rows.push_back(fmt::format("| `{}` | {} | {} | {} | {} | {} |", p.name,
                                   in_code(fmt::format("{}", fmt::join(p.aliases, " "))), p.unit, limits_of(p),
                                   initial_of(p), p.help));
    return rows;
}

Lines history_table(const LawTable& model) {
    if (model.history.empty()) return {};
    Lines rows = {"| history | unit | meaning |", "|---|---|---|"};
    for (const auto& h : model.history) rows.push_back(fmt::format("| `{}` | {} | {} |", h.name, h.unit, h.help));
    return rows;
}

Lines lines_of(const std::string& text) {
    Lines lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The page with the first table of a section replaced, or added under the heading if the section has none. Throws kaya::Diagnostic when
/// the heading is missing.
Lines with_table(const Lines& page, const std::string& heading, const Lines& table, const fs::path& file) {
    const auto is_row = [](const std::string& line) { return line.starts_with("|"); };
    const auto head = std::find(page.begin(), page.end(), heading);
    if (head == page.end())
        throw kaya::Diagnostic(fmt::format("{} has no heading '{}'", file.string(), heading), "add it");
    const auto end = std::find_if(head + 1, page.end(), [](const std::string& l) { return l.starts_with("## "); });
    const auto first = std::find_if(head + 1, end, is_row);
    Lines made;
    if (first == end) {
        made.assign(page.begin(), head + 1);
        if (!table.empty()) made.emplace_back();
        made.insert(made.end(), table.begin(), table.end());
        made.insert(made.end(), head + 1, page.end());
        return made;
    }
    made.assign(page.begin(), first);
    made.insert(made.end(), table.begin(), table.end());
    made.insert(made.end(), std::find_if_not(first, end, is_row), page.end());
    return made;
}

/// The models of a folder. `registry` owns them.
std::vector<const LawTable*> models_in(const fs::path& folder, kaya::JointRegistry& registry) {
    registry.set_path({folder});
    std::vector<const LawTable*> models;
    const auto take = [&](auto& list) {
        for (const auto& name : list.available()) models.push_back(&list.get(name));
    };
    if (folder.filename() == "zones") take(registry.zones);
    else take(registry);
    return models;
}

int write_pages(const fs::path& folder, const fs::path& pages, bool check) {
    kaya::JointRegistry registry;
    std::map<fs::path, std::string> wanted;
    for (const LawTable* model : models_in(folder, registry)) {
        const fs::path file = pages / (model->name + ".md");
        Lines page = with_table(lines_of(kaya::text_of_file(file)), "## Properties", property_table(*model), file);
        page = with_table(page, "## States and history", history_table(*model), file);
        wanted[file] = fmt::format("{}\n", fmt::join(page, "\n"));
    }
    return kaya::write_generated(wanted, check, "its tables are not those of the model: run joint_pages");
}

} // namespace

int main(int argc, char** argv) {
    const bool check = argc == 4 && std::string(argv[3]) == "--check";
    if (argc != 3 && !check) {
        std::cerr << "usage: joint_pages MODELS PAGES [--check]\n";
        return 2;
    }
    try {
        return write_pages(argv[1], argv[2], check);
    } catch (const kaya::Diagnostic& error) {
        std::cerr << kaya::render(error) << '\n';
        return 1;
    }
}
