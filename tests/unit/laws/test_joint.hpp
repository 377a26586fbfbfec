// A joint model run without the engine: columns for a few rows, and steps of displacement.
#pragma once

#include "laws/batch.hpp"
#include "laws/joint_model.hpp"

#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace kaya::test {

using Values = std::map<std::string, double>;
using Vector = std::array<double, 3>;

/// One of the models that ship.
const JointModel& shipped(const std::string& name);

/// A model of tests/plugins, loaded into a separate registry that exists as long as the program.
const JointModel& plugin(const std::string& name);

/// A model of tests/compat, likewise; its table 7 is (0, 30) (0.001, 20), its table 8 (0, 1) (0.001, 2).
const JointModel& compat(const std::string& name);

/// The values in the order of the model's table, the others initial. Fails the test for an unknown name.
std::vector<double> values_of(const JointModel& model, const Values& given);

/// The values, with `more` added or in place of them.
Values with(Values base, const Values& more);

/// Rows of one joint, all with the same motion unless a test writes to the columns. Copies are independent, so a test can try a step.
class TestJoint {
public:
    TestJoint(const JointModel& model, const Values& given, double area = 1, std::size_t rows = 1);

    /// Deletes nothing: call it after writing forces or gaps, like the engine.
    void initialise();

    /// One step; the test fails if the model fails.
    void step(double opening, const Vector& slip = {0, 0, 0});

    /// One step of slip during which the normal stress (row 0) becomes `stress`.
    void slip_at_stress(double stress, const Vector& slip);

    /// Closes the joint until the normal stress of row 0 is `stress`.
    void load(double stress) { slip_at_stress(stress, {0, 0, 0}); }

    double normal_stress(std::size_t row = 0) const { return normal_force[row] / area[row]; }
    double shear_stress(std::size_t row = 0) const; ///< its size
    double history_value(const std::string& name, std::size_t row = 0) const;
    bool in_state(const std::string& name, std::size_t row = 0) const;

    /// The batch of all rows, to call the model by hand.
    kaya_jbatch batch();

    const JointModel* model;
    double time_step = 1e-5;
    std::vector<double> values;
    std::vector<double> area, normal_disp, normal_disp_inc, pore_pressure, normal_force;
    std::vector<double> normal_stiffness, shear_stiffness, frictional_work;
    std::array<std::vector<double>, 3> shear_disp, shear_disp_inc, shear_force;
    std::vector<std::uint32_t> state;
    std::vector<std::vector<double>> history;
    std::vector<std::vector<double>> field; ///< values of rows, for the fields of the model
    std::vector<JointObject> object;

private:
    std::vector<double*> history_columns_;
    std::vector<const double*> field_columns_;
};

/// Work of the forces of row 0 in a step from `before` to `after` (trapezoid).
double work_of_step(const TestJoint& before, const TestJoint& after);

} // namespace kaya::test
