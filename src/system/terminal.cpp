#include "system/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace kaya {

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

std::size_t columns_of(std::FILE* terminal) {
    winsize size{};
    return ::ioctl(::fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace kaya
