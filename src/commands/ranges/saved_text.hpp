// Reads a part of a save file that is text: whole numbers, numbers written by {:a}, and names behind their length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

namespace kaya {

/// Each read throws Diagnostic, with `what` cannot be read, when the text is truncated or malformed.
class SavedText {
public:
    SavedText(const std::string& text, std::string what);
    [[noreturn]] void refuse() const;
    /// Nothing but blanks is left.
    bool at_end();
    /// A whole number from `least` to `most`.
    std::int64_t whole(std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t most = std::numeric_limits<std::int64_t>::max());
    /// A length of a list, which no honest file has in millions.
    std::size_t count() { return static_cast<std::size_t>(whole(0, 1 << 20)); }
    bool flag() { return whole(-1, 1) != 0; }
    double number();
    std::string name();

private:
    std::istringstream stream_;
    std::string what_;
};

} // namespace kaya
