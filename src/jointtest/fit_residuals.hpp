// Residuals of measured columns as a function of the unknown properties.
#pragma once

#include "jointtest/joint_curve.hpp"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// A property between its limits as a free number, after MINUIT: a sine between two limits, a hyperbola at a single limit.
class FreeNumber {
public:
    FreeNumber(const JointModel::Property& p, double start);
    double value(double t) const;
    double number(double value) const;
    double slope(double t) const { return (value(t + 1e-6) - value(t - 1e-6)) / 2e-6; }
    /// A value for `part` from 0 to 1: between the limits, or from a quarter of the start to four times it.
    double spread(double part) const;
    /// Within a thousandth of the range, or of the start, of a limit.
    bool at_limit(double value) const;

private:
    double low_, high_, scale_;
};

/// Whether a column of that name is a measured one.
bool is_measured_column(const std::string& name);

/// One measured column: its values at the points of the path.
struct Measured {
    std::string name;
    std::vector<double> values;
    double (*of)(const CurvePoint&);
    bool free_offset; ///< unknown zero: the mean of the residual is subtracted
    double largest;
    double scale;                   ///< divisor of the residual
    std::vector<double> correction; ///< effect of many steps along the path on the answer with few; empty: none
};

/// Throws Diagnostic when no column was measured, or an offset is requested of a column that was not.
std::vector<Measured> measured_of(const LoadPath& path, const std::vector<std::string>& offsets);

/// Residuals over free numbers, in the form of Eigen's minimiser.
struct Residuals {
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    const JointModel& model;
    const LoadPath& path;
    CurveSettings settings;
    std::vector<Measured> measured;
    std::vector<double> base;       ///< values of all properties
    std::vector<std::size_t> which; ///< of the unknown ones
    std::vector<FreeNumber> free;

    int inputs() const { return static_cast<int>(which.size()); }
    int values() const { return static_cast<int>(measured.size() * path.points.size()); }
    int freedom() const; ///< number of values minus the fitted properties and offsets
    std::vector<double> values_at(const Eigen::VectorXd& t) const;

    /// Residual of a column in its own unit, and the subtracted offset.
    struct Left {
        std::vector<double> values;
        double offset;
    };
    Left left_of(const Measured& column, const JointCurve& curve) const;

    /// Fills in the residuals; false where the model refuses the values or cannot follow the path.
    bool evaluate(const Eigen::VectorXd& t, Eigen::VectorXd& residuals) const;

    int operator()(const Eigen::VectorXd& t, Eigen::VectorXd& residuals) const {
        if (!evaluate(t, residuals)) residuals.setConstant(1e6); // far from any curve
        return 0;
    }

    /// Derivatives by central differences. Joints have kinks: over a ten-thousandth of each number.
    int df(const Eigen::VectorXd& t, Eigen::MatrixXd& jacobian) const;

    double sum_of_squares(const Eigen::VectorXd& t) const;

    /// Adopts the effect of many steps at `t`; returns its change since the last time in units of the noise.
    double correct_steps(const Eigen::VectorXd& t, const CurveSettings& many);
};

} // namespace kaya
