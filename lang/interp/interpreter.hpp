// Runs bound commands in order and keeps track of where in the deck it is.
#pragma once

#include "lang/interp/deck.hpp"
#include "lang/interp/value.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace kaya::lang {

/// Why a run came to its end.
enum class Ended { end_of_deck, quit };

/// Runs decks, command by command. A command may run further text (command ... endcommand of a script) on the
/// same interpreter while it is running.
class Interpreter {
public:
    /// The language is kept by reference. `run_command` does what a command says.
    Interpreter(const Language& language, std::function<void(const BoundCommand&)> run_command)
        : language_(language), run_command_(std::move(run_command)) {}

    // Set by the session that owns the interpreter; each may stay empty.
    ValueSource values;                                      ///< gives the value of @name and [expression]
    std::function<void(const BoundFile&, const BareNames&)> deck_read; ///< a whole deck, before its first command runs
    std::function<void(const Diagnostic&)> on_warning;       ///< warnings and notes
    std::function<void(const BoundCommand&)> before_command; ///< echo, log
    std::function<void(const BoundCommand&)> after_command;  ///< journal: the command has done its work
    std::function<void(const BoundCommand&)> failed_command; ///< the same for one that ends with an exception
    Checks checks;                                           ///< run when a deck is bound
    std::vector<std::filesystem::path> folders = {"."};      ///< where decks are looked for

    /// Binds the whole deck, then runs it. Throws DeckErrors before the first command runs, or the
    /// Diagnostic of the first command that fails, with its place and the lines that called.
    Ended run_file(const std::string& name);

    /// The same for a text. `name` and `first_line` are what messages call it: those of the script for
    /// command ... endcommand, "prompt" for a typed line.
    Ended run_text(const std::string& text, const std::string& name, int first_line = 1);

    /// Of the command that is running; none between commands.
    Place current_place() const { return frames_.empty() ? Place{} : frames_.back().place; }
    /// Folders of the file that is running and of those that called it, innermost first, then `folders`.
    std::vector<std::filesystem::path> searched() const;
    /// "called from base.3dd:12" for each file around the current one, innermost first.
    std::vector<std::string> call_chain() const;

    /// Hands a warning on, with the place of the running command unless it has one.
    void warn(Diagnostic warning) const;

private:
    struct Frame {
        std::filesystem::path folder;
        Place place;
    };

    Ended run(const BoundFile& file);
    Ended run_step(const BoundFile::Step& step);
    Ended run_call(const BoundFile::Step& step, const BoundCommand& command);

    const Language& language_;
    std::function<void(const BoundCommand&)> run_command_;
    BareNames names_;           ///< of all that was bound
    std::vector<Frame> frames_; ///< one for each file or text that is being run
};

} // namespace kaya::lang
