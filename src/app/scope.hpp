// The files and ports that each subcommand may use: one table. `kaya info --scopes` prints it, and the gate is set from it.
#pragma once

#include "app/run.hpp"
#include "app/sandbox.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

struct Scope {
    std::string_view command;               ///< "study rerun"; "run": no subcommand
    std::string_view reads, writes, starts; ///< for the page
    std::vector<const char*> inputs;        ///< arguments and options that name files which are read, or folders
    std::vector<const char*> folders;       ///< options that name a folder to write into
    std::vector<const char*> files;         ///< options that name a file, or the beginning of its name, to write
    Programs programs = Programs::none;
    bool permissions = false; ///< it writes the list of what is allowed
};

std::span<const Scope> scopes();

/// `kaya info --scopes`: a row for each subcommand, as docs/safety.md shows them.
std::string scope_table();

/// Restricts the gate to the subcommand of the command line, unless --trust is given. A subcommand without a scope is refused.
void enter_scope(const CLI::App& app, const RunOrder& order, const std::filesystem::path& program);

} // namespace kaya
