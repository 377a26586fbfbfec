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

constexpr std::array<Unit, 20> units{{
    {"gpa", 1e9, "Pa"},     {"mpa", 1e6, "Pa"},      {"kpa", 1e3, "Pa"},    {"pa", 1, "Pa"},
    {"mn", 1e6, "N"},       {"kn", 1e3, "N"},        {"n", 1, "N"},         {"km", 1e3, "m"},
    {"m", 1, "m"},          {"cm", 1e-2, "m"},       {"mm", 1e-3, "m"},     {"t", 1e3, "kg"},
    {"kg", 1, "kg"},        {"g", 1e-3, "kg"},       {"s", 1, "s"},         {"ms", 1e-3, "s"},
    {"kg/m3", 1, "kg/m^3"}, {"kg/m^3", 1, "kg/m^3"}, {"deg", 1, "degrees"}, {"%", 1e-2, "parts of 1"},
}};

} // namespace

std::string number_hint(std::string_view text) {
    const std::string whole(text);
    char* rest = nullptr;
    const double number = std::strtod(whole.c_str(), &rest);
    const std::string_view suffix(rest);
    if (rest == whole.c_str() || suffix.empty()) return {};
    const auto unit = std::ranges::find(units, fold(suffix), &Unit::name);
    if (unit != units.end())
        return fmt::format("numbers have no units: write {:g} when the deck counts in {}", number * unit->factor,
                           unit->base);
    if (suffix.find_first_not_of("0123456789.eE+-*/^()") == suffix.npos && suffix.find_first_of("*/^+-") != suffix.npos)
        return fmt::format("brackets make arithmetic of it: [{}]", text);
    return {};
}

} // namespace kaya::lang
