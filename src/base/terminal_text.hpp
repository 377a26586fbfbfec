// Text for a terminal: without the characters that a terminal obeys, which text of decks, saves and libraries may contain.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace kaya {

/// The first character of a text as a terminal may get it.
struct TerminalCharacter {
    std::size_t taken; ///< bytes of the text
    std::size_t size;  ///< of `bytes`
    char bytes[4];
};

/// The character itself; or its first byte as \x1b if it is a control character other than newline and tab, a character that changes the direction
/// of writing, or invalid UTF-8. The text is not empty. Allocates nothing: signal handlers call it.
TerminalCharacter first_for_terminal(std::string_view text);

/// The whole text in this form.
std::string terminal_text(std::string_view text);

/// Writes terminal_text(text), and allocates nothing. False when not all of it was written.
bool print_text(std::FILE* stream, std::string_view text);

/// The only control sequence that kaya sends apart from colours: clears the line of the cursor and returns to its left end.
void clear_line(std::FILE* terminal);

} // namespace kaya
