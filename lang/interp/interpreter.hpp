// Runs bound commands in order and tracks the place in the deck.
#pragma once

#include "lang/interp/deck.hpp"
#include "lang/interp/value.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace kaya::lang {

/// Why a run ended.
enum class Ended { end_of_deck, quit };

/// What an interpreter needs of its owner: handlers of commands, values of names, and listeners to its progress.
class InterpreterHost {
public:
    virtual ~InterpreterHost() = default;
    virtual void run(const BoundCommand& command) = 0;
    /// The value of @name and [expression].
    virtual Value value(const std::string& expression, const Place& place) = 0;
    virtual void deck_read(const BoundFile&, const BareNames&) {} ///< a whole deck, before its first command runs
    virtual void warning(const Diagnostic&) {}                    ///< warnings and notes
    virtual void before(const BoundCommand&) {}                   ///< echo, log
    virtual void after(const BoundCommand&) {}                    ///< journal: the command has done its work
    virtual void failed(const BoundCommand&) {}                   ///< the same for one that ends with an exception
};

/// Runs decks, command by command. A command may run further text (command ... endcommand of a script) on the
/// same interpreter while it is running.
class Interpreter {
public:
    /// Keeps references to both.
    Interpreter(const Language& language, InterpreterHost& host) : language_(language), host_(host) {}

    Checks checks;                                      ///< run when a deck is bound
    std::vector<std::filesystem::path> folders = {"."}; ///< where decks are searched

    /// Binds the whole deck, then runs it. Throws DeckErrors before the first command runs, or the
    /// Diagnostic of the first command that fails, with its place and the lines that called.
    Ended run_file(const std::string& name);

    /// The same for a text. `name` and `first_line` are its name and line in messages: those of the script for command ... endcommand,
    /// "prompt" for a typed line.
    Ended run_text(const std::string& text, const std::string& name, int first_line = 1);

    /// Of the command that is running; none between commands.
    Place current_place() const { return frames_.empty() ? Place{} : frames_.back().place; }
    /// Folders of the running file and of its callers, innermost first, then `folders`.
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
    InterpreterHost& host_;
    BareNames names_;           ///< of all that was bound
    std::vector<Frame> frames_; ///< one for each file or text that is being run
};

} // namespace kaya::lang
