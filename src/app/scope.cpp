#include "app/scope.hpp"

#include "app/adapter_cache.hpp"
#include "app/command_line.hpp"
#include "app/permissions.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

using enum Programs;

// clang-format off
const std::array table{
    Scope{"run", "decks and what they name", "what decks name, the journal, the autosave", "kaya-painter", {}, {}, {}},
    Scope{"replay", "the journal and what it names", "what the journal names", "kaya-painter", {}, {}, {}},
    Scope{"check", "decks, the files that they call", "nothing", "nothing", {"deck"}, {}, {}},
    Scope{"fmt", "decks", "the decks, with --write", "nothing", {"deck"}, {}, {}},
    Scope{"convert", "decks", "the decks, with --write", "nothing", {"deck"}, {}, {}},
    Scope{"info", "a save file", "nothing", "nothing", {"file"}, {}, {}},
    Scope{"diff", "two save files", "nothing", "nothing", {"file"}, {}, {}},
    Scope{"export", "a save file", "the tables in FILE-tables or --into", "nothing", {"file"}, {"--into"}, {}},
    Scope{"report", "save files, joint models", "the page FILE.html or --out", "nothing", {"file"}, {}, {"--out"}},
    Scope{"jtest", "a joint model, a CSV file", "NAME.csv, .gp, .png", "gnuplot", {"model", "path"}, {}, {"--output"}, installed},
    Scope{"jfit", "a joint model, a CSV file", "NAME.csv, .gp, .png", "gnuplot", {"model", "path"}, {}, {"--output"}, installed},
    Scope{"ztest", "a zone model, a CSV file", "NAME.csv, .gp, .png", "gnuplot", {"model", "path"}, {}, {"--output"}, installed},
    Scope{"jmodel build", "sources and headers", "the library; the list of what is allowed", "the compiler", {"source"}, {"--into"}, {}, compiler, true},
    Scope{"zmodel build", "sources and headers", "the library; the list of what is allowed", "the compiler", {"source"}, {"--into"}, {}, compiler, true},
    Scope{"new-jmodel", "joint models", "the folder NAME", "nothing", {}, {}, {}},
    Scope{"new-zmodel", "zone models", "the folder NAME", "nothing", {}, {}, {}},
    Scope{"plugin list", "joint and zone models", "nothing", "nothing", {"model"}, {}, {}},
    Scope{"study", "the study, its deck, measured curves", "the folder of the study", "kaya-painter, sbatch, squeue", {"study"}, {"--into"}, {}, installed},
    Scope{"study show", "the folder of the study", "nothing", "nothing", {"folder"}, {}, {}},
    Scope{"study rerun", "the folder of the study, its deck", "a deck and a folder of one run", "kaya-painter", {"folder"}, {}, {}, installed},
    Scope{"study work", "the folder of the study, its deck", "folders of runs", "kaya-painter", {"folder", "--from"}, {}, {}, installed},
    Scope{"lsp", "decks that the editor opens, the files that they call", "nothing", "nothing", {}, {}, {}},
    Scope{"allow", "folders and libraries that are named", "the list of what is allowed", "nothing", {"path"}, {}, {}, none, true},
    Scope{"explain", "nothing", "nothing", "nothing", {}, {}, {}},
    Scope{"help", "nothing", "nothing", "nothing", {}, {}, {}},
    Scope{"completion", "nothing", "nothing", "nothing", {}, {}, {}},
    Scope{"manual", "nothing", "nothing", "nothing", {}, {}, {}},
};
// clang-format on

/// The subcommand that was chosen, and its words: "jmodel build".
const CLI::App& chosen_command(const CLI::App& app, std::string& words) {
    const auto chosen = app.get_subcommands();
    if (chosen.empty()) return app;
    words += (words.empty() ? "" : " ") + chosen.front()->get_name();
    return chosen_command(*chosen.front(), words);
}

std::vector<std::string> words_given(const CLI::App& command, const std::vector<const char*>& options) {
    std::vector<std::string> words;
    for (const char* name : options)
        if (const auto* option = command.get_option_no_throw(name)) {
            const auto given = option->results();
            words.insert(words.end(), given.begin(), given.end());
        }
    return words;
}

} // namespace

std::span<const Scope> scopes() { return table; }

std::string scope_table() {
    std::string text = "| subcommand | reads | writes | starts |\n|---|---|---|---|\n";
    for (const auto& scope : table)
        text += fmt::format("| {} | {} | {} | {} |\n", scope.command, scope.reads, scope.writes, scope.starts);
    return text;
}

void enter_scope(const CLI::App& app, const RunOrder& order, const fs::path& program) {
    if (order.options.trust) return;
    std::string words;
    const CLI::App& command = chosen_command(app, words);
    const auto scope = std::ranges::find(table, words, &Scope::command);
    if (scope == table.end())
        throw Diagnostic(fmt::format("'{}' has no scope", words), "please report this: src/app/scope.cpp lacks a row",
                         Fault::own);
    SandboxOrder sandbox;
    for (const auto& input : words_given(command, scope->inputs)) sandbox.inputs.push_back(deck_file(input));
    sandbox.joint_folders = joint_folders(order, program);
    for (const auto& folder : words_given(command, scope->folders)) sandbox.outputs.emplace_back(folder);
    for (const auto& file : words_given(command, scope->files))
        if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) sandbox.outputs.push_back(folder);
    if (const fs::path file = permissions_file(); scope->permissions && !file.empty())
        sandbox.kept = {file.parent_path(), file};
    if (scope->programs == compiler) sandbox.kept.push_back(cache_folder());
    sandbox.programs = scope->programs;
    const auto* queue = command.get_option_no_throw("--slurm");
    sandbox.connects = queue != nullptr && queue->count() > 0;
    shut_in(sandbox);
}

} // namespace kaya
