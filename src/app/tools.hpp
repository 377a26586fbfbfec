// Tools for decks other than running them.
#pragma once

#include "commands/session/session.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace kaya {

/// `kaya report`: the page of a saved model, over time when there are several. Gives its name. Throws Diagnostic.
std::string write_report(const std::vector<std::string>& saved, const std::string& page,
                         const std::vector<std::filesystem::path>& joint_folders);

/// `kaya export`: a folder with the tables of a saved model, and its files for ParaView if asked. Gives the names of the files. Throws Diagnostic.
std::vector<std::string> export_saved(const std::string& saved, const std::string& folder, bool paraview);

enum class Formatting { show, write, check };

/// `kaya convert`: shows decks in the words of the other dialect, or writes them into the files, and lists what stays as it is. Returns the
/// exit status.
int convert_decks(const std::vector<std::string>& decks, const std::string& to, bool write, Output& output);

/// `kaya fmt`: shows decks in their long form, writes it into the files, or names those that differ from it. Returns the exit status.
int format_decks(const std::vector<std::string>& decks, Formatting what, Output& output);

} // namespace kaya
