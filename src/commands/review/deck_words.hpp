// The words of decks: whether they use the parameters that they are run with, of `--set`, of studies and of Python.
#pragma once

#include "base/diagnostic.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// All words of decks and of the files that they read, in lower case.
class DeckWords {
public:
    /// False when the file, or one that it reads, cannot be read: then names are unknown.
    bool take(const std::filesystem::path& file);
    /// Names that `param` lines declare.
    const std::set<std::string>& declared() const { return declared_; }
    /// Throws Diagnostic at a parameter that no deck mentions. A property ('prop 1 jfric') is not checked here: the run reports whether it
    /// was set.
    void require(const std::string& name, const Place& place) const;

private:
    bool take_line(const std::string& line, const std::filesystem::path& folder);

    std::set<std::filesystem::path> files_;
    std::set<std::string> words_, declared_;
};

/// Those of all decks; none when they are unknown before the run.
std::optional<DeckWords> words_of_decks(const std::vector<std::string>& decks);

} // namespace kaya
