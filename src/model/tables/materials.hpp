// Data of `prop`: block and joint materials by number, and the property sets of contacts.
#pragma once

#include "model/tables/column.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace kaya {

/// Block material. NaN: not given yet.
struct Material {
    double density = std::numeric_limits<double>::quiet_NaN();    ///< mass/length^3
    double bulk = std::numeric_limits<double>::quiet_NaN();       ///< stress
    double shear = std::numeric_limits<double>::quiet_NaN();      ///< stress
    double young = std::numeric_limits<double>::quiet_NaN();      ///< as typed; bulk and shear follow from
    double poisson = std::numeric_limits<double>::quiet_NaN();    ///< these two when both are given
    double cohesion = 0, friction = 0, tension = 0, dilation = 0; ///< Mohr-Coulomb blocks

    /// Joint properties given by material number (`prop jmat`), by the name the user typed.
    /// They are handed to a contact's joint model when it is assigned.
    std::map<std::string, double> joint;
    /// Properties of zone models given by material number (`prop mat`), by the name the user typed.
    std::map<std::string, double> zone;
};

/// A zone model, and values that override those of the material.
struct ZoneProperties {
    std::string model;                    ///< keyword of the zone model
    std::map<std::string, double> values; ///< by the name of the property
    std::string place;                    ///< "deck.3dd:23", where it was last given; for messages
    bool operator==(const ZoneProperties&) const = default;
};

/// An entry of the material table: joint model and properties of new contacts in a range.
struct JointRule {
    std::string range;           ///< the phrase as the program writes it; the engine does not read it
    std::int32_t properties = 0; ///< row of Model::joint_properties
};

/// Values for one joint model; contacts that share a row are one batch.
struct JointProperties {
    std::string model;          ///< keyword of the joint model
    std::int32_t material = 1;  ///< number of `prop jmat` it was made from
    std::vector<double> values; ///< in the order of the model's property table
    std::string place;          ///< "deck.3dd:23", where the values were last given; for messages
};

} // namespace kaya
