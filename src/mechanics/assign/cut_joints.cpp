#include "mechanics/assign/cut_joints.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/common/property_sets.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace kaya {

namespace {

using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

/// The same for both orders of two blocks.
Pair pair_of(const BlockId& a, const BlockId& b) {
    const std::pair one(a.slot, a.generation), other(b.slot, b.generation);
    const auto& [low, high] = std::minmax(one, other); // of variables: it returns references to its arguments
    return {low.first, low.second, high.first, high.second};
}

} // namespace

std::vector<GivenJoint> given_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks) {
    const auto& contacts = model.contacts;
    std::vector<GivenJoint> given;
    if (contacts.empty()) return given;
    const std::int32_t material = model.settings.default_joint_material;
    const Row found_anew = property_set(model, joints, default_joint_model(model), material, "");
    std::vector<char> cut(model.blocks.size(), 0);
    for (const Row b : blocks) cut[b] = 1;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        if (!cut[contacts.block1[c]] && !cut[contacts.block2[c]]) continue;
        if (contacts.material[c] == material && contacts.properties[c] == found_anew && contacts.group[c] == 0)
            continue;
        given.push_back({model.blocks.id[contacts.block1[c]], model.blocks.id[contacts.block2[c]], contacts.material[c],
                         contacts.properties[c], contacts.group[c]});
    }
    return given;
}

void give_to_pieces(Model& model, JointRegistry& joints, const std::vector<GivenJoint>& given,
                    const std::vector<BlockId>& origin) {
    if (given.empty()) return;
    std::map<Pair, const GivenJoint*> of_pair;
    for (const auto& joint : given) of_pair[pair_of(joint.block1, joint.block2)] = &joint;
    find_contacts(model, joints);
    auto& contacts = model.contacts;
    std::vector<char> marked(model.sub_contacts.size(), 0);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto found = of_pair.find(pair_of(origin[contacts.block1[c]], origin[contacts.block2[c]]));
        if (found == of_pair.end()) continue;
        contacts.group[c] = found->second->group;
        if (contacts.properties[c] == found->second->properties) continue;
        contacts.material[c] = found->second->material;
        contacts.properties[c] = found->second->properties;
        std::fill_n(marked.begin() + contacts.sub_contacts[c].first, contacts.sub_contacts[c].count, char{1});
    }
    initialise_sub_contacts(model, joints, marked);
    ModelEdit(model, Change::contacts);
}

} // namespace kaya
