// Errors of a command line, and the folder of a run.
#pragma once

#include "base/diagnostic.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace kaya {

/// The parser's error in this program's words, with a proposal.
Diagnostic mistake_of(const CLI::App& app, const CLI::ParseError& error);

/// The message for a missing deck whose name looks like a command.
std::optional<Diagnostic> misspelt_command(const CLI::App& app, const std::string& deck);

/// The file of a deck that the command line names: - is the standard input.
std::string deck_file(const std::string& name);

/// Throws Diagnostic when a deck does not exist; proposes the command that was meant, or the file.
void require_decks(const CLI::App& app, const std::vector<std::string>& decks);

/// Makes the folder if it has to, and works there from now on; decks and journal are named from there. Throws Diagnostic.
void go_into(const std::string& folder, std::vector<std::string>& decks, std::string& journal);

/// The file that `save NAME` has written: with the ending that it adds when there is none of the name itself.
std::string find_saved(const std::string& name);

/// Differences of two saved models. A file that cannot be read is a failure, not a difference.
std::string difference_of(const std::vector<std::string>& files);

} // namespace kaya
