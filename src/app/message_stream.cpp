#include "app/message_stream.hpp"

#include "base/diagnostic.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <fmt/format.h>
#include <poll.h>
#include <string_view>
#include <unistd.h>

namespace kaya {

namespace {

constexpr std::size_t longest_header = 1 << 12, longest_message = std::size_t{1} << 28; // bytes

} // namespace

bool MessageStream::more() {
    std::array<char, 1 << 16> bytes;
    ssize_t count = 0;
    do count = ::read(input_, bytes.data(), bytes.size());
    while (count < 0 && errno == EINTR);
    if (count <= 0) return false;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
}

std::optional<std::string> MessageStream::header_line() {
    for (;;) {
        if (const auto end = read_.find('\n'); end != read_.npos) {
            std::string line = read_.substr(0, end);
            read_.erase(0, end + 1);
            if (!line.empty() && line.back() == '\r') line.pop_back();
            return line;
        }
        if (read_.size() > longest_header) throw Diagnostic("a header of the language server protocol has no end");
        if (!more()) return std::nullopt;
    }
}

std::optional<std::string> MessageStream::next() {
    constexpr std::string_view name = "Content-Length:";
    std::optional<std::size_t> length;
    for (;;) {
        const auto line = header_line();
        if (!line) return std::nullopt;
        if (line->empty() && length) break;
        if (!line->starts_with(name)) continue; // Content-Type
        const auto digits = line->find_first_not_of(' ', name.size());
        std::size_t count = 0;
        const char *const first = line->data() + std::min(digits, line->size()), *const end =
                                                                                     line->data() + line->size();
        const auto [rest, problem] = std::from_chars(first, end, count);
        if (problem != std::errc{} || rest != end || count > longest_message)
            throw Diagnostic(fmt::format("'{}' is not the length of a message", *line),
                             "kaya lsp is started by an editor, which speaks the language server protocol");
        length = count;
    }
    while (read_.size() < *length)
        if (!more()) return std::nullopt;
    std::string message = read_.substr(0, *length);
    read_.erase(0, *length);
    return message;
}

bool MessageStream::is_idle(int milliseconds) const {
    if (!read_.empty()) return false;
    pollfd wait{input_, POLLIN, 0};
    return ::poll(&wait, 1, milliseconds) == 0;
}

void MessageStream::send(const nlohmann::json& message) const {
    // Letters beyond ASCII as \u and digits: a terminal would obey some of them.
    const std::string body = message.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    const std::string bytes = fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t count = ::write(output_, bytes.data() + at, bytes.size() - at);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) throw Diagnostic("the editor does not read", {}, Fault::run);
        at += static_cast<std::size_t>(count);
    }
}

} // namespace kaya
