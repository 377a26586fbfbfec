/* SPDX-License-Identifier: MIT */
// Words for the roles of properties: kaya_jrole of kaya/jmodel.h.
#pragma once

#include "kaya/jmodel.h"

#include <array>
#include <string_view>

namespace kaya::law {

struct RoleWord {
    std::string_view word;
    kaya_jrole role;
    std::string_view unit; ///< of a property that has the role by its name; "": none has
};

/// The name of a property alone gives it a role where the word is the whole name. docs/writing-a-joint-model.md.
inline constexpr std::array<RoleWord, 14> role_words{{
    {"none", KAYA_JROLE_NONE, ""},
    {"stiffness-normal", KAYA_JROLE_STIFFNESS_NORMAL, "stress/length"},
    {"stiffness-shear", KAYA_JROLE_STIFFNESS_SHEAR, "stress/length"},
    {"friction", KAYA_JROLE_FRICTION, "angle"},
    {"friction-residual", KAYA_JROLE_FRICTION_RESIDUAL, "angle"},
    {"friction-other", KAYA_JROLE_FRICTION_OTHER, "angle"},
    {"cohesion", KAYA_JROLE_COHESION, "stress"},
    {"cohesion-residual", KAYA_JROLE_COHESION_RESIDUAL, "stress"},
    {"strength-other", KAYA_JROLE_STRENGTH_OTHER, ""},
    {"tension", KAYA_JROLE_TENSION, "stress"},
    {"tension-residual", KAYA_JROLE_TENSION_RESIDUAL, "stress"},
    {"dilation", KAYA_JROLE_DILATION, "angle"},
    {"wall-strength", KAYA_JROLE_WALL_STRENGTH, ""},
    {"strength-factor", KAYA_JROLE_STRENGTH_FACTOR, "-"},
}};

} // namespace kaya::law
