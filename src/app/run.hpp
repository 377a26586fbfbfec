// One run of the program: decks from the command line, a journal, or the prompt.
#pragma once

#include "commands/session.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// The status that a shell gives to a program whose reader went away; nothing is said then.
inline constexpr int nobody_reads = 141;

/// The message of a run that the system gave no more memory.
inline constexpr const char* no_memory = "there is not enough memory for this model";

/// What the command line says about a run.
struct RunOrder {
    Options options;
    std::filesystem::path started_in; ///< folders of the command line and of the environment are counted from there
    std::string into;                 ///< folder of the files that the run writes
    std::vector<std::string> decks;
    std::vector<std::string> parameters; ///< NAME=VALUE
    std::string journal;                 ///< of `replay`
    bool no_journal = false;
    std::optional<int> watch;                                ///< port on which a browser can look on; 0: any
    std::function<void(Session&)> begun;                     ///< after the parameters, before the first deck
    std::function<void(Session&)> ended;                     ///< after the last deck, when all went well
    std::function<void(Session&, const Diagnostic&)> failed; ///< after the message
};

/// The folder of the program itself: joint models that ship lie next to it.
std::filesystem::path program_folder(const char* called_as);

/// Where joint models are looked for, first match wins; next to the deck last.
std::vector<std::filesystem::path> joint_folders(const RunOrder& order, const std::filesystem::path& program);

/// What a run of these decks may do without --trust.
Gate::Policy policy_of(const RunOrder& order, const std::filesystem::path& program);

/// Decks are there before anything is written: a misspelt command leaves no journal. Then the run goes to its folder.
void prepare_run(RunOrder& order, const CLI::App& app);

/// Gives the exit status.
int run(RunOrder& order, const std::filesystem::path& program);

} // namespace kaya
