// Messages of the language server protocol: a header with the length, and JSON (base protocol 3.17).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace kaya {

class MessageStream {
public:
    MessageStream(int input, int output) : input_(input), output_(output) {}

    /// The text of the next message; none at the end of the input. Throws Diagnostic when the header is not one, or the message too long.
    std::optional<std::string> next();
    /// Whether nothing arrives within that time.
    bool is_idle(int milliseconds) const;
    void send(const nlohmann::json& message) const;

private:
    /// One line of the header without its end; none at the end of the input.
    std::optional<std::string> header_line();
    bool more(); ///< reads what is there; false at the end of the input

    int input_, output_;
    std::string read_; ///< and not yet taken
};

} // namespace kaya
