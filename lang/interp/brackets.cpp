#include "lang/interp/brackets.hpp"

namespace kaya::lang {

std::size_t past_closing(std::string_view line, std::size_t open, char opening, char closing) {
    int depth = 0;
    char quote = 0;
    for (std::size_t i = open; i < line.size(); ++i) {
        const char c = line[i];
        if (quote) {
            if (c == quote) quote = 0;
        } else if (c == '\'' || c == '"') quote = c;
        else if (c == opening) ++depth;
        else if (c == closing && --depth == 0) return i + 1;
    }
    return std::string_view::npos;
}

std::size_t past_last_closing(std::string_view line, std::size_t from, int& depth) {
    char quote = 0;
    for (std::size_t i = from; i < line.size(); ++i) {
        const char c = line[i];
        if (quote) {
            if (c == quote) quote = 0;
        } else if (c == ';') break;
        else if (c == '\'' || c == '"') quote = c;
        else if (c == '[') ++depth;
        else if (c == ']' && --depth == 0) return i + 1;
    }
    return std::string_view::npos;
}

} // namespace kaya::lang
