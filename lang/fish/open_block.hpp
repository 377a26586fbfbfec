// Blocks of FISH statements, and the words that close them.
#pragma once

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kaya::fish {

/// An open block: the statement that opened it, and the words that end it or one of its parts.
struct Block {
    std::string_view opening; ///< "loop", "if", "case_of", "section", "def"
    std::string_view closing; ///< shown in messages
    std::array<std::string_view, 5> closers;
    Place place;
};

inline constexpr std::array<std::string_view, 5> loop_closers{"endloop", "end_loop"};
inline constexpr std::array<std::string_view, 5> if_closers{"endif", "end_if", "else", "elseif"};
inline constexpr std::array<std::string_view, 5> case_closers{"endcase", "end_case", "case"};
inline constexpr std::array<std::string_view, 5> section_closers{"endsection", "end_section"};
inline constexpr std::array<std::string_view, 5> function_closers{"end"};

inline constexpr std::array<std::string_view, 14> all_closers{
    "endloop",  "end_loop", "endif",      "end_if",      "else",       "elseif",      "endcase",
    "end_case", "case",     "endsection", "end_section", "endcommand", "end_command", "end"};

template <class Words> bool is_one_of(std::string_view word, const Words& words) {
    return !word.empty() && std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace kaya::fish
