#include "mechanics/contact/contact_stiffness.hpp"

#include "mechanics/lanes/triple.hpp"

namespace kaya {

namespace {

/// The same as seen from one block.
double over_mass_of(const Model& model, Row c, Row block) {
    const auto& blocks = model.blocks;
    const double mass = blocks.mass[block];
    if (blocks.fixed[block] == fix_all || blocks.deformable[block] || !(mass > 0)) return 0;
    const auto& q = blocks.orientation[block];
    const Rotor to_own = Rotor{q[0], {q[1], q[2], q[3]}}.conjugate();
    const SymmetricInverse inverse(blocks.inertia[block], mass / blocks.volume[block]);
    const Triple n = to_own.turned(Triple(model.contacts.normal[c])), centre(blocks.centroid[block]);
    const NormalAreaFactor factor(model, c);
    const Span span = model.contacts.sub_contacts[c];
    const auto over_mass = [&](const Springs& springs, const Vec3& place) {
        const Triple arm = to_own.turned(Triple(place) - centre), across = arm.cross(n);
        const double along = across.dot(inverse * across);
        return springs.normal * (1 / mass + along) + springs.shear * (2 / mass + inverse.of_arm(arm) - along);
    };
    // An unloaded contact acts at one place, and so do all contacts of separated blocks.
    const auto& contacts = model.contacts;
    const Row spread = contacts.kind[c] != ContactKind::overlap ? span.end()
                       : contacts.depth[c] > 0                  ? std::min(span.first + carriers, span.end())
                                                                : span.first;
    double sum = 0;
    for (Row s = span.first; s < spread; ++s)
        sum += over_mass(springs_of(model.sub_contacts, s, factor), model.sub_contacts.position[s]);
    Springs others;
    for (Row s = spread; s < span.end(); ++s) {
        const Springs springs = springs_of(model.sub_contacts, s, factor);
        others.normal += springs.normal;
        others.shear += springs.shear;
    }
    if (others.stiffer() > 0) sum += over_mass(others, model.sub_contacts.position[spread]);
    return sum;
}

} // namespace

double sum_of_stiffness(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    const NormalAreaFactor factor(model, contact);
    double sum = 0;
    for (Row s = span.first; s < span.end(); ++s) sum += springs_of(model.sub_contacts, s, factor).stiffer();
    return sum;
}

StiffnessOfSides stiffness_over_mass(const Model& model, Row contact) {
    return {over_mass_of(model, contact, model.contacts.block1[contact]),
            over_mass_of(model, contact, model.contacts.block2[contact])};
}

} // namespace kaya
