#include "commands/stability/strength_reduction.hpp"

#include "commands/program/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

/// How a property gets weaker by a factor: the name that it begins with, and the unit that it then has.
struct Strength {
    std::string_view name, unit;
    double (*divided)(double value, double factor);
    Reduced kind;
};

double divided(double value, double factor) { return value / factor; }

double with_tangent_divided(double degrees, double factor) {
    constexpr double radian = std::numbers::pi / 180;
    return std::atan(std::tan(degrees * radian) / factor) / radian;
}

constexpr std::array<Strength, 3> strengths{{
    {"friction", "angle", with_tangent_divided, Reduced::friction},
    {"cohesion", "stress", divided, Reduced::cohesion},
    {"tension", "stress", divided, Reduced::tension},
}};

/// A law with this property divides its strength by it; its other properties are unchanged.
constexpr std::string_view own_factor = "strength-factor";

/// By the whole name of the property; no number where there is none.
double value_of(const JointModel& joint, const std::vector<double>& values, std::string_view name) {
    const auto found = std::ranges::find(joint.properties, name, &LawTable::Property::name);
    return found == joint.properties.end() ? NAN : values[static_cast<std::size_t>(found - joint.properties.begin())];
}

} // namespace

Asked::Asked(const lang::Solve& command) {
    const auto names = [](const std::vector<Reduced>& words, Reduced word) {
        return std::ranges::find(words, word) != words.end();
    };
    const auto& in = command.included;
    const auto choose = [&](std::initializer_list<Reduced> group) {
        const bool any = std::ranges::any_of(group, [&](Reduced word) { return names(in, word); });
        for (const Reduced word : group)
            asked_[static_cast<std::size_t>(word)] = (!any || names(in, word)) && !names(command.excluded, word);
    };
    choose({Reduced::joints, Reduced::zones});
    choose({Reduced::friction, Reduced::cohesion, Reduced::tension});
}

std::optional<std::vector<double>> reduced(const JointModel& joint, std::vector<double> values, double factor,
                                           const Asked& asked) {
    if (const auto own = std::ranges::find(joint.properties, own_factor, &LawTable::Property::name);
        own != joint.properties.end()) {
        values[static_cast<std::size_t>(own - joint.properties.begin())] *= factor;
        return values;
    }
    bool any = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& property = joint.properties[i];
        const auto found = std::ranges::find_if(strengths, [&](const Strength& strength) {
            return property.name.starts_with(strength.name) && property.unit == strength.unit;
        });
        if (found == strengths.end() || !asked(found->kind)) continue;
        values[i] = found->divided(values[i], factor);
        any = true;
    }
    return any ? std::optional(values) : std::nullopt;
}

bool loses_strength(const JointModel& joint, const std::vector<double>& values) {
    constexpr std::string_view residual = "-residual";
    return std::ranges::any_of(joint.properties, [&](const auto& property) {
        const std::string_view name = property.name;
        return name.ends_with(residual) &&
               value_of(joint, values, name) < value_of(joint, values, name.substr(0, name.size() - residual.size()));
    });
}

std::optional<Diagnostic> doubtful_tension(const JointModel& joint, const JointProperties& set) {
    constexpr double rounding = 1e-9, radian = std::numbers::pi / 180;
    const double tension = value_of(joint, set.values, "tension"), cohesion = value_of(joint, set.values, "cohesion"),
                 tangent = std::tan(value_of(joint, set.values, "friction") * radian);
    if (!(tension * tangent > cohesion * (1 + rounding))) return std::nullopt;
    Diagnostic d(
        fmt::format("the tensile strength {} of joints is above cohesion/tan(friction) = {}", number_text(tension),
                    number_text(cohesion / tangent)),
        "where they pull they press on others, whose friction grows: the factor of safety may come out above limit equilibrium; "
        "give that tension, or less");
    if (!set.place.empty()) d.add("properties given at " + set.place);
    return d;
}

} // namespace kaya
