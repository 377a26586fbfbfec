// A message to the user that points at text. The only exception that means a user's mistake.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// A text being read: a deck, or a line typed at the prompt. Lines are kept for underlining.
struct SourceText {
    std::string name;               ///< as the user wrote it
    std::vector<std::string> lines; ///< without line ends
    bool is_file = false;           ///< otherwise a line that was typed or that a script gave
};

/// A piece of one line. Line and column count from 1; line 0 means "no place known".
struct Place {
    std::shared_ptr<const SourceText> source;
    int line = 0;
    int column = 0;
    int length = 1;

    explicit operator bool() const { return source && line > 0; }
};

enum class Severity { note, warning, error };

/// How an error ends the program; the number is the exit status.
enum class Fault {
    deck = 1, ///< the deck is wrong
    run = 2,  ///< the run failed: a joint model returned NaN, a disk is full, ...
    own = 3,  ///< our own fault
};

/// One message. `message` says what is wrong in the user's words; `hint` what to do
/// (shown after the underline: "did you mean 'brick'?"); `context` lines say where from
/// (cycle, call stack, block and place).
class Diagnostic : public std::exception {
public:
    explicit Diagnostic(std::string text, std::string advice = {}, Fault kind = Fault::deck)
        : message(std::move(text)), hint(std::move(advice)), fault(kind) {}

    Diagnostic& at(Place where) {
        if (!place) place = std::move(where);
        return *this;
    }
    Diagnostic& add(std::string line) {
        context.push_back(std::move(line));
        return *this;
    }

    const char* what() const noexcept override { return message.c_str(); }

    Severity severity = Severity::error;
    Place place;
    std::string code; ///< stable short name for `kaya explain`, e.g. "unknown-keyword"; may be empty
    std::string message;
    std::string hint;
    std::vector<std::string> context;
    Fault fault = Fault::deck;
};

/// The text shown to the user, with the line and an underline; colours and the code for `kaya explain` when asked for.
std::string render(const Diagnostic& diagnostic, bool colour = false, bool with_code = false);

/// The nearest of `candidates` to `word`, or empty when none is near enough to be meant.
std::string_view did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

} // namespace kaya
