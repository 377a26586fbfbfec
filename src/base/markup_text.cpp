#include "base/markup_text.hpp"

namespace kaya {

std::string markup_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else if (c == '\'') result += "&#39;";
        else if (static_cast<unsigned char>(c) >= 32 || c == '\n' || c == '\t') result += c;
    }
    return result;
}

} // namespace kaya
