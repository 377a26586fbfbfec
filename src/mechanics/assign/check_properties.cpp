#include "mechanics/assign/check_properties.hpp"
#include "laws/stiffness_trial.hpp"

#include "mechanics/common/remedy.hpp"

#include <fmt/format.h>
#include <set>
#include <string>

namespace kaya {

namespace {

/// Adds to a message the origin of an unusable property set.
void add_user(Diagnostic& mistake, const Model& model, std::size_t contact, const JointProperties& set) {
    mistake.add(fmt::format("first used by contact {} between blocks {} and {}", model.contacts.number[contact],
                            model.blocks.number[model.contacts.block1[contact]],
                            model.blocks.number[model.contacts.block2[contact]]));
    if (!set.place.empty()) mistake.add("properties given at " + set.place);
}

void check_set(const JointModel& joint, const JointProperties& set) {
    std::string list;
    const auto missing = joint.missing(set.values);
    for (const auto& name : missing) list += (list.empty() ? "" : ", ") + name;
    if (!list.empty()) {
        Advised d(fmt::format("joint model '{}' is used without {}", joint.name, list), Advice::give_joint_property,
                  {missing.front(), std::to_string(set.material)});
        d.code = "property-missing";
        throw d;
    }
    if (const std::string complaint = joint.check(set.values); !complaint.empty()) {
        Diagnostic d(fmt::format("joint model '{}': {}", joint.name, complaint));
        d.code = "property-missing";
        throw d;
    }
    initial_stiffness(joint, set.values);
}

} // namespace

void check_properties(const Model& model, JointRegistry& joints) {
    std::set<Row> used;
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        const Row row = model.contacts.properties[c];
        if (!used.insert(row).second) continue;
        const auto& set = model.joint_properties[row];
        const JointModel& joint = joints.get(set.model);
        try {
            check_set(joint, set);
        } catch (Diagnostic& mistake) {
            add_user(mistake, model, c, set);
            throw;
        }
    }
}

} // namespace kaya
