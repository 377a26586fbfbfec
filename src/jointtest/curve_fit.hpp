// Properties of a joint model from a curve that was measured.
#pragma once

#include "jointtest/joint_curve.hpp"

#include <string>
#include <vector>

namespace kaya {

/// What the least squares found for one property.
struct FittedProperty {
    std::string name;
    double value;
    double deviation; ///< standard error from the curvature at the minimum; NaN when the data do not tell
};

struct CurveFit {
    std::vector<FittedProperty> properties;
    std::vector<double> values; ///< of all properties, in the order of the model's table
    double misfit_before, misfit; ///< root of the mean square, part of the largest value measured
    JointCurve curve;             ///< with the fitted values
};

/// Fits the named properties, from the values given, within the limits of the model's table. The path has, besides its
/// own columns, one or more that were measured: shear_stress; normal_displacement when it gives normal_stress;
/// normal_stress is not for a path that gives it. Each is weighed by its largest value. Throws Diagnostic when nothing was
/// measured, a name is unknown, or there are more properties than points.
CurveFit fit_curve(const JointModel& model, const std::vector<double>& values, const std::vector<std::string>& names,
                   const LoadPath& path, const CurveSettings& settings);

} // namespace kaya
