#include "model/tables/structure_properties.hpp"

namespace kaya {

const std::vector<StructureProperty>& structure_properties() {
    using P = StructureProperties;
    constexpr std::uint8_t bars = cable_kind | beam_kind, members = beam_kind | liner_kind, all = bars | liner_kind;
    static const std::vector<StructureProperty> rows{
        {"area", &P::area, bars},
        {"young", &P::young, all},
        {"density", &P::density, all},
        {"kbond", &P::grout_stiffness, cable_kind},
        {"sbond", &P::grout_cohesion, cable_kind},
        {"fbond", &P::grout_friction, cable_kind},
        {"perimeter", &P::grout_perimeter, cable_kind},
        {"yield", &P::yield_tension, bars},
        {"ycomp", &P::yield_compression, bars},
        {"rupture", &P::rupture_strain, cable_kind},
        {"poisson", &P::poisson, members},
        {"moi-y", &P::moment_of_area_y, beam_kind},
        {"moi-z", &P::moment_of_area_z, beam_kind},
        {"torsion-constant", &P::torsion_constant, beam_kind},
        {"plastic-moment-y", &P::plastic_moment_y, beam_kind},
        {"plastic-moment-z", &P::plastic_moment_z, beam_kind},
        {"thickness", &P::thickness, liner_kind},
        {"kn", &P::link_normal, members},
        {"ks", &P::link_shear, members},
        {"cohesion", &P::link_cohesion, members},
        {"friction", &P::link_friction, members},
        {"tension", &P::link_tension, members},
    };
    return rows;
}

bool is_given(const StructureProperties& properties, const StructureProperty& property) {
    static const StructureProperties fresh;
    return properties.*property.value != fresh.*property.value;
}

} // namespace kaya
