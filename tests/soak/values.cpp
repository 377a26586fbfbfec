#include "values.hpp"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace kaya::soak {

std::string odd_number(Chance& c) {
    static constexpr std::array all{"0",
                                    "-0.0",
                                    "-1",
                                    "1e308",
                                    "-1e308",
                                    "1e-320",
                                    "1e300",
                                    "1e30",
                                    "1e15",
                                    "1e-15",
                                    "nan",
                                    "inf",
                                    "-inf",
                                    "2147483647",
                                    "2147483648",
                                    "-2147483649",
                                    "4294967296",
                                    "9223372036854775807",
                                    "1e19",
                                    "99999999999",
                                    "0.5",
                                    "1.5",
                                    "65536",
                                    "1000000",
                                    "-9223372036854775808"};
    return c.of(all);
}

std::string plain_number(Chance& c) {
    switch (c.below(6)) {
    case 0: return std::to_string(c.below(4));
    case 1: return std::to_string(1 + c.below(3));
    case 2: return fmt::format("{:.3g}", c.between(-1, 2));
    case 3: return fmt::format("{:.3g}", c.scale(1e-3, 1e3));
    case 4: return fmt::format("{:.3g}", c.scale(1e3, 1e10));
    default: return fmt::format("{:.2g}", c.between(0, 1));
    }
}

std::string number(Chance& c, double odd) { return c.heads(odd) ? odd_number(c) : plain_number(c); }

std::string odd_word(Chance& c) {
    switch (c.below(12)) {
    case 0: return "''";
    case 1: return "'two words'";
    case 2: return "'\x1b[31mred'";
    case 3: return "../outside";
    case 4: return "'" + std::string(1 + static_cast<std::size_t>(c.scale(1, 5000)), 'a') + "'";
    case 5: return "\xff\xfe";
    case 6: return "'%n%s{}'";
    case 7: return "=1+1";
    case 8: return "\xc3\xa9t\xc3\xa9";
    case 9: return "range";
    case 10: return "'";
    default: return "no-such-thing";
    }
}

std::vector<std::string> split(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(std::move(word));
    return words;
}

std::string join(const std::vector<std::string>& words, const char* between) {
    return fmt::format("{}", fmt::join(words, between));
}

} // namespace kaya::soak
