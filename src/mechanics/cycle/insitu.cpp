#include "mechanics/cycle/insitu.hpp"

#include "base/parallel.hpp"
#include "mechanics/contact/contact_plane.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/shape/overlap_gap.hpp"
#include "mechanics/contact/take_over.hpp"
#include "mechanics/zones/cell_state.hpp"
#include "mechanics/ties/ties.hpp"
#include "mechanics/supports/topography.hpp"
#include "mechanics/supports/water.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Traction on a plane of unit normal n.
Vec3 traction(const Stress& s, const Vec3& n) {
    return {s[0] * n[0] + s[3] * n[1] + s[4] * n[2], s[3] * n[0] + s[1] * n[1] + s[5] * n[2],
            s[4] * n[0] + s[5] * n[1] + s[2] * n[2]};
}

/// How far the sides of a sub-contact without force are apart; not above 0 where they touch, or where it carries a force.
double open_gap(const Model& model, Row s) {
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Row c = subs.contact[s];
    if (subs.normal_force[s] != 0) return 0;
    if (contacts.kind[c] == ContactKind::overlap) return gap_of_overlap(model, c);
    if (!subs.side1[s].attached() || !subs.side2[s].attached()) return 0;
    return gap_of_sides(model, s);
}

/// Forces of stresses on sub-contacts; stress_at(row) is that at the place of a sub-contact. No stress crosses the air between corners or edges
/// and what they have not reached; faces that nearly meet count as closed, since drawings do not fit exactly.
template <class StressAt> OpenFaces put_joint_stress(Model& model, JointRegistry& joints,
                                                     const std::vector<Row>& sub_contacts, const StressAt& stress_at) {
    constexpr double misfit = 1e-6; // of the size of faces
    auto& points = model.sub_contacts;
    const auto& contacts = model.contacts;
    std::vector<char> marked(points.size(), 0);
    // The stress is total; joints have what the water that is there does not bear.
    find_ends_of_water(model);
    put_water(model);
    OpenFaces open;
    Row last = no_row;
    for (const Row s : sub_contacts) {
        const Row c = points.contact[s];
        const double gap = open_gap(model, s);
        const bool faces = contacts.type[c] == ContactType::face_face;
        if (!faces && gap > rounding_of_gap(model, contacts.block1[c], contacts.block2[c])) continue;
        if (faces && gap > misfit * std::sqrt(contacts.area[c])) {
            open.joints += c != last;
            open.widest = std::max(open.widest, gap);
            last = c;
        }
        const Vec3 n = contacts.normal[c];
        // Force of block 1 on block 2, whose surface faces against n.
        const Vec3 on_block2 = -points.area[s] * traction(stress_at(s), n);
        const double normal = on_block2.dot(n);
        points.normal_force[s] = normal - points.pore_pressure[s] * wet_area(model, c, s);
        points.shear_force.set(s, on_block2 - normal * n);
        marked[s] = 1;
    }
    initialise_sub_contacts(model, joints, marked);
    note_taken_over(model, marked);
    ModelEdit(model, Change::properties);
    return open;
}

/// Sub-contacts lie at corners and edges of faces, where a vertical line may miss the blocks; a point slightly nearer to the middle of the
/// joint has the same weight above it.
Vec3 inside_joint(const Model& model, Row s) {
    constexpr double hair = 1e-6;
    const auto& subs = model.sub_contacts;
    const Row c = subs.contact[s];
    const Span span = model.contacts.sub_contacts[c];
    Vec3 middle = Vec3::Zero();
    for (Row k = span.first; k < span.end(); ++k) middle += subs.position[k] / span.count;
    const Vec3 blocks =
        0.5 * (block_centroid(model, model.contacts.block1[c]) + block_centroid(model, model.contacts.block2[c]));
    return (1 - 2 * hair) * subs.load_place(s) + hair * middle + hair * blocks;
}

/// Stresses at gridpoints: means of their zones by volume.
class PointStresses {
public:
    explicit PointStresses(const Model& model)
        : sum_(model.gridpoints.size(), Stress::Zero()), volume_(model.gridpoints.size(), 0.0) {
        for (Row z = 0; z < static_cast<Row>(model.zones.size()); ++z)
            for (const Row g : model.zones.gridpoints[z]) {
                const double volume = zone_volume(model, z);
                sum_[g] += volume * model.zones.stress[z];
                volume_[g] += volume;
            }
    }
    Stress at(const Attachment& place) const {
        Stress stress = Stress::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            if (const Row g = place.gridpoints[k]; g != no_row && volume_[g] > 0)
                stress += place.weights[k] / volume_[g] * sum_[g];
        return stress;
    }

private:
    std::vector<Stress> sum_;
    std::vector<double> volume_;
};

} // namespace

OpenFaces set_insitu_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                            const std::vector<Row>& sub_contacts, const StressField& stress) {
    for (const Row z : zones) model.zones.stress[z] = stress.at(zone_centroid(model, z));
    note_initial_stress(model, zones);
    set_tie_tractions(model, zones);
    return put_joint_stress(model, joints, sub_contacts,
                            [&](Row s) { return stress.at(model.sub_contacts.load_place(s)); });
}

OpenFaces set_topography_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                                const std::vector<Row>& sub_contacts, double kx, double ky) {
    const Overburden overburden(model);
    const auto stress_at = [&](const Vec3& place) {
        const double vertical = -overburden.at(place);
        Stress stress = Stress::Zero();
        stress.head<3>() = Vec3(kx * vertical, ky * vertical, vertical);
        return stress;
    };
    for_chunks(zones.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            model.zones.stress[zones[i]] = stress_at(zone_centroid(model, zones[i]));
    });
    note_initial_stress(model, zones);
    set_tie_tractions(model, zones);
    return put_joint_stress(model, joints, sub_contacts, [&](Row s) { return stress_at(inside_joint(model, s)); });
}

void set_stress_of_zones(Model& model, JointRegistry& joints, const std::vector<Row>& sub_contacts) {
    const auto& subs = model.sub_contacts;
    const PointStresses stresses(model);
    put_joint_stress(model, joints, sub_contacts,
                     [&](Row s) { return Stress(0.5 * (stresses.at(subs.side1[s]) + stresses.at(subs.side2[s]))); });
}

void set_stress_component(Model& model, const std::vector<Row>& zones, int component, double at_origin,
                          const Vec3& gradient) {
    for (const Row z : zones) model.zones.stress[z][component] = at_origin + gradient.dot(zone_centroid(model, z));
    note_initial_stress(model, zones);
    set_tie_tractions(model, zones);
    ModelEdit(model, Change::properties);
}

void set_pore_pressure(Model& model, const std::vector<Row>& gridpoints, double at_origin, const Vec3& gradient) {
    auto& points = model.gridpoints;
    for (const Row g : gridpoints) points.pore_pressure[g] = at_origin + gradient.dot(points.position[g]);
    model.settings.water = Water::points;
    ModelEdit(model, Change::properties);
}

} // namespace kaya
