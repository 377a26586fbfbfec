// A deck with the files that it calls, bound before anything runs.
#pragma once

#include "lang/interp/bare_names.hpp"
#include "lang/interp/binder.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace kaya::lang {

/// All mistakes of a deck (at most 20). Caught as a Diagnostic it is the first of them.
class DeckErrors : public Diagnostic {
public:
    explicit DeckErrors(std::vector<Diagnostic> errors) : Diagnostic(errors.front()), all(std::move(errors)) {}
    std::vector<Diagnostic> all;
};

inline constexpr std::size_t most_errors_shown = 20;

/// More calls inside each other than this are a mistake (a file that writes and calls itself).
inline constexpr std::size_t deepest_call = 100;

struct BoundFile {
    struct Step {
        BoundCommand command;
        std::shared_ptr<const BoundFile> called; ///< of a call with a literal name
    };
    Source source;
    std::filesystem::path path; ///< empty for a text that does not come from a file
    std::vector<Step> steps;
};

/// Checks that need more than the table: does this FISH function compile? They run when the deck is bound, before any
/// command of it.
struct Checks {
    std::function<void(const std::any& command)> command;             ///< throws Diagnostic for a mistake
    std::function<void(const std::filesystem::path&)> before_reading; ///< may refuse a file; each deck and called file
};

/// Reads and binds the file `name` and all files that it calls, searched in `folders`. Throws DeckErrors with every mistake; parsing
/// continues after each. A called file that does not exist is not reported yet when a script before the call may write it. `names` are
/// those of the decks that ran before; the names of this deck are added to it.
std::shared_ptr<const BoundFile> bind_deck(const Language& language, const std::string& name,
                                           const std::vector<std::filesystem::path>& folders,
                                           const Checks* checks = nullptr, BareNames* names = nullptr);

/// The same for a text: a line typed at the prompt, a test, command ... endcommand of a script.
std::shared_ptr<const BoundFile> bind_text(const Language& language, Source source,
                                           const std::vector<std::filesystem::path>& folders,
                                           const Checks* checks = nullptr, BareNames* names = nullptr);

/// A deck that may hold mistakes: the statements that were bound, and the mistakes.
struct ReadDeck {
    std::shared_ptr<const BoundFile> file;
    std::vector<Diagnostic> problems; ///< in the order in which they were met
    BareNames names;
};

/// The same as bind_deck for `kaya check`: mistakes are returned and not thrown, however many there are.
/// Throws Diagnostic when the deck cannot be read at all.
ReadDeck read_deck(const Language& language, const std::string& name, const std::vector<std::filesystem::path>& folders,
                   const Checks* checks = nullptr);

/// The same for the text of a file that an editor has not saved; `path` is that of the file.
ReadDeck read_deck(const Language& language, Source source, const std::filesystem::path& path,
                   const std::vector<std::filesystem::path>& folders, const Checks* checks = nullptr);

/// True when the text is incomplete: a line to be continued, def without end. The prompt then reads another line.
bool needs_more(const Language& language, std::string_view text);

} // namespace kaya::lang
