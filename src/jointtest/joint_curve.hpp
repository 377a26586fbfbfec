// A joint model along a path: its response, and odd behaviour.
#pragma once

#include "jointtest/csv_table.hpp"
#include "jointtest/load_path.hpp"
#include "jointtest/single_joint.hpp"

#include <string>
#include <vector>

namespace kaya {

struct CurveSettings {
    double area = 1;
    std::size_t steps = 1000;       ///< of each piece of the path
    std::size_t steps_to_start = 0; ///< from nothing to the first point; 0: as many
    bool tangents = true;           ///< try each step a little further; costs two more calls of the model
};

/// One row of the answer. Stresses, displacements and energies per area; tangents as measured and as reported.
struct CurvePoint {
    double time = 0, opening = 0, shear[2] = {0, 0};
    double normal_stress = 0, resistance[2] = {0, 0};
    double normal_stiffness = 0, shear_stiffness = 0; ///< that the model reports
    double normal_tangent = 0, shear_tangent = 0;     ///< that a small further step meets
    double put_in = 0;                                ///< work so far
    double taken_up = 0;                              ///< frictional work counted by the model
    std::uint32_t state = 0;
};

struct Finding {
    std::size_t step; ///< first row where it was found
    std::string text;
};

struct JointCurve {
    std::vector<CurvePoint> points;           ///< the first is the first point of the path
    std::vector<std::size_t> at_path;         ///< row of each point of the path
    std::vector<std::vector<double>> history; ///< one list per point
    std::vector<Finding> findings;            ///< stiffer than reported, jumps, energy created
};

/// Throws Diagnostic when the model fails or a stress cannot be reached.
JointCurve follow_path(const JointModel& model, const std::vector<double>& values, const LoadPath& path,
                       const CurveSettings& settings);

/// All columns of a curve, with names.
CsvTable curve_table(const JointCurve& curve, const JointModel& model);

/// A gnuplot script with its data: shear resistance, normal stress and opening against shear displacement.
std::string curve_figure(const JointCurve& curve, const std::string& title);

} // namespace kaya
