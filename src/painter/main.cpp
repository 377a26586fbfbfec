// kaya-painter: reads drawings from its standard input and writes PNG files to its standard output, until the input ends. kaya starts it
// for the first picture.
#include "display.hpp"
#include "draw.hpp"
#include "scene/wire.hpp"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vtkObject.h>

namespace {

/// The longest drawing that is read: some fifty million triangles.
constexpr std::uint64_t longest = std::uint64_t{4} << 30;

constexpr unsigned longest_drawing = 55; // seconds

bool read_all(void* to, std::size_t size) { return std::fread(to, 1, size, stdin) == size; }

bool read_message(std::string& bytes) {
    std::uint64_t size = 0;
    if (!read_all(&size, sizeof size) || size > longest) return false;
    bytes.resize(size);
    return read_all(bytes.data(), size);
}

/// False when the reader has closed the pipe.
bool answer(int to, char good, const std::string& bytes) {
    const std::uint64_t size = bytes.size();
    std::string message(1, good);
    message.append(reinterpret_cast<const char*>(&size), sizeof size);
    message += bytes;
    for (std::size_t at = 0; at < message.size();) {
        const ssize_t sent = ::write(to, message.data() + at, message.size() - at);
        if (sent <= 0) return false;
        at += static_cast<std::size_t>(sent);
    }
    return true;
}

} // namespace

int main() {
    vtkObject::GlobalWarningDisplayOff();
    std::signal(SIGPIPE, SIG_IGN);
    const int replies = ::dup(STDOUT_FILENO); // output of a graphics driver must not become part of an answer
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    std::unique_ptr<kaya::Display> display;
    for (std::string bytes; read_message(bytes);) {
        std::string result;
        char good = 1;
        ::alarm(longest_drawing); // a driver that hangs ends here, and the system ends the display with it
        try {
            const auto drawing = kaya::drawing_from(bytes);
            if (!drawing) throw std::runtime_error("kaya and kaya-painter are not of the same version");
            // The user's display may be on another machine, without OpenGL: the painter's own display always gives the same picture.
            if (!display) display = std::make_unique<kaya::Display>();
            result = std::visit([](const auto& what) { return kaya::png_of(what); }, *drawing);
        } catch (const std::exception& error) {
            good = 0;
            result = error.what();
        }
        ::alarm(0);
        if (!answer(replies, good, result)) break;
    }
}
