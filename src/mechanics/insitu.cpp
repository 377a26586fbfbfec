#include "mechanics/insitu.hpp"

#include "mechanics/contact_table.hpp"
#include "model/measure.hpp"

namespace kaya {

namespace {

/// Traction on a plane of unit normal n.
Vec3 traction(const Stress& s, const Vec3& n) {
    return {s[0] * n[0] + s[3] * n[1] + s[4] * n[2], s[3] * n[0] + s[1] * n[1] + s[5] * n[2],
            s[4] * n[0] + s[5] * n[1] + s[2] * n[2]};
}

} // namespace

void set_insitu_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                       const std::vector<Row>& sub_contacts, const StressField& stress) {
    for (const Row z : zones) model.zones.stress[z] = stress.at(zone_centroid(model, z));
    auto& points = model.sub_contacts;
    std::vector<char> marked(points.size(), 0);
    for (const Row s : sub_contacts) {
        const Vec3 n = model.contacts.normal[points.contact[s]];
        // What block 1 does to block 2, whose surface looks against n.
        const Vec3 on_block2 = -points.area[s] * traction(stress.at(points.position[s]), n);
        const double normal = on_block2.dot(n);
        points.normal_force[s] = normal;
        points.shear_force.set(s, on_block2 - normal * n);
        marked[s] = 1;
    }
    initialise_sub_contacts(model, joints, marked);
    model.properties_changed = true;
}

} // namespace kaya
