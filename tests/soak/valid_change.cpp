#include "valid_change.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <optional>

namespace kaya::soak {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

/// The number at the start of a word, which may end with a comma.
std::optional<double> number_of(const std::string& word) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value);
    const bool whole = read.ptr == end || (read.ptr + 1 == end && *read.ptr == ',');
    return read.ec == std::errc{} && whole ? std::optional(value) : std::nullopt;
}

void put_number(std::string& word, const std::string& number) {
    const bool comma = word.ends_with(',');
    word = number + (comma ? "," : "");
}

/// Lines that hold the same kind of data: they begin with the same word and have as many words.
std::pair<std::string, std::size_t> shape_of(const std::vector<std::string>& words) {
    return {words.empty() || number_of(words.front()) ? "" : words.front(), words.size()};
}

/// Calls `visit` with the words of each line of the shape of a random one.
void each_alike(std::string& text, Chance& c, const std::function<void(std::vector<std::string>&)>& visit) {
    auto lines = lines_of(text);
    const auto shape = shape_of(split(c.of(lines)));
    for (std::string& line : lines) {
        auto words = split(line);
        if (words.empty() || shape_of(words) != shape) continue;
        visit(words);
        line = join(words);
    }
    text = join(lines, "\n") + "\n";
}

/// One coordinate of all points, or all points that share its value there: faces that shared points still do.
void move_column(std::string& text, Chance& c) {
    const int column = c.below(4), way = c.below(3);
    const double factor = c.scale(0.2, 5), shift = c.between(-0.4, 0.4);
    std::optional<double> moved;
    each_alike(text, c, [&](std::vector<std::string>& words) {
        if (static_cast<std::size_t>(column) >= words.size()) return;
        std::string& word = words[words.size() - 1 - static_cast<std::size_t>(column)];
        const auto value = number_of(word);
        if (!value) return;
        if (!moved) moved = value;
        if (way == 0) put_number(word, fmt::format("{}", *value * factor));
        else if (way == 1) put_number(word, fmt::format("{}", *value + shift));
        else if (*value == *moved) put_number(word, fmt::format("{}", *value + shift));
    });
}

void respell_numbers(std::string& text, Chance& c) {
    static constexpr std::array forms{"{:.1f}", "{:.12f}", "{:e}", "{:.3E}", "{:+}", "{:+.2f}"};
    const char* const form = c.of(forms);
    each_alike(text, c, [&](std::vector<std::string>& words) {
        for (std::string& word : words)
            if (const auto value = number_of(word)) put_number(word, fmt::format(fmt::runtime(form), *value));
    });
}

void respace(std::string& text, Chance& c) {
    static constexpr std::array blanks{"  ", "\t", "    ", " \t "};
    auto lines = lines_of(text);
    std::string& line = lines[static_cast<std::size_t>(c.below(static_cast<int>(lines.size())))];
    const bool leads = c.heads(0.3), trails = c.heads(0.3);
    line = (leads ? " " : "") + join(split(line), c.of(blanks)) + (trails ? "\t " : "");
    if (c.heads(0.3)) lines.insert(lines.begin() + c.below(static_cast<int>(lines.size())), c.heads() ? "" : "  ");
    text = join(lines, c.heads(0.3) ? "\r\n" : "\n") + (c.heads(0.8) ? "\n" : "");
}

void change_case(std::string& text, Chance& c) {
    auto lines = lines_of(text);
    std::string& line = lines[static_cast<std::size_t>(c.below(static_cast<int>(lines.size())))];
    const bool up = c.heads();
    std::ranges::transform(line, line.begin(), [up](unsigned char letter) {
        return static_cast<char>(up ? std::toupper(letter) : std::tolower(letter));
    });
    text = join(lines, "\n") + "\n";
}

/// All coordinates of 1 in a binary file, in either byte order.
void move_floats(std::string& bytes, Chance& c) {
    const float one = 1, other = static_cast<float>(c.scale(0.2, 5));
    for (const bool turned : {false, true}) {
        std::string from(reinterpret_cast<const char*>(&one), sizeof one),
            to(reinterpret_cast<const char*>(&other), sizeof other);
        if (turned) std::ranges::reverse(from), std::ranges::reverse(to);
        for (std::size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + to.size()))
            bytes.replace(at, from.size(), to);
    }
}

} // namespace

std::string changed_validly(std::string bytes, Chance& c) {
    const bool binary = bytes.find('\0') != std::string::npos;
    if (binary) {
        move_floats(bytes, c);
        return bytes;
    }
    for (int k = 1 + c.below(3); k > 0; --k) switch (c.below(8)) {
        case 0: respace(bytes, c); break;
        case 1: change_case(bytes, c); break;
        case 2:
        case 3: respell_numbers(bytes, c); break;
        default: move_column(bytes, c); break;
        }
    return bytes;
}

} // namespace kaya::soak
