#include "commands/world/joint_values.hpp"

#include "base/diagnostic.hpp"
#include "commands/world/engine.hpp"
#include "model/fields/sampling.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

double given(const Model& model, Row row, std::size_t property) {
    const Row set = model.contacts.properties[model.sub_contacts.contact[row]];
    return model.joint_properties[static_cast<std::size_t>(set)].values[property];
}

JointValue history_value(const JointModel& joint, std::size_t k) {
    const auto& variable = joint.history[k];
    return {variable.name, variable.unit, variable.help, [k](const Model& model, Row row) -> std::optional<double> {
                const auto& subs = model.sub_contacts;
                if (static_cast<std::int32_t>(k) >= subs.history_columns) return std::nullopt;
                return subs.history[k][row];
            }};
}

JointValue field_value(const JointModel& joint, std::size_t k) {
    const auto& field = joint.fields[k];
    return {
        field.name, field.unit, field.help,
        [k, initial = field.initial, property = field.property](const Model& model, Row row) -> std::optional<double> {
            const auto& subs = model.sub_contacts;
            const bool is_set = static_cast<std::int32_t>(k) < subs.field_columns && (subs.field_set[row] >> k & 1u);
            if (is_set) return subs.field[k][row];
            return property ? given(model, row, *property) : initial;
        }};
}

JointValue held_value(const JointModel& joint, std::size_t property) {
    const auto& p = joint.properties[property];
    return {p.name, p.unit, p.help, [&joint, property](const Model& model, Row row) -> std::optional<double> {
                const auto& subs = model.sub_contacts;
                if (!subs.keeps_objects) return std::nullopt;
                return joint.object_value(subs.object[row], property);
            }};
}

} // namespace

namespace {

constexpr std::string_view beginning = "jmodel_", between = " of ";

const JointModel* joint_model_of(Engine& engine, Row row) {
    const auto& model = engine.model;
    const Row set = model.contacts.properties[model.sub_contacts.contact[row]];
    return set == no_row ? nullptr : engine.joints.find(model.joint_properties[static_cast<std::size_t>(set)].model);
}

} // namespace

std::string recorded_name(Engine& engine, const std::string& name, const Vec3& place) {
    HistorySource source{HistorySource::Kind::sub_contact, std::string(beginning) + name, place};
    locate(engine.model, source);
    const JointModel* joint = joint_model_of(engine, source.row);
    if (joint == nullptr)
        throw Diagnostic("the nearest sub-contact has no joint model yet", "assign one first: jmodel model NAME",
                         Fault::run);
    std::vector<std::string> names;
    for (const auto& value : joint_values(*joint)) {
        if (value.name == name) return source.quantity;
        names.push_back(value.name);
    }
    const auto near = did_you_mean(name, {names.begin(), names.end()});
    throw Diagnostic(fmt::format("a sub-contact of joint model '{}' has no separate '{}'", joint->name, name),
                     !near.empty()   ? fmt::format("did you mean '{}'?", near)
                     : names.empty() ? "its properties are those of the deck: it has no separate values"
                                     : fmt::format("it has: {}", fmt::join(names, ", ")),
                     Fault::run);
}

std::optional<double> recorded_own_value(Engine& engine, const std::string& asked) {
    const auto middle = asked.rfind(between);
    if (!asked.starts_with(beginning) || middle == asked.npos) return std::nullopt;
    Row row = no_row;
    std::from_chars(asked.data() + middle + between.size(), asked.data() + asked.size(), row);
    const std::string name = asked.substr(beginning.size(), middle - beginning.size());
    if (row < 0 || static_cast<std::size_t>(row) >= engine.model.sub_contacts.size()) return std::nullopt;
    const JointModel* joint = joint_model_of(engine, row);
    if (joint == nullptr) return std::nan("");
    for (const auto& value : joint_values(*joint)) // the joint model may have been replaced
        if (value.name == name) return value.of(engine.model, row).value_or(std::nan(""));
    return std::nan("");
}

std::vector<JointValue> joint_values(const JointModel& joint) {
    std::vector<JointValue> values;
    for (std::size_t k = 0; k < joint.history.size(); ++k) values.push_back(history_value(joint, k));
    for (std::size_t k = 0; k < joint.fields.size(); ++k) values.push_back(field_value(joint, k));
    if (joint.shows_objects())
        for (std::size_t k = 0; k < joint.properties.size(); ++k)
            if (!joint.find_field(joint.properties[k].name)) values.push_back(held_value(joint, k));
    return values;
}

} // namespace kaya
