// Script access by the name of a property, and to named ranges.
#include "commands/session/materials.hpp"
#include "commands/world/model_world.hpp"

#include "base/diagnostic.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/measure/measure.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

const RangeTest& ModelWorld::test_of(const std::string& range, ObjectKind kind) {
    if (cycle_of_tests_ != model_.clock.cycle || rows_of_tests_ != model_.stale.rows_revision()) forget_ranges();
    cycle_of_tests_ = model_.clock.cycle;
    rows_of_tests_ = model_.stale.rows_revision();
    const auto found = range_tests_.find({range, kind});
    if (found != range_tests_.end()) return found->second;
    const lang::RangePhrase* phrase = host_.range_phrase(range);
    if (phrase == nullptr)
        throw Diagnostic(fmt::format("there is no named range '{}'", range), "'range name NAME ...' makes one",
                         Fault::run);
    return range_tests_[{range, kind}] = host_.range_test_of(kind, *phrase);
}

bool ModelWorld::in_range(const std::string& name, const std::variant<script::Handle, Vec3>& what) {
    if (const auto* object = std::get_if<script::Handle>(&what)) {
        const auto kind = static_cast<ObjectKind>(object->table);
        if (kind == ObjectKind::corner)
            throw Diagnostic("'in_range' needs an object, not an entry in the list of a face", "use vl_gp", Fault::run);
        const Row row = living_row(*object);
        return test_of(name, kind)(model_, kind, row);
    }
    // A place is tested as a gridpoint at that place.
    const RangeTest& test = test_of(name, ObjectKind::gridpoint);
    if (host_.asks_for_objects(*host_.range_phrase(name)))
        throw Diagnostic(fmt::format("the range '{}' needs more than a place", name), "give a pointer to an object",
                         Fault::run);
    Model only;
    only.gridpoints.resize(1);
    only.gridpoints.position[0] = std::get<Vec3>(what);
    return test(only, ObjectKind::gridpoint, 0);
}

namespace {

/// The joint model of a contact. Throws Diagnostic when it has none yet.
const JointProperties& set_of(const Model& model, Row contact) {
    const Row row = model.contacts.properties[contact];
    if (row == no_row)
        throw Diagnostic(fmt::format("contact {} has no joint model yet", model.contacts.number[contact]),
                         "assign one: jmodel model NAME", Fault::run);
    return model.joint_properties[static_cast<std::size_t>(row)];
}

[[noreturn]] void fail_property(const JointModel& joint, const std::string& name) {
    std::vector<std::string_view> names;
    std::string list;
    const auto add = [&](const std::string& known) {
        names.push_back(known);
        list += (list.empty() ? "" : ", ") + known;
    };
    for (const auto& property : joint.properties) add(property.name);
    for (const auto& variable : joint.history) add(variable.name);
    for (const auto& field : joint.fields)
        if (!field.property) add(field.name);
    const auto meant = did_you_mean(name, names);
    throw Diagnostic(fmt::format("joint model '{}' has no property, history variable or field '{}'", joint.name, name),
                     meant.empty() ? "it has: " + list : fmt::format("did you mean '{}'?", meant), Fault::run);
}

} // namespace

double* ModelWorld::history_value(Row sub_contact, const std::string& name) {
    const JointModel& joint = joints_.get(set_of(model_, model_.sub_contacts.contact[sub_contact]).model);
    for (std::size_t k = 0;
         k < joint.history.size() && static_cast<std::int32_t>(k) < model_.sub_contacts.history_columns; ++k)
        if (joint.history[k].name == name)
            return &model_.sub_contacts.history[k][static_cast<std::size_t>(sub_contact)];
    return nullptr;
}

