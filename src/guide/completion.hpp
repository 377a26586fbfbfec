// Completion at the prompt: words of the language, and names that the session knows.
#pragma once

#include "commands/session/session.hpp"
#include "lang/modern/language.hpp"

#include <string>
#include <vector>

namespace kaya {

struct Proposals {
    std::size_t typed = 0;          ///< letters at the end of the line that the words begin with
    std::vector<std::string> words; ///< sorted
};

/// For a line up to the cursor. `before` are the lines of an unfinished function or chunk above it. The words of commands are those of
/// `language`: of both dialects or of one.
Proposals proposals(const Session& session, const std::string& before, const std::string& line,
                    const lang::Language& language = lang::language());

/// Words in lines of at most `width` letters, broken between words only.
std::string filled(const std::vector<std::string>& words, std::size_t width);

} // namespace kaya
