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
    const auto names = [](const std::vector<Reduced>& words, std::initializer_list<Reduced> group) {
        return std::ranges::find_first_of(words, group) != words.end();
    };
    const auto& in = command.included;
    const bool by_body = names(in, {Reduced::joints, Reduced::zones}),
               by_part = names(in, {Reduced::friction, Reduced::cohesion, Reduced::tension});
    const bool by_group = by_body || by_part || in.empty();
    const auto choose = [&](auto& chosen, Reduced body, const decltype(parts)& own) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const bool in_groups = by_group && (!by_body || names(in, {body})) && (!by_part || names(in, {parts[i]}));
            chosen[i] = (in_groups || names(in, {own[i]})) && !names(command.excluded, {body, parts[i], own[i]});
        }
    };
    choose(joints_, Reduced::joints, {Reduced::joint_friction, Reduced::joint_cohesion, Reduced::joint_tension});
    choose(zones_, Reduced::zones, {Reduced::zone_friction, Reduced::zone_cohesion, Reduced::zone_tension});
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
        if (found == weakenings.end() || !asked.of_joints(found->kind)) continue;
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
