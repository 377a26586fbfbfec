#include "mechanics/common/property_sets.hpp"

#include "laws/given_values.hpp"
#include "mechanics/common/remedy.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

std::vector<double> initial_values(const JointModel& joint) {
    std::vector<double> values;
    for (const auto& property : joint.properties) values.push_back(property.initial);
    return values;
}

/// Classic constitutive numbers of contacts whose meaning is certain. A wrong guess for the others would run unnoticed.
constexpr std::array<std::pair<std::int32_t, const char*>, 2> numbered_models{{{1, "mohr"}, {7, "elastic"}}};

} // namespace

void put_values(const JointModel& joint, std::vector<double>& values, const PropertyItems& items, bool strict,
                std::size_t* failed) {
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto& [name, value] = items[i];
        if (failed) *failed = i;
        if (!strict && !joint.find_property(name)) continue;
        values[accepting_property(joint, joint_law.noun, name, value)] = value;
    }
}

std::string joint_model_of_number(const Model& model, std::int32_t number) {
    const auto given = model.joint_constitutive.find(number);
    if (given != model.joint_constitutive.end()) return given->second;
    for (const auto& [known, name] : numbered_models)
        if (known == number) return name;
    throw Advised(fmt::format("no joint model has the number {}", number), Advice::name_joint_model,
                  {std::to_string(number)});
}

std::string default_joint_model(const Model& model) {
    return joint_model_of_number(model, model.settings.default_joint_constitutive);
}

Row shared_set(Model& model, JointProperties set) {
    // Bits are compared: values not given are NaN.
    const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
    for (std::size_t row = 0; row < model.joint_properties.size(); ++row) {
        const auto& other = model.joint_properties[row];
        if (other.model == set.model && other.material == set.material && other.place == set.place &&
            std::equal(set.values.begin(), set.values.end(), other.values.begin(), other.values.end(), same))
            return static_cast<Row>(row);
    }
    model.joint_properties.push_back(std::move(set));
    return static_cast<Row>(model.joint_properties.size() - 1);
}

JointProperties set_of_material(const Model& model, JointRegistry& joints, const std::string& name,
                                std::int32_t material, const std::string& place) {
    const JointModel& joint = joints.get(name);
    JointProperties set{joint.name, material, initial_values(joint), place};
    const auto found = model.materials.find(material);
    if (found != model.materials.end())
        put_values(joint, set.values, PropertyItems(found->second.joint.begin(), found->second.joint.end()), false,
                   nullptr);
    return set;
}

Row property_set(Model& model, JointRegistry& joints, const std::string& name, std::int32_t material,
                 const std::string& place) {
    if (place.empty() && model.settings.default_properties >= 0 &&
        material == model.joint_properties[model.settings.default_properties].material)
        return model.settings.default_properties;
    return shared_set(model, set_of_material(model, joints, name, material, place));
}

} // namespace kaya
