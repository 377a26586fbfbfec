#include "system/keyboard.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace kaya {

namespace {

/// While it exists, keys arrive one by one, without echo, and none raises a signal.
class SingleKeys {
public:
    SingleKeys() : changed_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
        termios single = before_;
        single.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
        single.c_cc[VMIN] = 1;
        single.c_cc[VTIME] = 0;
        if (changed_) ::tcsetattr(STDIN_FILENO, TCSADRAIN, &single);
    }
    ~SingleKeys() {
        if (changed_) ::tcsetattr(STDIN_FILENO, TCSADRAIN, &before_);
    }
    SingleKeys(const SingleKeys&) = delete;
    SingleKeys& operator=(const SingleKeys&) = delete;

private:
    termios before_{};
    bool changed_;
};

bool more_waits() {
    constexpr int milliseconds = 20; // the bytes of one key come together
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return ::poll(&input, 1, milliseconds) > 0 && (input.revents & POLLIN) != 0;
}

} // namespace

bool has_keyboard() { return ::isatty(STDIN_FILENO) == 1; }

std::optional<char> read_key() {
    const SingleKeys single;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, -1) <= 0) return std::nullopt; // unlike a read it is not begun again after a signal
    char byte = 0;
    if (::read(STDIN_FILENO, &byte, 1) != 1) return std::nullopt;
    if (byte != key::escape || !more_waits()) return byte;
    while (more_waits() && ::read(STDIN_FILENO, &byte, 1) == 1) {}
    return key::none;
}

} // namespace kaya
