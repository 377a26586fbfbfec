#include "display.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya {

namespace {

constexpr int longest_start = 20'000; // milliseconds

/// A record of an Xauthority file: texts with their lengths, high byte first.
void put_text(std::string& record, const std::string& text) {
    record += static_cast<char>(text.size() >> 8);
    record += static_cast<char>(text.size() & 0xff);
    record += text;
}

} // namespace

Display::Display() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kaya-display-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for temporary files can be made");
    folder_ = pattern;
    try {
        make_secret();
        start();
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
        throw;
    }
}

Display::~Display() {
    if (server_ > 0) {
        ::kill(server_, SIGTERM);
        ::waitpid(server_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void Display::make_secret() {
    std::string cookie(16, '\0');
    if (::getrandom(cookie.data(), cookie.size(), 0) != static_cast<ssize_t>(cookie.size()))
        throw std::runtime_error("the system gives no random numbers");
    std::string record("\xff\xff", 2); // any host
    put_text(record, "");              // any display
    put_text(record, "MIT-MAGIC-COOKIE-1");
    put_text(record, cookie);
    const std::string file = folder_ + "/secret";
    std::ofstream(file, std::ios::binary) << record;
    ::setenv("XAUTHORITY", file.c_str(), 1);
}

void Display::start() {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("the system gives no pipe");
    const pid_t parent = ::getpid();
    const std::string secret = folder_ + "/secret";
    server_ = ::fork();
    if (server_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (::getppid() != parent) ::_exit(1);
        ::close(ends[0]);
        const std::string number = std::to_string(ends[1]);
        ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "640x480x24", "-nolisten", "tcp",
                 "-auth", secret.c_str(), "+extension", "GLX", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string number;
    pollfd waiting{ends[0], POLLIN, 0};
    while (number.find('\n') == std::string::npos && ::poll(&waiting, 1, longest_start) > 0) {
        std::array<char, 16> piece{};
        const ssize_t got = ::read(ends[0], piece.data(), piece.size());
        if (got <= 0) break;
        number.append(piece.data(), static_cast<std::size_t>(got));
    }
    ::close(ends[0]);
    if (number.find('\n') != std::string::npos) {
        ::setenv("DISPLAY", fmt::format(":{}", number.substr(0, number.find('\n'))).c_str(), 1);
        return;
    }
    ::kill(server_, SIGKILL);
    int status = 0;
    ::waitpid(server_, &status, 0);
    server_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        throw std::runtime_error("pictures need Xvfb where there is no screen: install the package xvfb");
    throw std::runtime_error("Xvfb does not start");
}

} // namespace kaya
