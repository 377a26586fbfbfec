#include "base/markup_text.hpp"

#include "base/terminal_text.hpp"

namespace kaya {

std::string markup_text(std::string_view text) {
    std::string result;
    for (const char c : terminal_text(text)) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else if (c == '\'') result += "&#39;";
        else result += c;
    }
    return result;
}

} // namespace kaya
