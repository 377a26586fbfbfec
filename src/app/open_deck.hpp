// A deck that an editor shows: its statements, functions and names, whatever mistakes it has.
#pragma once

#include "lang/interp/lexer.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// A place in a deck; line and byte of the line count from 0.
struct Spot {
    int line = 0;
    std::size_t byte = 0;
};

/// Positions of editors count characters of UTF-16.
std::size_t utf16_of(std::string_view line, std::size_t byte);
std::size_t byte_of(std::string_view line, std::size_t utf16);

class OpenDeck {
public:
    explicit OpenDeck(std::string_view text);

    /// A piece of a line.
    struct Piece {
        int line = 0;
        std::size_t begin = 0, end = 0;
    };
    struct FishFunction {
        std::string name; ///< as typed
        Piece piece;      ///< of the name where it is defined
        std::string head; ///< its first line, and the comments above it
    };
    /// A statement: its lines, and those of its body (a function, Lua).
    struct Stretch {
        lang::Statement statement;
        int first = 0, last = 0; ///< lines, body and continued lines included
        int body = 0;            ///< first line of the body; after `last` when there is none
        bool lua = false;
    };

    const std::vector<std::string>& lines() const { return lines_; }
    const std::vector<Stretch>& stretches() const { return stretches_; }
    const std::vector<FishFunction>& functions() const { return functions_; }
    const FishFunction* function(std::string_view folded) const;
    const Stretch* stretch_at(int line) const;

    /// The name or word around a place.
    std::optional<Piece> word_at(const Spot& spot) const;
    std::string text_of(const Piece& piece) const;

    /// Where FISH reads a name: in functions, after @, in brackets and, when it `is_function`, as the line of a call and in commands that
    /// name functions.
    std::vector<Piece> uses_of(std::string_view folded, bool is_function) const;
    /// All names of FISH in functions, brackets and after @, sorted, as typed first.
    std::vector<std::string> names() const;
    /// Whether a place is in a function, in brackets or after @.
    bool in_fish(const Spot& spot) const;

    /// What completion reads: the line up to the place with the lines that it continues, and the lines of the function above it.
    struct Typed {
        std::string before, line;
    };
    Typed typed_at(const Spot& spot) const;

private:
    void find_functions();
    /// Calls see(piece, folded name) for each name of FISH.
    template <class See> void for_each_name(const See& see) const;

    std::vector<std::string> lines_;
    std::vector<Stretch> stretches_;
    std::vector<FishFunction> functions_;
};

} // namespace kaya
