// `kaya check`: the outlook of each statement of a deck, without running it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// The outlook of a statement.
enum class Outlook {
    runs,
    ignored,       ///< it, or one of its words, is read and without effect
    doubtful,      ///< it runs, and its meaning is doubtful
    not_supported, ///< known, and not supported yet
    unknown,       ///< a word that is in no table
    wrong          ///< any other mistake
};

/// One statement that does not simply run.
struct ReportLine {
    std::string file; ///< as the deck or the call names it
    int line = 0, column = 0;
    Outlook outlook = Outlook::runs;
    std::string text; ///< the ignored text, or the message
    std::string hint;
    std::string code; ///< for `kaya explain`; may be empty
};

/// As editors number them: 1 error, 2 warning, 3 information.
int severity_of(Outlook outlook);

/// The word that a hint or a message proposes, x of "did you mean 'x'?"; empty when it proposes none.
std::string proposal_of(std::string_view text);

struct DeckReport {
    std::vector<ReportLine> lines;            ///< files in the order of their first call, lines ascending
    std::size_t statements = 0;               ///< in all files, including those inside FISH functions
    std::size_t count(Outlook outlook) const; ///< of lines
    bool can_run() const;
    /// "deck.3dd:12:5: not supported yet: ...", one for each line, and the counts.
    std::string text(const std::string& deck) const;
    /// One object of JSON per line of the report: file, line, column, severity, code, message, proposal.
    std::string json_lines() const;
};

/// Reads the text of a deck that an editor has not saved, as check_deck does; `file` is its file.
DeckReport check_text(const std::string& file, const std::string& text,
                      const std::vector<std::filesystem::path>& own_joints = {});

/// Reads a deck, the files that it calls, and the bodies of its FISH functions. Throws Diagnostic when the deck
/// itself cannot be read. `own_joints` are folders of models that may be loaded.
DeckReport check_deck(const std::string& deck, const std::vector<std::filesystem::path>& folders,
                      const std::vector<std::filesystem::path>& own_joints = {});

} // namespace kaya
