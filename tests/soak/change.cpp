#include "change.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace kaya::soak {

namespace {

struct Piece {
    std::size_t at = 0, length = 0;
};

bool in_number(char letter) {
    return std::isdigit(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '-' || letter == '+' ||
           letter == 'e';
}

/// Positions of numbers, or of words, in a text.
std::vector<Piece> pieces(const std::string& text, bool numbers) {
    std::vector<Piece> found;
    for (std::size_t at = 0; at < text.size();) {
        const auto fits = [&](char letter) {
            return numbers ? in_number(letter) : std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
        };
        std::size_t end = at;
        while (end < text.size() && fits(text[end])) ++end;
        if (end > at && (!numbers || std::any_of(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                 text.begin() + static_cast<std::ptrdiff_t>(end), [](char letter) {
                                                     return std::isdigit(static_cast<unsigned char>(letter)) != 0;
                                                 })))
            found.push_back({at, end - at});
        at = std::max(end, at + 1);
    }
    return found;
}

std::vector<Piece> lines(const std::string& text) {
    std::vector<Piece> found;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        found.push_back({at, end - at});
        at = end;
    }
    return found;
}

void change_number(std::string& text, Chance& c) {
    const auto all = pieces(text, true);
    if (all.empty()) return;
    const Piece piece = c.of(all);
    text.replace(piece.at, piece.length, number(c, 0.6));
}

void change_word(std::string& text, Chance& c) {
    const auto all = pieces(text, false);
    if (all.empty()) return;
    const Piece piece = c.of(all), other = c.of(all);
    const std::string instead = c.heads() ? text.substr(other.at, other.length) : c.heads() ? odd_word(c) : "";
    text.replace(piece.at, piece.length, instead);
}

void change_line(std::string& text, Chance& c) {
    const auto all = lines(text);
    if (all.empty()) return;
    const Piece one = c.of(all), other = c.of(all);
    const std::string line = text.substr(one.at, one.length);
    switch (c.below(4)) {
    case 0: text.erase(one.at, one.length); break;
    case 1: text.insert(other.at, line); break;
    case 2: // many times
        for (int k = c.below(300); k > 0; --k) text.insert(one.at, line);
        break;
    default: text.replace(other.at, other.length, line); break;
    }
}

void change_bytes(std::string& bytes, Chance& c) {
    static const std::array tokens{std::string("\n"), std::string("'"),        std::string("\""),
                                   std::string("{"),  std::string("]"),        std::string(";"),
                                   std::string(1, 0), std::string("\xff\xfe"), std::string(5, '\r'),
                                   std::string("#"),  std::string(",,"),       std::string("\xef\xbb\xbf")};
    const auto place = [&] { return static_cast<std::size_t>(c.below(static_cast<int>(bytes.size()))); };
    const std::size_t at = place();
    switch (c.below(5)) {
    case 0: bytes[at] = static_cast<char>(c.next() >> 40); break;
    case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << c.below(8))); break;
    case 2: bytes.erase(at, static_cast<std::size_t>(c.below(12))); break;
    case 3: bytes.insert(place(), bytes.substr(at, static_cast<std::size_t>(c.below(48)))); break;
    default: bytes.insert(at, c.of(tokens)); break;
    }
}

} // namespace

std::string changed(std::string bytes, Chance& c) {
    for (int k = 1 + c.below(3); k > 0 && !bytes.empty(); --k) switch (c.below(8)) {
        case 0:
        case 1:
        case 2: change_number(bytes, c); break;
        case 3: change_word(bytes, c); break;
        case 4: change_line(bytes, c); break;
        case 5: bytes.resize(static_cast<std::size_t>(c.below(static_cast<int>(bytes.size())))); break;
        default: change_bytes(bytes, c); break;
        }
    return bytes;
}

} // namespace kaya::soak
