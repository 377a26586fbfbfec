// One run of the program: decks from the command line, a journal, or the prompt.
#pragma once

#include "commands/session/session.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

/// The status that a shell gives to a program whose reader closed the pipe; no message is printed.
inline constexpr int nobody_reads = 141;

/// The message of a run that the system gave no more memory.
inline constexpr const char* no_memory = "there is not enough memory for this model";

/// Settings of a run from the command line.
struct RunOrder {
    Options options;
    std::filesystem::path started_in; ///< folders of the command line and of the environment are counted from there
    std::string into;                 ///< folder of the files that the run writes
    std::vector<std::string> decks;
    std::vector<std::string> parameters; ///< NAME=VALUE
    std::string journal;                 ///< of `replay`
    bool no_journal = false;
    std::optional<int> watch;                                ///< port for watching the run in a browser; 0: any
    std::function<void(Session&)> begun;                     ///< after the parameters, before the first deck
    std::function<void(Session&)> ended;                     ///< called after the last deck, on success
    std::function<void(Session&, const Diagnostic&)> failed; ///< after the message
};

/// The folder of the program itself: joint models that ship lie next to it.
std::filesystem::path program_folder(const char* called_as);

/// Folders of the joint models that ship.
std::vector<std::filesystem::path> own_joint_folders(const std::filesystem::path& program);

/// Folders searched for joint models, first match wins; beside the deck last.
std::vector<std::filesystem::path> joint_folders(const RunOrder& order, const std::filesystem::path& program);

/// Permissions of a run of these decks without --trust.
Gate::Policy policy_of(const RunOrder& order, const std::filesystem::path& program);

/// Checks that the decks exist before anything is written, so a misspelt command leaves no journal; then changes to the folder of the run.
void prepare_run(RunOrder& order, const CLI::App& app);

/// Where the current folder, or that of one of the files, is the home folder or /: a run may write all below it that is not hidden.
std::optional<Diagnostic> warning_of_wide_folder(const std::vector<std::string>& files);

/// Gives the exit status.
int run(RunOrder& order, const std::filesystem::path& program);

} // namespace kaya
