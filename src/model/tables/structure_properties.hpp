// Values of `structure property` numbers, for cables, beams and liners.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace kaya {

/// Kinds of structures, as bits.
enum StructureKind : std::uint8_t { cable_kind = 1, beam_kind = 2, liner_kind = 4 };

/// A limit that is not given is infinite, and so is a link without springs.
struct StructureProperties {
    static constexpr double unlimited = std::numeric_limits<double>::infinity();
    double area = 0;                   ///< of the cross section
    double young = 0;                  ///< stress
    double density = 0;                ///< mass/length^3
    double grout_stiffness = 0;        ///< force per length of cable and length of slip
    double grout_cohesion = unlimited; ///< force per length of cable
    double grout_friction = 0;         ///< degrees
    double grout_perimeter = 0;        ///< length
    double yield_tension = unlimited;  ///< force
    double yield_compression = unlimited;
    double rupture_strain = unlimited; ///< plastic strain at which a bar breaks

    double poisson = 0;
    double moment_of_area_y = 0, moment_of_area_z = 0; ///< length^4
    double torsion_constant = unlimited;               ///< length^4; infinite: the sum of the two
    double plastic_moment_y = unlimited, plastic_moment_z = unlimited;
    double thickness = 0;
    // Links to the rock: of liners per area, of beams per length.
    double link_normal = unlimited, link_shear = unlimited; ///< stiffness
    double link_cohesion = unlimited;
    double link_friction = 0; ///< degrees
    double link_tension = unlimited;

    double axial_stiffness() const { return area * young; } ///< force
    /// Whether links are springs, or rigid.
    bool has_springs() const { return link_normal < unlimited || link_shear < unlimited; }
    bool operator==(const StructureProperties&) const = default;
};

/// A name under which a deck gives one of them.
struct StructureProperty {
    std::string_view name;
    double StructureProperties::*value;
    std::uint8_t users; ///< StructureKind bits
};
const std::vector<StructureProperty>& structure_properties();

/// Whether it differs from the initial value.
bool is_given(const StructureProperties& properties, const StructureProperty& property);

} // namespace kaya
