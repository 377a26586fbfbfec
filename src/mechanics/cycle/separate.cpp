#include "mechanics/cycle/separate.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/assign/parted_joints.hpp"
#include "mechanics/cycle/insitu.hpp"
#include "model/edit/joined.hpp"

#include <map>

namespace kaya {

namespace {

bool has_stress(const Model& model, Row block) {
    const Span zones = model.blocks.zones[block];
    for (Row z = zones.first; z < zones.end(); ++z)
        if (!model.zones.stress[z].isZero(0)) return true;
    return false;
}

} // namespace

void separate(Model& model, JointRegistry& joints, const std::vector<Row>& blocks) {
    const auto before = model.blocks.body;
    unjoin(model, blocks);
    std::map<std::int32_t, std::vector<Row>> rigid;
    bool stressed = false;
    for (Row b = 0; b < static_cast<Row>(before.size()); ++b) {
        if (before[b] == model.blocks.body[b]) continue;
        if (!model.blocks.deformable[b]) rigid[before[b]].push_back(b);
        stressed = stressed || has_stress(model, b);
    }
    std::vector<std::vector<Row>> bodies;
    for (auto& [body, members] : rigid) bodies.push_back(std::move(members));
    load_parted_joints(model, joints, bodies);
    if (!stressed) return;
    find_contacts(model, joints);
    const auto& contacts = model.contacts;
    std::vector<Row> between_zones;
    for (Row s = 0; s < static_cast<Row>(model.sub_contacts.size()); ++s) {
        const Row c = model.sub_contacts.contact[s], one = contacts.block1[c], two = contacts.block2[c];
        if (before[one] == 0 || before[one] != before[two] || !model.blocks.deformable[one]) continue;
        if (contacts.type[c] == ContactType::face_face) between_zones.push_back(s);
    }
    set_stress_of_zones(model, joints, between_zones);
}

} // namespace kaya
