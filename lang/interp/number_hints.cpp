#include "lang/interp/number_hints.hpp"

#include "lang/interp/lexer.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

struct Unit {
    std::string_view name; ///< in lower case
    double factor;
    std::string_view base;
};

constexpr std::array<Unit, 22> units{{
    {"gpa", 1e9, "Pa"},     {"mpa", 1e6, "Pa"},      {"kpa", 1e3, "Pa"},    {"pa", 1, "Pa"},
    {"mn", 1e6, "N"},       {"kn", 1e3, "N"},        {"n", 1, "N"},         {"km", 1e3, "m"},
    {"m", 1, "m"},          {"cm", 1e-2, "m"},       {"mm", 1e-3, "m"},     {"t", 1e3, "kg"},
    {"kg", 1, "kg"},        {"g", 1e-3, "kg"},       {"s", 1, "s"},         {"ms", 1e-3, "s"},
    {"kg/m3", 1, "kg/m^3"}, {"kg/m^3", 1, "kg/m^3"}, {"deg", 1, "degrees"}, {"%", 1e-2, "parts of 1"},
    {"m/s2", 1, "m/s^2"},   {"m/s", 1, "m/s"},
}};

std::string without_unit(double number, const Unit& unit) {
    return fmt::format("numbers have no units: write {:g} when the deck counts in {}", number * unit.factor, unit.base);
}

} // namespace

std::string unit_hint(double number, std::string_view word) {
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
    if (ending.find_first_not_of("0123456789.eE+-*/^()") == ending.npos && ending.find_first_of("*/^+-") != ending.npos)
        return fmt::format("brackets make arithmetic of it: [{}]", text);
    return {};
}

} // namespace kaya::lang
