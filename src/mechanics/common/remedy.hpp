// Errors whose remedy is a command. This folder knows no word of a deck; src/commands/program/remedies.cpp words the hint.
#pragma once

#include "base/diagnostic.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// The comments give the meaning of Advised::values.
enum class Advice {
    give_density,          ///< number of the material
    give_moduli,           ///< number of the material
    give_material_value,   ///< number of the material, name of the property
    change_material_value, ///< number of the material, name of the property
    give_joint_property,   ///< name of the property, number of the material
    name_joint_model,      ///< number that means none
    name_zone_model,
    give_gravity,
    give_shorter_step,
    check_time_function,
    rotate_before_joining
};

/// An error with an advice code instead of a hint.
class Advised : public Diagnostic {
public:
    Advised(std::string text, Advice what_to_do, std::vector<std::string> filled = {}, Fault kind = Fault::deck)
        : Diagnostic(std::move(text), {}, kind), advice(what_to_do), values(std::move(filled)) {}

    Advice advice;
    std::vector<std::string> values;
};

} // namespace kaya
