// Values of a sub-contact apart from forces: history of its joint model, fields, properties of its object.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

struct JointValue {
    std::string name, unit, help;
    /// For a sub-contact with this joint model; nullopt: it has no own value.
    std::function<std::optional<double>(const Model&, Row)> of;
};

class Engine;

/// The name under which a history records such a value: "jmodel_ds". Throws Diagnostic when the joint model of the nearest sub-contact has
/// no value of that name.
std::string recorded_name(Engine& engine, const std::string& name, const Vec3& place);

/// The value requested by a history as "jmodel_ds of 5", 5 being a row; nullopt for any other text.
std::optional<double> recorded_own_value(Engine& engine, const std::string& asked);

/// All values, in the order history, fields, properties. The joint model must outlive them.
std::vector<JointValue> joint_values(const JointModel& joint);

} // namespace kaya
