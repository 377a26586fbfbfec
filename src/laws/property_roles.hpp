// Roles of the properties of joint models, and the names that older models have for them.
#pragma once

#include "laws/law_table.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace kaya {

/// The role of a property that states none: by its name and unit.
kaya_jrole role_by_name(std::string_view name, std::string_view unit);

/// The word of a role.
std::string_view word_of(kaya_jrole role);

/// The first property with a role.
std::optional<std::size_t> find_role(const LawTable& law, kaya_jrole role);

/// Its value; none where the law has no such property or the value is missing (NaN).
std::optional<double> value_of_role(const LawTable& law, const std::vector<double>& values, kaya_jrole role);

/// Parts of the strength that a factor of safety divides.
enum class StrengthPart { none, friction, cohesion, tension };
StrengthPart strength_part(kaya_jrole role);

} // namespace kaya
