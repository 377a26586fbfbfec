#include "laws/property_roles.hpp"

#include "kaya/law/roles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

namespace {

/// Other names that laws have used before they could state a role: all that begin with the word.
struct EarlyName {
    std::string_view begins, unit;
    kaya_jrole role;
};
constexpr std::array<EarlyName, 4> early_names{{{"friction", "angle", KAYA_JROLE_FRICTION_OTHER},
                                                {"cohesion", "stress", KAYA_JROLE_STRENGTH_OTHER},
                                                {"tension", "stress", KAYA_JROLE_TENSION_RESIDUAL},
                                                {"jcso", "stress", KAYA_JROLE_WALL_STRENGTH}}};

} // namespace

kaya_jrole role_by_name(std::string_view name, std::string_view unit) {
    for (const auto& known : law::role_words)
        if (!known.unit.empty() && known.word == name && known.unit == unit) return known.role;
    for (const auto& early : early_names)
        if (name.starts_with(early.begins) && early.unit == unit) return early.role;
    return KAYA_JROLE_NONE;
}

std::string_view word_of(kaya_jrole role) {
    const auto found = std::ranges::find(law::role_words, role, &law::RoleWord::role);
    return found == law::role_words.end() ? std::string_view{} : found->word;
}

std::optional<std::size_t> find_role(const LawTable& law, kaya_jrole role) {
    const auto found = std::ranges::find(law.properties, role, &LawTable::Property::role);
    if (found == law.properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - law.properties.begin());
}

std::optional<double> value_of_role(const LawTable& law, const std::vector<double>& values, kaya_jrole role) {
    const auto at = find_role(law, role);
    if (!at || *at >= values.size() || std::isnan(values[*at])) return std::nullopt;
    return values[*at];
}

StrengthPart strength_part(kaya_jrole role) {
    switch (role) {
    case KAYA_JROLE_FRICTION:
    case KAYA_JROLE_FRICTION_RESIDUAL:
    case KAYA_JROLE_FRICTION_OTHER: return StrengthPart::friction;
    case KAYA_JROLE_COHESION:
    case KAYA_JROLE_COHESION_RESIDUAL:
    case KAYA_JROLE_STRENGTH_OTHER: return StrengthPart::cohesion;
    case KAYA_JROLE_TENSION:
    case KAYA_JROLE_TENSION_RESIDUAL: return StrengthPart::tension;
    default: return StrengthPart::none;
    }
}

} // namespace kaya
