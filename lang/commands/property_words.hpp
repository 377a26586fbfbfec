// The words of `prop` that the language knows; all others belong to loaded models.
#pragma once

#include "lang/interp/spec.hpp"

#include <string_view>
#include <vector>

namespace kaya::lang {

/// A property of blocks that every deck may use, for any zone model.
enum class BlockProperty { density, bulk, shear, young, poisson, cohesion, friction, tension, dilation };
constexpr std::size_t block_property_count = 9;

/// One property and its spellings.
struct PropertyWord {
    std::vector<Spelling> words;
    std::string_view name; ///< the one of the spellings that messages use
    const char* unit;
    const char* help;
    Limits limits;
    const char* limits_in_words = ""; ///< "above 0"
};

/// In the order of BlockProperty.
const std::vector<PropertyWord>& block_property_words();
/// Properties of joints, for any joint model.
const std::vector<PropertyWord>& joint_property_words();

} // namespace kaya::lang
