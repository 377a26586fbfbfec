#include "app/pager.hpp"

#include "base/terminal_text.hpp"
#include "commands/program/fitted.hpp"
#include "system/keyboard.hpp"

#include <algorithm>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace kaya {

namespace {

/// Asks below a page. False: no further page.
bool continues() {
    print_text(stdout, "-- more: the return key continues, q ends --");
    std::fflush(stdout);
    bool on = false;
    for (bool waits = true; waits;) {
        const auto pressed = read_key();
        on = pressed == '\n' || pressed == '\r' || pressed == ' ';
        waits = pressed && !on && *pressed != 'q' && *pressed != 'Q' && *pressed != key::escape &&
                *pressed != key::interrupt && *pressed != key::end;
    }
    clear_line(stdout); // the question goes
    std::fflush(stdout);
    return on;
}

} // namespace

Screen screen() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
    return {size.ws_col, size.ws_row};
}

void show_by_pages(Output& output, const std::string& text) {
    const bool terminal = has_keyboard() && isatty(STDOUT_FILENO) == 1;
    if (!terminal) return output.print(text);
    const std::size_t page = std::max<std::size_t>(screen().rows, 4) - 2;
    std::istringstream lines(fitted(text, screen().columns));
    std::string part;
    std::size_t shown = 0;
    for (std::string line; std::getline(lines, line); ++shown) {
        if (shown == page) {
            output.print(part);
            output.flush();
            part.clear();
            shown = 0;
            if (!continues()) return;
        }
        part += line + "\n";
    }
    output.print(part);
}

} // namespace kaya
