#include "slopes/turning.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace kaya {

namespace {

/// Whether a sum of columns with factors of 0 or more gives the vector: least squares by the method of Lawson and Hanson (1974).
bool is_sum_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted) {
    constexpr double least_gain = 1e-10, same = 1e-6; // of vectors of size 1
    const auto count = static_cast<std::size_t>(columns.cols());
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(columns.cols()), left = wanted;
    std::vector<Eigen::Index> used;
    for (std::size_t round = 0; round < 3 * count + 30 && left.norm() > same; ++round) {
        Eigen::VectorXd gain = columns.transpose() * left;
        for (const auto i : used) gain[i] = 0;
        Eigen::Index next = 0;
        if (!(gain.maxCoeff(&next) > least_gain)) break;
        used.push_back(next);
        while (!used.empty()) {
            const Eigen::VectorXd best = columns(Eigen::all, used).colPivHouseholderQr().solve(wanted);
            double part = 1; // fraction of the step until the first factor falls to 0
            for (std::size_t k = 0; k < used.size(); ++k) {
                const auto i = static_cast<Eigen::Index>(k);
                if (best[i] <= 0) part = std::min(part, factors[used[k]] / (factors[used[k]] - best[i]));
            }
            for (std::size_t k = 0; k < used.size(); ++k)
                factors[used[k]] += part * (best[static_cast<Eigen::Index>(k)] - factors[used[k]]);
            if (part == 1) break;
            std::erase_if(used, [&](Eigen::Index i) { return factors[i] <= 1e-14 ? (factors[i] = 0, true) : false; });
        }
        left = wanted - columns * factors;
    }
    return left.norm() <= same;
}

/// The equations of equilibrium of a block on its corners: force, moment over `length`, and one for each corner with cohesion. In fractions
/// of the force.
class Balance {
public:
    Balance(const Vec3& force, const Vec3& moment, std::span<const RestingCorner> corners) : corners_(corners) {
        length_ = 0;
        for (const RestingCorner& corner : corners) length_ = std::max(length_, corner.arm.norm());
        size_ = std::hypot(force.norm(), moment.norm() / length_);
        load_ << force / size_, moment / (size_ * length_);
    }

    /// `least_inverse` 0 is without strength.
    bool holds(double inverse_factor) const {
        std::vector<Eigen::Index> cohesive(corners_.size(), -1);
        Eigen::Index rows = 6;
        for (std::size_t i = 0; i < corners_.size(); ++i)
            if (inverse_factor * corners_[i].strength.cohesion > 0) cohesive[i] = rows++;
        std::vector<Eigen::VectorXd> columns;
        Eigen::VectorXd wanted = Eigen::VectorXd::Zero(rows);
        wanted.head<6>() = load_;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const RestingCorner& corner = corners_[i];
            const Vec3 u = corner.outward.unitOrthogonal(), v = corner.outward.cross(u);
            const double friction = inverse_factor * corner.strength.tan_friction;
            const auto add = [&](const Vec3& force, double cohesion) {
                Eigen::VectorXd& column = columns.emplace_back(Eigen::VectorXd::Zero(rows));
                column.head<6>() << force, corner.arm.cross(force) / length_;
                if (cohesion != 0) column[cohesive[i]] = cohesion;
            };
            const auto add_around = [&](const Vec3& middle, double shear, double cohesion) {
                for (int k = 0; k < directions; ++k) {
                    const double angle = 2 * std::numbers::pi * k / directions;
                    add(middle + shear * (std::cos(angle) * u + std::sin(angle) * v), cohesion);
                }
            };
            if (friction > 0) add_around(corner.outward, friction, 0);
            else add(corner.outward, 0);
            if (cohesive[i] < 0) continue;
            const double most = std::min(1e3, inverse_factor * corner.strength.cohesion * corner.area / size_);
            wanted[cohesive[i]] = 1;
            add_around(Vec3::Zero(), most, 1);
            add(Vec3::Zero(), 1); // the part that is not needed
        }
        Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(columns.size()));
        for (std::size_t k = 0; k < columns.size(); ++k) matrix.col(static_cast<Eigen::Index>(k)) = columns[k];
        return is_sum_of(matrix, wanted);
    }

private:
    static constexpr int directions = 16; // of shear: 2 % less than a circle at most

    std::span<const RestingCorner> corners_;
    double length_, size_;
    Eigen::Matrix<double, 6, 1> load_;
};

} // namespace

std::optional<double> turning_factor(const Vec3& force, const Vec3& moment, std::span<const RestingCorner> corners) {
    constexpr double least = 1e-3, most = 1e3, exact = 1e-5;
    if (corners.empty() || !(force.norm() > 0)) return std::nullopt;
    const Balance balance(force, moment, corners);
    if (balance.holds(0)) return std::nullopt;
    if (!balance.holds(1 / least)) return 0;
    double low = least, high = most;
    while (high > (1 + exact) * low) {
        const double middle = std::sqrt(low * high);
        (balance.holds(1 / middle) ? low : high) = middle;
    }
    return low;
}

} // namespace kaya
