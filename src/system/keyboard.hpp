// Single keys of the terminal on the standard input.
#pragma once

#include <optional>

namespace kaya {

namespace key {
inline constexpr char interrupt = 3, end = 4, escape = 27, none = 0;
}

/// Whether the standard input is a terminal.
bool has_keyboard();

/// Waits for a key, without echo and without a return key. Ctrl-C is an ordinary key here; a key that sends several bytes, such as an arrow, is
/// key::none. Nullopt: a signal arrived, or the terminal was closed.
std::optional<char> read_key();

} // namespace kaya
