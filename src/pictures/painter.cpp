#include "pictures/painter.hpp"

#include "base/diagnostic.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya {

namespace {

constexpr int longest_wait = 60'000; // milliseconds; the painter gives up a little earlier itself

[[noreturn]] void no_picture(const std::string& why, const std::string& hint = {}) {
    throw Diagnostic("the picture cannot be made: " + why, hint, Fault::run);
}

/// In the new process: waits for the first byte and becomes the painter, or ends with the end of its messages.
[[noreturn]] void wait_and_become(const char* program, int channel) {
    ::setpgid(0, 0); // Ctrl-C is for the run only
    // Closes the files of the run, and the streams whose end a caller may wait for.
    const int nothing = door::null_device().release();
    ::dup2(channel, STDIN_FILENO);
    ::dup2(channel, STDOUT_FILENO);
    ::dup2(nothing, STDERR_FILENO);
    for (int file = STDERR_FILENO + 1; file < 256; ++file) ::close(file);
    std::signal(SIGINT, SIG_IGN);
    char first = 0;
    ssize_t got = -1;
    do got = ::recv(STDIN_FILENO, &first, 1, MSG_PEEK);
    while (got < 0 && errno == EINTR);
    if (got == 1) ::execl(program, program, static_cast<char*>(nullptr));
    ::_exit(0);
}

} // namespace

Painter::~Painter() { end(); }

void Painter::end() {
    if (to_ >= 0) ::close(to_);
    to_ = from_ = -1;
    if (process_ <= 0) return;
    // It ends with its input, and its display with it; a hanging painter does not delay the run.
    for (int tries = 0; tries < 300; ++tries) {
        if (::waitpid(process_, nullptr, WNOHANG) != 0) {
            process_ = -1;
            return;
        }
        ::usleep(10'000);
    }
    // Under the kernel's lock it cannot be killed, and ends by its own alarm.
    if (::kill(process_, SIGKILL) == 0) ::waitpid(process_, nullptr, 0);
    process_ = -1;
}

void Painter::stand_by() {
    if (process_ > 0 || ::access(program_.c_str(), X_OK) != 0) return;
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
        ::close(ends[0]);
        wait_and_become(program_.c_str(), ends[1]);
    }
    ::close(ends[1]);
    to_ = from_ = ends[0];
}

std::string Painter::png(const Drawing& drawing) {
    stand_by();
    if (process_ <= 0)
        no_picture(
            "the program '" + program_.string() + "' is not there",
            "it needs VTK and Xvfb: scripts/install --pictures installs them, scripts/run builds again; curves as "
            ".svg, 'vtk write' and 'kaya report' need neither");
    const std::string bytes = to_bytes(drawing);
    const std::uint64_t size = bytes.size();
    send(std::string(reinterpret_cast<const char*>(&size), sizeof size) + bytes);
    return receive();
}

void Painter::send(const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t sent = ::send(to_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) {
            end();
            no_picture("the program that draws has ended");
        }
        at += static_cast<std::size_t>(sent);
    }
}

std::string Painter::read(std::size_t size) {
    std::string bytes(size, '\0');
    for (std::size_t at = 0; at < size;) {
        pollfd waiting{from_, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, longest_wait);
        if (ready < 0 && errno == EINTR) continue;
        const ssize_t got = ready > 0 ? ::recv(from_, bytes.data() + at, size - at, 0) : 0;
        if (got <= 0) {
            if (ready == 0) ::kill(process_, SIGKILL);
            end();
            no_picture(ready == 0 ? "drawing takes more than a minute" : "the program that draws has ended",
                       "the run continues; make the picture smaller, or use 'vtk write'");
        }
        at += static_cast<std::size_t>(got);
    }
    return bytes;
}

std::string Painter::receive() {
    const bool good = read(1)[0] == 1;
    const std::string length = read(sizeof(std::uint64_t));
    std::uint64_t size = 0;
    std::memcpy(&size, length.data(), sizeof size);
    std::string result = read(size);
    if (!good) no_picture(result);
    return result;
}

} // namespace kaya
