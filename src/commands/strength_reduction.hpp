// What a factor of safety divides: strengths of joint models, by their properties.
#pragma once

#include "laws/joint_model.hpp"
#include "lang/commands/commands.hpp"

#include <array>
#include <optional>
#include <vector>

namespace kaya {

using Reduced = lang::Solve::Reduced;

/// What a command asks to be reduced.
class Asked {
public:
    explicit Asked(const lang::Solve& command);
    bool operator()(Reduced word) const { return asked_[static_cast<std::size_t>(word)]; }

private:
    std::array<bool, 5> asked_{};
};

/// Values of a joint model with the strength divided; none when it has no strength.
std::optional<std::vector<double>> reduced(const JointModel& joint, std::vector<double> values, double factor,
                                           const Asked& asked);

/// Whether a joint with these values keeps less strength after failure: a value "x-residual" is below "x".
bool loses_strength(const JointModel& joint, const std::vector<double>& values);

} // namespace kaya
