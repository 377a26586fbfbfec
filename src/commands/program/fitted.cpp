#include "commands/program/fitted.hpp"

#include <algorithm>

namespace kaya {

namespace {

/// Number of visible characters: no colour codes, and one for all bytes of a character.
std::size_t visible(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\033') i = std::min(text.find('m', i), text.size());
        else count += (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    }
    return count;
}

/// A line of the deck: the underline below it counts its letters.
bool is_source_line(std::string_view line) {
    const auto number = line.find_first_not_of(' ');
    if (number == line.npos || line[number] < '0' || line[number] > '9') return false;
    return line.find_first_not_of("0123456789", number) == line.find(" | ", number);
}

/// The last blank before which the line fits; npos when there is none.
std::size_t place_to_break(std::string_view line, std::size_t columns) {
    std::size_t place = line.npos;
    const auto first_word = std::min(line.find_first_not_of(" |^"), line.size());
    for (auto blank = line.find(' ', first_word); blank != line.npos && visible(line.substr(0, blank)) <= columns;
         blank = line.find(' ', blank + 1))
        place = blank;
    return place;
}

} // namespace

std::string fitted(std::string_view text, std::size_t columns) {
    constexpr std::size_t least_room = 20;
    std::string result;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!result.empty()) result += '\n';
        // The text after an underline continues below it.
        const auto bar = line.find("| ");
        const bool underline = bar != line.npos && line.find_first_not_of(' ') == bar;
        const std::string indent(underline ? bar + 2 : 4, ' ');
        std::string head;
        while (!is_source_line(line) && head.size() + visible(line) > columns) {
            const auto cut = place_to_break(line, std::max(columns - std::min(columns, head.size()), least_room));
            if (cut == line.npos) break; // one word: the terminal breaks it
            result += head + std::string(line.substr(0, cut)) + '\n';
            line.remove_prefix(cut + 1);
            head = indent;
        }
        result += head + std::string(line);
    }
    return result;
}

} // namespace kaya
