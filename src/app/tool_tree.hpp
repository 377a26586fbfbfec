// Subcommands and options as plain rows, for completion scripts and the manual.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace kaya {

struct ToolOption {
    std::vector<std::string> names; ///< "--into", "-q"; of an argument its name alone
    std::string help;
    bool argument = false;    ///< given by its place
    bool takes_value = false; ///< --into FOLDER; a flag does not
    bool required = false;
};

struct ToolNode {
    std::string words; ///< "study rerun"; "" for a run
    std::string help;
    std::vector<std::string> subcommands;
    std::vector<ToolOption> options;
};

/// The program itself first, then its subcommands, each before its own.
std::vector<ToolNode> tool_tree(const CLI::App& app);

} // namespace kaya
