#include "commands/stability/strength_reduction.hpp"

#include "commands/program/text_table.hpp"
#include "laws/property_roles.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

double divided(double value, double factor) { return value / factor; }

double with_tangent_divided(double degrees, double factor) {
    constexpr double radian = std::numbers::pi / 180;
    return std::atan(std::tan(degrees * radian) / factor) / radian;
}

/// How a part of the strength gets weaker by a factor, and the word of `solve` that selects it.
struct Weakening {
    StrengthPart part;
    double (*divided)(double value, double factor);
    Reduced kind;
};
constexpr std::array<Weakening, 3> weakenings{{
    {StrengthPart::friction, with_tangent_divided, Reduced::friction},
    {StrengthPart::cohesion, divided, Reduced::cohesion},
    {StrengthPart::tension, divided, Reduced::tension},
}};

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
    if (const auto own = find_role(joint, KAYA_JROLE_STRENGTH_FACTOR)) {
        values[*own] *= factor;
        return values;
    }
    bool any = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto found = std::ranges::find(weakenings, strength_part(joint.properties[i].role), &Weakening::part);
        if (found == weakenings.end() || !asked(found->kind)) continue;
        values[i] = found->divided(values[i], factor);
        any = true;
    }
    return any ? std::optional(values) : std::nullopt;
}

bool loses_strength(const JointModel& joint, const std::vector<double>& values) {
    constexpr std::array<std::pair<kaya_jrole, kaya_jrole>, 3> peaks{{
        {KAYA_JROLE_FRICTION, KAYA_JROLE_FRICTION_RESIDUAL},
        {KAYA_JROLE_COHESION, KAYA_JROLE_COHESION_RESIDUAL},
        {KAYA_JROLE_TENSION, KAYA_JROLE_TENSION_RESIDUAL},
    }};
    return std::ranges::any_of(peaks, [&](const auto& of) {
        const auto peak = value_of_role(joint, values, of.first), residual = value_of_role(joint, values, of.second);
        return peak && residual && *residual < *peak;
    });
}

std::optional<Diagnostic> doubtful_tension(const JointModel& joint, const JointProperties& set) {
    constexpr double rounding = 1e-9, radian = std::numbers::pi / 180;
    const auto value = [&](kaya_jrole role) { return value_of_role(joint, set.values, role).value_or(NAN); };
    const double tension = value(KAYA_JROLE_TENSION), cohesion = value(KAYA_JROLE_COHESION),
                 tangent = std::tan(value(KAYA_JROLE_FRICTION) * radian);
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
