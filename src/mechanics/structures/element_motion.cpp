#include "mechanics/structures/element_motion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace kaya {

EndStiffness end_stiffness(const Eigen::MatrixXd& deformation, const Eigen::MatrixXd& stiffness, double arm) {
    Eigen::MatrixXd scaled = deformation;
    for (Eigen::Index k = 0; k < scaled.cols(); ++k)
        if (k % 6 >= 3) scaled.col(k) /= arm;
    const Eigen::MatrixXd whole = scaled.transpose() * stiffness * scaled;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(whole, Eigen::EigenvaluesOnly);
    const double largest = std::max(0.0, solver.eigenvalues().maxCoeff());
    return {largest, largest * arm * arm};
}

} // namespace kaya
