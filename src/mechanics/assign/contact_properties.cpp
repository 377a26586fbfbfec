#include "mechanics/assign/contact_properties.hpp"

#include "mechanics/common/remedy.hpp"
#include "laws/given_values.hpp"
#include "mechanics/contact/contact_search.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/assign/new_joints.hpp"
#include "mechanics/common/property_sets.hpp"
#include "mechanics/contact/take_over.hpp"
#include "mechanics/ties/ties.hpp"
#include "model/edit/bounded.hpp"
#include "model/structures/structures.hpp"
#include "system/memory.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace kaya {

namespace {

void check(const JointModel& joint, const std::vector<double>& values) {
    if (!joint.missing(values).empty()) return; // the rest may come on the next line; the cycle asks again
    const std::string complaint = joint.check(values);
    if (!complaint.empty()) throw Diagnostic(fmt::format("joint model '{}': {}", joint.name, complaint));
}

std::vector<char> initialise_again(Model& model, JointRegistry& joints, const std::vector<Row>& contacts);

/// Sub-contacts with own values of these properties return to the value of their contact.
void forget_own_values(Model& model, JointRegistry& joints, const std::vector<Row>& contacts,
                       const PropertyItems& items) {
    auto& subs = model.sub_contacts;
    if (subs.field_columns == 0) return;
    for (const Row c : contacts) {
        const JointModel& joint = joints.get(model.joint_properties[model.contacts.properties[c]].model);
        for (const auto& [name, value] : items) {
            const auto field = joint.find_field(name);
            if (!field || !joint.fields[*field].property || static_cast<std::int32_t>(*field) >= subs.field_columns)
                continue;
            const Span span = model.contacts.sub_contacts[c];
            for (Row s = span.first; s < span.end(); ++s) {
                subs.field_set[s] &= ~(1u << *field);
                subs.field[*field][s] = 0;
            }
        }
    }
}

bool are_all_joints(const Model& model, const std::vector<Row>& contacts) {
    return contacts.size() == model.contacts.size();
}

} // namespace

void find_contacts(Model& model, JointRegistry& joints) {
    if (!model.stale.contacts()) return;
    require_bounded(model);
    place_structures(model); // in the blocks that are there now
    make_ties(model);        // tied blocks have no contact
    model.tables([](const char*, auto& table) { table.trim(); });
    ContactSearch{}.search(model, joints, false);
    give_back_memory(); // the search needs much temporary memory, and columns allocated meanwhile follow it on the heap
    model.stale.contacts_found();
}

void assign_joint_model(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, const std::string& name,
                        const std::string& place) {
    joints.get(name);
    std::map<std::int32_t, Row> set_of; // by joint material
    for (const Row c : contacts) {
        const std::int32_t material = model.contacts.material[c];
        if (!set_of.contains(material)) set_of[material] = property_set(model, joints, name, material, place);
        model.contacts.properties[c] = set_of[material];
    }
    if (are_all_joints(model, contacts))
        model.settings.default_properties =
            property_set(model, joints, name, model.settings.default_joint_material, place);
    // The history of another joint model means nothing to this one.
    auto& subs = model.sub_contacts;
    for (const Row c : contacts) {
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) {
            subs.forget(s);
            subs.state[s] = 0;
        }
    }
    // Only here: a user who lowers the strength of a joint wants it to slip.
    note_taken_over(model, initialise_again(model, joints, contacts));
    ModelEdit(model, Change::contacts);
}

Row changed_joints(Model& model, JointRegistry& joints, Row row, const std::string& name, const PropertyItems& items,
                   const std::string& place, std::size_t* failed) {
    const std::int32_t material = model.settings.default_joint_material;
    if (name.empty() && row < 0) row = property_set(model, joints, default_joint_model(model), material, "");
    if (name.empty() && items.empty()) return row;
    JointProperties set =
        name.empty() ? model.joint_properties[row] : set_of_material(model, joints, name, material, place);
    const JointModel& joint = joints.get(set.model);
    put_values(joint, set.values, items, true, failed);
    if (failed) *failed = items.size();
    check(joint, set.values);
    set.place = place;
    return shared_set(model, std::move(set));
}

