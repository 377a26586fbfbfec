// What a sub-contact has for itself besides forces: history of its joint model, fields, properties that its object holds.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

struct JointValue {
    std::string name, unit, help;
    /// Of a sub-contact that has this joint model; nullopt: it has none of its own.
    std::function<std::optional<double>(const Model&, Row)> of;
};

class Engine;

/// The name under which a history records what a sub-contact has for itself: "jmodel_ds". Throws Diagnostic when the joint
/// model of the sub-contact that is nearest to the place has nothing of that name.
std::string recorded_name(Engine& engine, const std::string& name, const Vec3& place);

/// The value that a history asks for as "jmodel_ds of 5", 5 being a row; nullopt for anything else.
std::optional<double> recorded_own_value(Engine& engine, const std::string& asked);

/// All of them, in the order history, fields, properties. The joint model must outlive them.
std::vector<JointValue> joint_values(const JointModel& joint);

} // namespace kaya
