#include "base/base64.hpp"

#include <array>

namespace kaya {
namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr auto base64_values = [] {
    std::array<signed char, 256> all{};
    all.fill(-1);
    for (std::size_t k = 0; k < base64_digits.size(); ++k)
        all[static_cast<unsigned char>(base64_digits[k])] = static_cast<signed char>(k);
    return all;
}();

} // namespace

std::string base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U; };
        const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        text += base64_digits[three >> 18];
        text += base64_digits[three >> 12 & 63];
        text += i + 1 < bytes.size() ? base64_digits[three >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? base64_digits[three & 63] : '=';
    }
    return text;
}

std::optional<std::string> Base64Reader::take(std::size_t count) {
    if (count / 3 > (text_.size() - at_) / 4 + left_.size()) return std::nullopt;
    while (left_.size() < count)
        if (!read_three()) return std::nullopt;
    std::string bytes = left_.substr(0, count);
    left_.erase(0, count);
    return bytes;
}

/// Four base64_digits, the last two of which may be padding.
bool Base64Reader::read_three() {
    unsigned bits = 0;
    int found = 0, padding = 0;
    while (found + padding < 4) {
        if (at_ >= text_.size()) return false;
        const char c = text_[at_++];
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
        const int value = base64_values[static_cast<unsigned char>(c)];
        if (c == '=' && found >= 2) ++padding;
        else if (value < 0 || padding > 0) return false;
        else ++found;
        bits = bits << 6 | static_cast<unsigned>(c == '=' ? 0 : value);
    }
    for (int k = 0; k < found - 1; ++k) left_ += static_cast<char>(bits >> (16 - 8 * k) & 255);
    return true;
}

} // namespace kaya
