// Strengths of joint models that a factor of safety divides, by the roles of their properties.
#pragma once

#include "base/diagnostic.hpp"
#include "laws/joint_model.hpp"
#include "lang/commands/commands.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace kaya {

using Reduced = lang::Solve::Reduced;

/// The selection of a command.
class Asked {
public:
    explicit Asked(const lang::Solve& command);
    /// Whether friction, cohesion or tension of joints, or of zones, is divided.
    bool of_joints(Reduced part) const { return joints_[index_of(part)]; }
    bool of_zones(Reduced part) const { return zones_[index_of(part)]; }
    bool joints() const { return std::ranges::find(joints_, true) != joints_.end(); }
    bool zones() const { return std::ranges::find(zones_, true) != zones_.end(); }

private:
    static constexpr std::array parts{Reduced::friction, Reduced::cohesion, Reduced::tension};
    static std::size_t index_of(Reduced part) {
        return static_cast<std::size_t>(std::ranges::find(parts, part) - parts.begin());
    }
    std::array<bool, parts.size()> joints_{}, zones_{};
};

/// Values of a joint model with the strength divided; none when it has no strength.
std::optional<std::vector<double>> reduced(const JointModel& joint, std::vector<double> values, double factor,
                                           const Asked& asked);

/// A warning where a joint's tensile strength is above cohesion/tan(friction), the end of its Coulomb line: points held in tension press
/// others together, whose friction increases. None without such a strength.
std::optional<Diagnostic> doubtful_tension(const JointModel& joint, const JointProperties& set);

/// Whether a joint with these values loses strength at failure: a residual value is below that of the peak.
bool loses_strength(const JointModel& joint, const std::vector<double>& values);

} // namespace kaya
