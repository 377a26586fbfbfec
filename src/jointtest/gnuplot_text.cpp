#include "jointtest/gnuplot_text.hpp"

#include "base/terminal_text.hpp"

namespace kaya {

std::string gnuplot_text(std::string_view text) {
    std::string quoted = "'";
    for (const char c : terminal_text(text)) {
        if (c == '\'') quoted += "''";
        else quoted += c == '\n' ? ' ' : c; // a line end would end the command
    }
    return quoted + "'";
}

} // namespace kaya
