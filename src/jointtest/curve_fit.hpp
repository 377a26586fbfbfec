// Properties of a joint model from a curve that was measured.
#pragma once

#include "jointtest/joint_curve.hpp"

#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Least-squares result for one property.
struct FittedProperty {
    std::string name;
    double value;
    double deviation; ///< standard error from the curvature at the minimum; NaN when undetermined
    double margin;    ///< half of the 95 % interval, with the t of the degrees of freedom
    bool at_limit;    ///< of the model's table
};

/// Residual of one measured column.
struct FittedColumn {
    std::string name;
    double noise;                 ///< standard deviation of the residual; weight of the column
    double largest;               ///< largest measured value, counted from the middle where the offset is free
    std::optional<double> offset; ///< of the measured zero, where it was free
    bool waves;                   ///< the residual is not noise: it keeps its sign over many points
};

/// How far the search can be trusted.
struct FitSearch {
    std::size_t starts = 0;       ///< starting points
    std::size_t agreed = 0;       ///< of them reached the reported minimum
    double next_misfit = 0;       ///< of the next best minimum; 0: there is none
    bool first_was_false = false; ///< the values given lead to a worse minimum
    bool converged = true;
    std::string doubt; ///< why this may not be the minimum, a sentence; empty: nothing speaks against it
};

struct CurveFit {
    std::vector<FittedProperty> properties;
    std::vector<std::vector<double>> correlation; ///< of the properties; NaN where one is undetermined
    std::vector<FittedColumn> columns;
    FitSearch search;
    std::vector<double> values;   ///< of all properties, in the order of the model's table
    double misfit_before, misfit; ///< root of the mean square, part of the largest value measured
    std::size_t steps;            ///< of each piece of the path that were enough
    JointCurve curve;             ///< with the fitted values
};

struct FitSettings {
    CurveSettings curve;                            ///< steps 0: as many as the result needs
    std::vector<std::string> offsets = {"opening"}; ///< columns with unknown zero
    std::size_t starts = 8;                         ///< at most
};

/// Fits the named properties, from the values given and from other starts, within the limits of the model's table. Besides its own columns
/// the path has one or more measured ones: shear_stress, shear_stress_y; opening for a path of normal_stress; measured_normal_stress for a
/// path without normal_stress. Each is weighted by its noise. Throws Diagnostic when no column was measured, a name is unknown, or there
/// are more properties than points.
CurveFit fit_curve(const JointModel& model, const std::vector<double>& values, const std::vector<std::string>& names,
                   const LoadPath& path, const FitSettings& settings);

/// Lines for people: values with their 95 % interval, correlation, columns, and how far the search can be
/// trusted.
std::string fit_text(const CurveFit& fit);

} // namespace kaya
