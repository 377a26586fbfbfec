// A sentence for the standard error, built without allocation.
#pragma once

#include "base/terminal_text.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace kaya {

/// In a fixed buffer: a signal handler may neither allocate nor print. Control characters are replaced as in terminal_text().
class Sentence {
public:
    Sentence& operator<<(const char* text) {
        std::string_view rest = text == nullptr ? "" : text;
        while (!rest.empty()) {
            const auto character = first_for_terminal(rest);
            if (length_ + character.size >= sizeof text_) break;
            std::copy_n(character.bytes, character.size, text_ + length_);
            length_ += character.size;
            rest.remove_prefix(character.taken);
        }
        text_[length_] = '\0';
        return *this;
    }
    Sentence& operator<<(long number) {
        char digits[24];
        std::size_t at = sizeof digits;
        digits[--at] = '\0';
        const bool negative = number < 0;
        unsigned long rest = negative ? 0ul - static_cast<unsigned long>(number) : static_cast<unsigned long>(number);
        do {
            digits[--at] = static_cast<char>('0' + rest % 10);
            rest /= 10;
        } while (rest > 0);
        if (negative) digits[--at] = '-';
        return *this << digits + at;
    }
    /// What it holds so far.
    const char* text() const { return text_; }
    /// On the standard error. False when it is not there.
    bool write() const;

private:
    char text_[2048] = "";
    std::size_t length_ = 0;
};

} // namespace kaya
