#include "mechanics/contact/contact_stiffness.hpp"

#include <algorithm>
#include <type_traits>

namespace kaya {

namespace {

template <class T> T everywhere(double value) {
    if constexpr (std::is_same_v<T, double>) return value;
    else return eights(value);
}
template <class T> TripleOf<T> everywhere(const Triple& t) {
    return {everywhere<T>(t.x), everywhere<T>(t.y), everywhere<T>(t.z)};
}

/// Springs at one place, or at eight.
template <class T> struct SpringsAt {
    T normal, shear;
    TripleOf<T> place;
};

/// The springs of the rows from one on, which act at one place.
Springs springs_from(const Model& model, Row first, Row end, const NormalAreaFactor& factor) {
    Springs sum;
    for (Row s = first; s < end; ++s) {
        const Springs springs = springs_of(model.sub_contacts, s, factor);
        sum.normal += springs.normal;
        sum.shear += springs.shear;
    }
    return sum;
}

/// The trace of the stiffness over the mass as one block has it, for each place.
template <class T> T over_mass_of(const Model& model, const std::vector<Compliance>& compliances, Row c, Row block,
                                  const SpringsAt<T>& at) {
    const auto& blocks = model.blocks;
    if (blocks.fixed[block] == fix_all || blocks.deformable[block] || !(blocks.mass[block] > 0)) return T{};
    const auto& q = blocks.orientation[block];
    const Rotor to_own = Rotor{q[0], {q[1], q[2], q[3]}}.conjugate();
    const RotorOf<T> turn{everywhere<T>(to_own.w), everywhere<T>(to_own.v)};
    const auto& [of_mass, of_inertia] = compliances[block];
    const TripleOf<T> n = everywhere<T>(to_own.turned(Triple(model.contacts.normal[c])));
    const TripleOf<T> arm = turn.turned(at.place - everywhere<T>(Triple(blocks.centroid[block])));
    const TripleOf<T> across = arm.cross(n);
    const T along = across.dot(of_inertia * across);
    return at.normal * (of_mass + along) + at.shear * (2 * of_mass + of_inertia.of_arm(arm) - along);
}

double sum_of_places(double part) { return part; }

double sum_of_places(const Eight& parts) {
    double sum = 0;
    for (Row k = 0; k <= carriers; ++k) sum += parts[k];
    return sum;
}

template <class T> StiffnessOfSides over_masses_of(const Model& model, const std::vector<Compliance>& compliances,
                                                   Row c, const SpringsAt<T>& at) {
    return {sum_of_places(over_mass_of(model, compliances, c, model.contacts.block1[c], at)),
            sum_of_places(over_mass_of(model, compliances, c, model.contacts.block2[c], at))};
}

} // namespace

double sum_of_stiffness(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    const NormalAreaFactor factor(model, contact);
    double sum = 0;
    for (Row s = span.first; s < span.end(); ++s) sum += springs_of(model.sub_contacts, s, factor).stiffer();
    return sum;
}

std::vector<Compliance> compliances_of(const Model& model) {
    const auto& blocks = model.blocks;
    std::vector<Compliance> all;
    all.reserve(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
        all.push_back({1 / blocks.mass[b], {blocks.inertia[b], blocks.mass[b] / blocks.volume[b]}});
    return all;
}

// An unloaded contact acts at one place, and so do all contacts of separated blocks: its springs there are in a separate lane, after those
// of the carriers.
StiffnessOfSides stiffness_over_mass(const Model& model, const std::vector<Compliance>& compliances, Row c) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    const NormalAreaFactor factor(model, c);
    if (!(model.contacts.depth[c] > 0)) {
        const Springs all = springs_from(model, span.first, span.end(), factor);
        const Vec3 place = span.count > 0 ? Vec3(subs.position[span.first]) : Vec3(Vec3::Zero());
        return over_masses_of<double>(model, compliances, c, {all.normal, all.shear, Triple(place)});
    }
    const Row spread = std::min(carriers, span.count);
    const Springs others = springs_from(model, span.first + spread, span.end(), factor);
    const SpringsOfEight loaded = springs_of(subs, span.first, RowsOfEight(spread), factor);
    constexpr Eight lanes{0, 1, 2, 3, 4, 5, 6, 7};
    const auto of_others = lanes == static_cast<double>(spread);
    const Eight3 place = RowsOfEight(std::min(spread + 1, span.count)).load(subs.position, span.first);
    return over_masses_of<Eight>(model, compliances, c,
                                 {of_others ? eights(others.normal) : loaded.normal,
                                  of_others ? eights(others.shear) : loaded.shear,
                                  {place.x, place.y, place.z}});
}

} // namespace kaya
