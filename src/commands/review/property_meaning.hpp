// The meaning of a word of `prop`: a property of blocks, of joints or of zones.
#pragma once

#include "lang/commands/commands.hpp"
#include "lang/commands/property_words.hpp"
#include "laws/joint_model.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace kaya {

/// The zone model of removed rock: `zone model null` removes its blocks, as `excavate` does.
inline constexpr std::string_view no_rock = "null";

/// One of three; `joint` is the word that joints know.
struct PropertyMeaning {
    std::optional<lang::BlockProperty> block;
    const LawTable::Property* zone = nullptr;
    std::string joint;
};

/// The meaning of an item in a program that has loaded `models`; zone models that ship are loaded for their words. `joint_only`: `prop jmat`.
/// Throws Diagnostic at the item for a word that none of them knows.
PropertyMeaning property_meaning(JointRegistry& models, const lang::Property::Item& item, bool joint_only);

/// Throws Diagnostic at the item if the property does not take the value.
void check_value(lang::BlockProperty property, const lang::Property::Item& item);
void check_value(const LawTable::Property& property, const lang::Property::Item& item);

std::string_view name_of(lang::BlockProperty property);

/// Which property of blocks a word or its beginning names.
std::optional<lang::BlockProperty> find_block_property(std::string_view word);

/// Whether every deck, or a loaded joint model, has this property of joints.
bool is_joint_word(const JointRegistry& models, std::string_view word);

/// The full word of an abbreviated joint word that every deck may use; other words are returned unchanged.
std::string_view whole_joint_word(std::string_view word);

/// The full word of a property of `prop` for all its spellings; a word of a joint model is returned unchanged.
std::string whole_property_word(std::string_view word);

/// Throws Diagnostic for a constitutive number without a zone model.
void refuse_unknown_number(const lang::Change& command);

} // namespace kaya
