#include "mechanics/structures/element_motion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace kaya {

namespace {

/// Of a type without vector registers: sums of double follow their width, and so would the last bits of a run.
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

} // namespace

EndStiffness end_stiffness(const Eigen::MatrixXd& deformation, const Eigen::MatrixXd& stiffness, double arm) {
    Matrix scaled = deformation.cast<long double>();
    for (Eigen::Index k = 0; k < scaled.cols(); ++k)
        if (k % 6 >= 3) scaled.col(k) /= arm;
    const Matrix whole = scaled.transpose() * stiffness.cast<long double>() * scaled;
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(whole, Eigen::EigenvaluesOnly);
    const double largest = std::max(0.0, static_cast<double>(solver.eigenvalues().maxCoeff()));
    return {largest, largest * arm * arm};
}

} // namespace kaya
