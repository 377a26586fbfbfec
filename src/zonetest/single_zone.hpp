// One zone without an engine: a zone model is driven step by step, and steps can be tried.
#pragma once

#include "laws/zone_model.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace kaya {

/// Components xx, yy, zz, xy, xz, yz; extension and tension are positive, shear strains are tensor components.
using SixNumbers = std::array<double, 6>;
inline constexpr std::array<const char*, 6> component_names{"xx", "yy", "zz", "xy", "xz", "yz"};

/// Prescribed values of a step: for each component the strain increment, or the stress at the end.
struct ZoneStep {
    SixNumbers value{};
    std::array<bool, 6> is_stress{};
    double time = 0; ///< duration of the step
};

/// The state of a zone as values: a copy is another zone in the same state.
class SingleZone {
public:
    /// `values` in the order of the model's table. Throws Diagnostic for values that are missing or cannot work together.
    SingleZone(const ZoneModel& model, std::vector<double> values, double volume);

    /// Strains that are prescribed. Throws Diagnostic (Fault::run) with the model's own sentence when the model fails.
    void strain_by(const SixNumbers& increment, double time);

    /// Solves for the strain increments that give the prescribed stresses, and runs one step with them. Throws Diagnostic (Fault::run) when
    /// there is no solution.
    SixNumbers step(const ZoneStep& step);

    double mean_stress() const { return (stress[0] + stress[1] + stress[2]) / 3; }
    double deviator() const; ///< root of 3 J2: the difference of the axial and the radial stress in a triaxial test
    double volume_strain() const { return strain[0] + strain[1] + strain[2]; }
    ZoneModuli moduli() const { return model->moduli(*values); }

    const ZoneModel* model;
    std::shared_ptr<const std::vector<double>> values; ///< shared by the copies that are tried
    double volume;
    SixNumbers strain{}, stress{};
    std::uint32_t state = 0;
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    double put_in = 0;     ///< work per volume, by the stresses before and after each step
    double dissipated = 0; ///< as reported by the model
};

} // namespace kaya
