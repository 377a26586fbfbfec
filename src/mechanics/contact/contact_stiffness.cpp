#include "mechanics/contact/contact_stiffness.hpp"

#include "mechanics/lanes/triple.hpp"

#include <algorithm>

namespace kaya {

namespace {

using Triples = TripleOf<Eight>;

Triples in_all_lanes(const Triple& t) { return {eights(t.x), eights(t.y), eights(t.z)}; }

/// Springs of up to eight sub-contacts at places.
struct SpringsAtPlaces {
    Eight normal{}, shear{};
    Eight3 place{};
};

/// An unloaded contact acts at one place, and so do all contacts of separated blocks: its springs there are in a separate lane, after those
/// of the first `spread` rows.
SpringsAtPlaces springs_at_places(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Span span = contacts.sub_contacts[c];
    const Row spread = contacts.depth[c] > 0 ? std::min(carriers, span.count) : 0;
    const NormalAreaFactor factor(model, c);
    const RowsOfEight group(std::min<std::ptrdiff_t>(spread + 1, span.count));
    SpringsAtPlaces at{{}, {}, group.load(subs.position, span.first)};
    Springs others;
    for (Row k = 0; k < span.count; ++k) {
        const Springs springs = springs_of(subs, span.first + k, factor);
        if (k < spread) {
            at.normal[k] = springs.normal;
            at.shear[k] = springs.shear;
        } else {
            others.normal += springs.normal;
            others.shear += springs.shear;
        }
    }
    at.normal[spread] = others.normal;
    at.shear[spread] = others.shear;
    return at;
}

/// The trace of the stiffness over the mass as one block has it.
double over_mass_of(const Model& model, Row c, Row block, const SpringsAtPlaces& at) {
    const auto& blocks = model.blocks;
    const double mass = blocks.mass[block];
    if (blocks.fixed[block] == fix_all || blocks.deformable[block] || !(mass > 0)) return 0;
    const auto& q = blocks.orientation[block];
    const Rotor to_own = Rotor{q[0], {q[1], q[2], q[3]}}.conjugate();
    const RotorOf<Eight> turn{eights(to_own.w), in_all_lanes(to_own.v)};
    const Mat3& m = blocks.inertia[block];
    const SymmetricInverseOf<Eight> inverse(eights(m(0, 0)), eights(m(1, 1)), eights(m(2, 2)), eights(m(1, 2)),
                                            eights(m(0, 2)), eights(m(0, 1)), eights(mass / blocks.volume[block]));
    const Triples n = in_all_lanes(to_own.turned(Triple(model.contacts.normal[c])));
    const Triples arm =
        turn.turned(Triples(at.place.x, at.place.y, at.place.z) - in_all_lanes(Triple(blocks.centroid[block])));
    const Triples across = arm.cross(n);
    const Eight along = across.dot(inverse * across);
    const Eight parts = at.normal * (1 / mass + along) + at.shear * (2 / mass + inverse.of_arm(arm) - along);
    double sum = 0;
    for (Row k = 0; k <= carriers; ++k) sum += parts[k];
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
    const SpringsAtPlaces at = springs_at_places(model, contact);
    return {over_mass_of(model, contact, model.contacts.block1[contact], at),
            over_mass_of(model, contact, model.contacts.block2[contact], at)};
}

} // namespace kaya