bool ModelWorld::set_own_value(Row sub_contact, const std::string& name, double value) {
    auto& subs = model_.sub_contacts;
    if (!std::isfinite(value)) throw Diagnostic(fmt::format("'{}' must be a finite number", name), {}, Fault::run);
    if (double* variable = history_value(sub_contact, name)) {
        *variable = value;
        return true;
    }
    const JointModel& joint = joints_.get(set_of(model_, subs.contact[sub_contact]).model);
    const auto property = joint.find_property(name);
    if (const auto field = joint.find_field(name)) {
        if (property) {
            const auto& p = joint.properties[*property];
            if (!p.holds(value))
                throw Diagnostic(fmt::format("'{}' is {}, but must be {}", p.name, value, p.limits_in_words()), {},
                                 Fault::run);
        }
        subs.keep_fields(joint.fields.size());
        subs.set_field(*field, sub_contact, value);
        return true;
    }
    if (!property) fail_property(joint, name);
    return subs.keeps_objects &&
           joint.set_object_value(subs.object[static_cast<std::size_t>(sub_contact)], *property, value);
}

void ModelWorld::set_property(const Owner& owner, const std::string& name, double value) {
    if (const auto* material = std::get_if<Material>(&owner)) {
        // Runs the command itself, for the same checks and the same search for contacts.
        const bool joint = name.starts_with('j');
        host_.run_text(fmt::format("prop {} {} {} {}", joint ? "jmat" : "mat", material->number, name, value), "script",
                       1, false);
        return;
    }
    const auto& object = std::get<script::Handle>(owner);
    const Row row = living_row(object);
    if (object.table == script_table(ObjectKind::sub_contact) && set_own_value(row, name, value)) return;
    throw Diagnostic(fmt::format("'{}' belongs to all objects with this material", name),
                     "set it by a command: jmodel, prop jmat or prop mat", Fault::run);
}

std::optional<double> ModelWorld::own_value(Row sub_contact, const std::string& name) {
    if (const double* variable = history_value(sub_contact, name)) return *variable;
    const auto& subs = model_.sub_contacts;
    const JointProperties& set = set_of(model_, subs.contact[sub_contact]);
    const JointModel& joint = joints_.get(set.model);
    const auto field = joint.find_field(name);
    if (field && static_cast<std::int32_t>(*field) < subs.field_columns && (subs.field_set[sub_contact] >> *field & 1u))
        return subs.field[*field][sub_contact];
    if (field && !joint.fields[*field].property) return joint.fields[*field].initial;
    const auto property = joint.find_property(name);
    if (!property || !subs.keeps_objects) return std::nullopt;
    return joint.object_value(subs.object[static_cast<std::size_t>(sub_contact)], *property);
}

script::Value ModelWorld::property(const Owner& owner, const std::string& name) {
    if (const auto* material = std::get_if<Material>(&owner))
        return material_value(model_, joints_, material->number, name);
    return object_property(std::get<script::Handle>(owner), name);
}

script::Value ModelWorld::object_property(const script::Handle& object, const std::string& name) {
    const Row row = living_row(object);
    const auto kind = static_cast<ObjectKind>(object.table);
    if (kind == ObjectKind::zone) {
        const Row block = model_.zones.block[row];
        const ZoneModel& law = joints_.zones.get(zone_model_of(model_, block));
        if (const auto found = law.find_property(name)) {
            const double value = zone_model_values(model_, block, law)[*found];
            return std::isnan(value) ? 0.0 : value;
        }
        return material_value(model_, joints_, model_.blocks.material[block], name);
    }
    if (kind != ObjectKind::contact && kind != ObjectKind::sub_contact)
        throw Diagnostic(fmt::format("{} have no properties", info_of(kind).plural),
                         "contacts, sub-contacts and zones have", Fault::run);
    if (kind == ObjectKind::sub_contact)
        if (const auto own = own_value(row, name)) return *own;
    const Row contact = kind == ObjectKind::contact ? row : model_.sub_contacts.contact[row];
    const JointProperties& set = set_of(model_, contact);
    const JointModel& joint = joints_.get(set.model);
    const auto found = joint.find_property(name);
    if (!found) fail_property(joint, name);
    if (joint.keeps_objects())
        host_.note(
            kind == ObjectKind::sub_contact
                ? fmt::format(
                      "'{}' of joint model '{}' is what the deck gave: the model has its own for each sub-contact, and does not return it",
                      name, joint.name)
                : fmt::format(
                      "'{}' of a contact is what the deck gave; joint model '{}' has its own for each sub-contact",
                      name, joint.name));
    const double value = set.values[*found];
    return std::isnan(value) ? 0.0 : value;
}

} // namespace kaya
