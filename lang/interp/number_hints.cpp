#include "lang/interp/number_hints.hpp"

#include "lang/interp/lexer.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <numbers>
#include <string>

namespace kaya::lang {

namespace {

struct Unit {
    std::string_view name; ///< in lower case
    double factor;
    std::string_view base;
};

// clang-format off
constexpr std::array<Unit, 43> units{{
    {"gpa", 1e9, "Pa"}, {"mpa", 1e6, "Pa"}, {"kpa", 1000, "Pa"}, {"pa", 1, "Pa"}, {"bar", 100000, "Pa"},
    {"gpa/m", 1e9, "Pa/m"}, {"mpa/m", 1e6, "Pa/m"}, {"kpa/m", 1000, "Pa/m"}, {"pa/m", 1, "Pa/m"},
    {"mpa/mm", 1e9, "Pa/m"}, {"gn", 1e9, "N"}, {"mn", 1e6, "N"}, {"kn", 1000, "N"}, {"n", 1, "N"},
    {"kn/m", 1000, "N/m"}, {"km", 1000, "m"}, {"m", 1, "m"}, {"cm", 0.01, "m"}, {"mm", 0.001, "m"},
    {"ft", 0.3048, "m"}, {"in", 0.0254, "m"}, {"t", 1000, "kg"}, {"kg", 1, "kg"}, {"s", 1, "s"}, {"sec", 1, "s"},
    {"ms", 0.001, "s"}, {"min", 60, "s"}, {"kg/m3", 1, "kg/m^3"}, {"kg/m^3", 1, "kg/m^3"}, {"t/m3", 1000, "kg/m^3"},
    {"t/m^3", 1000, "kg/m^3"}, {"g/cm3", 1000, "kg/m^3"}, {"g/cm^3", 1000, "kg/m^3"}, {"deg", 1, "degrees"},
    {"degrees", 1, "degrees"}, {"rad", 180 / std::numbers::pi, "degrees"}, {"hz", 1, "cycles a second"},
    {"%", 0.01, "parts of 1"}, {"m/s2", 1, "m/s^2"}, {"m/s^2", 1, "m/s^2"}, {"m/s", 1, "m/s"}, {"mm/s", 0.001, "m/s"},
    {"cm/s", 0.01, "m/s"},
}};
// clang-format on

std::string without_unit(double number, const Unit& unit) {
    return fmt::format("numbers have no units: write {:g} when the deck counts in {}", number * unit.factor, unit.base);
}

/// "1000000" for 1_000_000, 1'000'000 and 1.000.000; empty for others.
std::string without_separators(std::string_view text) {
    constexpr std::size_t digits = 3;
    const auto first = text.find_first_of("_'.");
    if (first == text.npos || first == 0 || (text.size() - first) % (digits + 1) != 0) return {};
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool separates = i >= first && (i - first) % (digits + 1) == 0;
        if (separates ? text[i] != text[first] : text[i] < '0' || text[i] > '9') return {};
        if (!separates) plain += text[i];
    }
    return plain;
}

} // namespace

std::string unit_hint(double number, std::string_view word) {
    if (fold(word) == "g") return "numbers have no units: g is 9.81 m/s^2 for gravity, 0.001 kg for a mass";
    const auto unit = std::ranges::find(units, fold(word), &Unit::name);
    return unit == units.end() ? std::string{} : without_unit(number, *unit);
}

std::string number_hint(std::string_view text) {
    const std::string whole(text);
    char* rest = nullptr;
    const double number = std::strtod(whole.c_str(), &rest);
    const std::string_view ending(rest);
    if (rest == whole.c_str() || ending.empty()) return {};
    if (auto unit = unit_hint(number, ending); !unit.empty()) return unit;
    if (auto plain = without_separators(text); !plain.empty())
        return fmt::format("digits are not grouped: write {}", plain);
    if (ending.find_first_not_of("0123456789.eE+-*/^()") == ending.npos && ending.find_first_of("*/^+-") != ending.npos)
        return fmt::format("brackets make arithmetic of it: [{}]", text);
    return {};
}

} // namespace kaya::lang
