#include "base/units.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <ranges>
#include <string>
#include <vector>

namespace kaya {

namespace {

struct System {
    std::string_view name, also; ///< `also`: length-mass-time-stress, in any order in a deck
    std::string_view length, time, mass, force, stress;
    double metre, kilogram; ///< of the unit of length, of mass; all have seconds
};

// A pound-force is 4.4482216152605 N, an inch 0.0254 m, a foot 0.3048 m, all by definition; a slug is a pound-force for 1 ft/s^2.
constexpr double pound = 4.4482216152605, inch = 0.0254, foot = 0.3048;
constexpr std::array<System, 7> systems{
    {{"si", "m-kg-s-pa", "m", "s", "kg", "N", "Pa", 1, 1},
     {"kpa-m", "m-t-s-kpa", "m", "s", "t", "kN", "kPa", 1, 1e3},
     {"mpa-m", "m-kt-s-mpa", "m", "s", "kt", "MN", "MPa", 1, 1e6},
     {"mm-t-s", "mm-t-s-mpa", "mm", "s", "t", "N", "MPa", 1e-3, 1e3},
     {"cm-g-s", "cgs", "cm", "s", "g", "dyn", "dyn/cm^2", 1e-2, 1e-3},
     {"in-lb", "in-lb-s-psi", "in", "s", "lbf*s^2/in", "lbf", "psi", inch, pound / inch},
     {"ft-lb", "ft-lb-s-psf", "ft", "s", "slug", "lbf", "psf", foot, pound / foot}}};

/// The units that hyphens part, in the order of the alphabet.
std::vector<std::string> parts(std::string_view text) {
    std::vector<std::string> all;
    for (const auto part : std::views::split(text, '-')) all.emplace_back(part.begin(), part.end());
    std::ranges::sort(all);
    return all;
}

const System* system_named(std::string_view name) {
    const auto found = std::ranges::find_if(
        systems, [&](const System& system) { return system.name == name || parts(system.also) == parts(name); });
    return found == systems.end() ? nullptr : found;
}

/// "" for a word that is not a quantity.
std::string symbol(const System& system, std::string_view word) {
    if (word == "length") return std::string(system.length);
    if (word == "time") return std::string(system.time);
    if (word == "mass") return std::string(system.mass);
    if (word == "force") return std::string(system.force);
    if (word == "stress") return std::string(system.stress);
    if (word == "area") return fmt::format("{}^2", system.length);
    if (word == "volume") return fmt::format("{}^3", system.length);
    if (word == "moment" || word == "energy") return fmt::format("{}*{}", system.force, system.length);
    if (word == "velocity") return fmt::format("{}/{}", system.length, system.time);
    if (word == "acceleration") return fmt::format("{}/{}^2", system.length, system.time);
    if (word == "density") return fmt::format("{}/{}^3", system.mass, system.length);
    if (word == "radians") return "rad";
    return {};
}

} // namespace

Units::Units(std::string_view name) {
    std::string wanted = lower_case(std::string(name));
    std::ranges::replace(wanted, ' ', '-');
    const System* system = system_named(wanted);
    if (system == nullptr)
        throw Diagnostic(fmt::format("'{}' is not a system of units", name),
                         fmt::format("those that fit together are {}", fmt::join(names(), ", ")));
    name_ = system->name;
}

std::vector<std::string_view> Units::names() {
    std::vector<std::string_view> all;
    for (const System& system : systems) all.push_back(system.name);
    return all;
}

bool Units::fit(std::string_view units) {
    const auto some = parts(lower_case(std::string(units)));
    return std::ranges::any_of(systems, [&](const System& s) { return std::ranges::includes(parts(s.also), some); });
}

std::string Units::label(std::string_view quantity) const {
    const System* system = system_named(name_);
    if (system == nullptr) return std::string(quantity);
    std::string text;
    for (std::size_t at = 0; at < quantity.size();) {
        std::size_t end = at;
        while (end < quantity.size() &&
               (std::isalpha(static_cast<unsigned char>(quantity[end])) || quantity[end] == '_'))
            ++end;
        const std::string_view word = quantity.substr(at, end - at);
        std::string unit = symbol(*system, word);
        // A product or quotient stays one where it is divided by or raised.
        const bool below = at > 0 && quantity[at - 1] == '/', raised = end < quantity.size() && quantity[end] == '^';
        if ((below || raised) && unit.find_first_of("*/") != std::string::npos) unit = "(" + unit + ")";
        text += unit.empty() ? word : std::string_view(unit);
        if (end == at) text += quantity[end++];
        at = end;
    }
    return text;
}

std::string Units::in_brackets(std::string_view text) const {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t open = text.find('[', at);
        if (open == std::string_view::npos) return result.append(text.substr(at));
        const std::size_t end = std::min(text.find_first_of(",]", open), text.size());
        result.append(text.substr(at, open + 1 - at)) += label(text.substr(open + 1, end - open - 1));
        at = end;
    }
    return result;
}

std::string Units::heading(std::string_view words, std::string_view quantity) const {
    if (!given() || quantity.empty() || quantity == "-") return std::string(words);
    return fmt::format("{} [{}]", words, label(quantity));
}

double Units::density_in_si(double value) const {
    const System* s = system_named(name_);
    return s == nullptr ? value : value * s->kilogram / (s->metre * s->metre * s->metre);
}

double Units::stress_in_si(double value) const {
    const System* s = system_named(name_);
    return s == nullptr ? value : value * s->kilogram / s->metre;
}

double Units::acceleration_in_si(double value) const {
    const System* s = system_named(name_);
    return s == nullptr ? value : value * s->metre;
}

} // namespace kaya