void set_new_joints(Model& model, JointRegistry& joints, const std::string& name, const PropertyItems& items,
                    const std::string& place, std::size_t* failed) {
    model.settings.default_properties =
        changed_joints(model, joints, model.settings.default_properties, name, items, place, failed);
}

void give_joints(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, Row properties) {
    auto& subs = model.sub_contacts;
    std::vector<char> marked(subs.size(), 0);
    bool any_other_model = false;
    for (const Row c : contacts) {
        const Row old = std::exchange(model.contacts.properties[c], properties);
        const bool other_model =
            old == no_row || model.joint_properties[old].model != model.joint_properties[properties].model;
        any_other_model = any_other_model || other_model;
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) {
            marked[s] = 1;
            if (!other_model) continue;
            subs.forget(s);
            subs.state[s] = 0;
        }
    }
    initialise_sub_contacts(model, joints, marked);
    if (any_other_model) note_taken_over(model, marked);
    ModelEdit(model, Change::contacts);
}

void set_joint_properties(Model& model, JointRegistry& joints, const std::vector<Row>& contacts,
                          const PropertyItems& items, const std::string& place, std::size_t* failed) {
    // All new sets are created and checked before the first contact changes.
    std::vector<Row> from;
    for (const Row c : contacts) from.push_back(model.contacts.properties[c]);
    const bool all = are_all_joints(model, contacts);
    if (all) {
        if (model.settings.default_properties < 0)
            model.settings.default_properties =
                property_set(model, joints, default_joint_model(model), model.settings.default_joint_material, "");
        from.push_back(model.settings.default_properties);
    }
    std::map<Row, JointProperties> changed;
    for (const Row row : from) {
        if (changed.contains(row)) continue;
        JointProperties set = model.joint_properties[row];
        const JointModel& joint = joints.get(set.model);
        put_values(joint, set.values, items, true, failed);
        if (failed) *failed = items.size();
        check(joint, set.values);
        set.place = place;
        changed.emplace(row, std::move(set));
    }
    std::map<Row, Row> renamed;
    for (auto& [row, set] : changed) renamed[row] = shared_set(model, std::move(set));
    for (const Row c : contacts) model.contacts.properties[c] = renamed[model.contacts.properties[c]];
    if (all) model.settings.default_properties = renamed[model.settings.default_properties];
    forget_own_values(model, joints, contacts, items);
    initialise_again(model, joints, contacts);
    ModelEdit(model, Change::contacts);
}

void set_joint_material(Model& model, JointRegistry& joints, std::int32_t material, const PropertyItems& items,
                        const std::string& place, std::size_t* failed) {
    std::vector<JointProperties> sets = model.joint_properties;
    for (auto& set : sets) {
        if (set.material != material) continue;
        const JointModel& joint = joints.get(set.model);
        put_values(joint, set.values, items, false, failed);
        check(joint, set.values);
        set.place = place;
    }
    model.joint_properties = std::move(sets);
    for (const auto& [name, value] : items) model.materials[material].joint[name] = value;
    std::vector<Row> contacts;
    for (std::size_t c = 0; c < model.contacts.size(); ++c)
        if (model.joint_properties[model.contacts.properties[c]].material == material)
            contacts.push_back(static_cast<Row>(c));
    forget_own_values(model, joints, contacts, items);
    initialise_again(model, joints, contacts);
    ModelEdit(model, Change::contacts);
}

void change_joint_material(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, std::int32_t material,
                           const std::string& place) {
    std::map<Row, Row> renamed;
    for (const Row c : contacts) {
        const Row old = model.contacts.properties[c];
        if (!renamed.contains(old)) {
            const std::string name = model.joint_properties[old].model;
            renamed[old] = property_set(model, joints, name, material, place);
        }
        model.contacts.properties[c] = renamed[old];
        model.contacts.material[c] = material;
    }
    initialise_again(model, joints, contacts);
    ModelEdit(model, Change::contacts);
}

namespace {

/// A joint model that takes over must make its history consistent with the present forces. Returns the marks of the sub-contacts.
std::vector<char> initialise_again(Model& model, JointRegistry& joints, const std::vector<Row>& contacts) {
    std::vector<char> marked(model.sub_contacts.size(), 0);
    for (const Row c : contacts) {
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) marked[s] = 1;
    }
    initialise_sub_contacts(model, joints, marked);
    return marked;
}

} // namespace

} // namespace kaya
