#include "lang/commands/property_words.hpp"

#include <limits>

namespace kaya::lang {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Limits above_zero{0, infinity, true, true}, from_zero{0, infinity, false, true};

} // namespace

// clang-format off
const std::vector<PropertyWord>& block_property_words() {
    static const std::vector<PropertyWord> words = {
        {{"density"}, "density", "mass/length^3", "density of blocks", above_zero, "above 0"},
        {{"bulk", "k"}, "bulk", "stress", "bulk modulus of blocks", above_zero, "above 0"},
        {{"shear", "g"}, "shear", "stress", "shear modulus of blocks", above_zero, "above 0"},
        {{"ymod", "ymodulus", "young"}, "ymodulus", "stress", "Young's modulus, with prat in place of bulk and shear", above_zero, "above 0"},
        {{"prat", "pratio", "poisson"}, "pratio", "", "Poisson's ratio", {-1, 0.5, true, true}, "above -1 and below 0.5"},
        {{"bcoh", "bcohesion"}, "bcohesion", "stress", "cohesion of Mohr-Coulomb blocks", from_zero, "0 or more"},
        {{"bfric", "bfriction"}, "bfriction", "degrees", "friction angle of Mohr-Coulomb blocks", {0, 90, false, true}, "from 0 to below 90 degrees"},
        {{"bten", "btension"}, "btension", "stress", "tensile strength of Mohr-Coulomb blocks", from_zero, "0 or more"},
        {{"bdil", "bdilation"}, "bdilation", "degrees", "dilation angle of Mohr-Coulomb blocks", {-90, 90, true, true}, "between -90 and 90 degrees"},
    };
    return words;
}

const std::vector<PropertyWord>& joint_property_words() {
    static const std::vector<PropertyWord> words = {
        // No joint model has a meaning for stiffness and strength below 0.
        {{"jkn"}, "jkn", "stress/length", "normal stiffness of joints", from_zero},
        {{"jks"}, "jks", "stress/length", "shear stiffness of joints", from_zero},
        {{"jfric", "jfriction"}, "jfriction", "degrees", "friction angle of joints", {}},
        {{"jcoh", "jcohesion"}, "jcohesion", "stress", "cohesion of joints", from_zero},
        {{"jten", "jtension"}, "jtension", "stress", "tensile strength of joints", from_zero},
        {{"jdil", "jdilation"}, "jdilation", "degrees", "dilation angle of joints", {}},
        {{{"zdil"}, {"zdilation"}, {"zerdilation", 6}}, "zdilation", "length", "slip at which dilation stops", {}},
        // In full only: jrc and jrco are properties of other joint models.
        {{{"jrfric", 6}, {"jrfriction", 6}, {"resfriction", 6}}, "jrfriction", "degrees", "residual friction angle of joints", {}},
        {{{"jrcoh", 5}, {"jrcohesion", 5}, {"rescohesion", 6}}, "jrcohesion", "stress", "residual cohesion of joints", {}},
        {{{"jrten", 5}, {"jrtension", 5}, {"restension", 6}}, "jrtension", "stress", "residual tensile strength of joints", {}},
    };
    return words;
}
// clang-format on

} // namespace kaya::lang
