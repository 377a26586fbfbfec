// Stiffness matrices of one rigid body, six by six, and their largest eigenvalue: docs/theory/time-step.md.
#pragma once

#include "base/vector.hpp"
#include "mechanics/lanes/eight.hpp"

#include <Eigen/Core>
#include <cstdint>

namespace kaya {

/// Translations first, then rotations.
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Weighted sums over points: of the weight, and of the weight times position and its square.
struct Moments {
    double weight = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();

    void add(double w, const Vec3& place) {
        weight += w;
        first += w * place;
        second += (w * place) * place.transpose();
    }
    Moments operator*(double f) const { return {f * weight, f * first, f * second}; }
};

/// The same sums over points that come eight at a time.
class MomentsOfEights {
public:
    void add(const Eight& weight, const Eight3& place) {
        const Eight3 product = place * weight;
        weight_ += weight;
        first_ = first_ + product;
        square_ = square_ + Eight3{product.x * place.x, product.y * place.y, product.z * place.z};
        mixed_ = mixed_ + Eight3{product.y * place.z, product.x * place.z, product.x * place.y};
    }
    Moments sum() const {
        const Eight one = sums_of({weight_, first_.x, first_.y, first_.z, square_.x, square_.y, square_.z, mixed_.x});
        const double xz = kaya::sum(mixed_.y), xy = kaya::sum(mixed_.z), yz = one[7];
        Moments moments{one[0], Vec3(one[1], one[2], one[3]), {}};
        moments.second << one[4], xy, xz, xy, one[5], yz, xz, yz, one[6];
        return moments;
    }

private:
    Eight weight_{};
    Eight3 first_{}, square_{}, mixed_{};
};

/// The springs of one contact: weights are stiffnesses across and along its plane, positions are relative to its position.
struct SpringSums {
    Moments normal, shear;
};

/// A stiffness matrix of one body: symmetric, 21 numbers.
struct SpringMatrix {
    Eight translations{}; ///< xx, yy, zz, yz, xz, xy
    Eight mixed{};        ///< rows of translations, columns of rotations, column by column, but for the last number
    Eight rotations{};    ///< as translations, and the last number of the mixed ones

    /// Springs that hold a body; `arm` leads from the centre of the body to their origin.
    SpringMatrix(const SpringSums& springs, const Vec3& normal, const Vec3& arm);
    SpringMatrix() = default;

    /// Adds `times` another matrix.
    void add(double times, const SpringMatrix& o) {
        translations += times * o.translations;
        mixed += times * o.mixed;
        rotations += times * o.rotations;
    }
};

/// Coordinates in which the mass and the inertia of a rigid body are 1.
struct BodyFrame {
    Vec3 centre = Vec3::Zero();
    double root_of_mass = 0;             ///< 1 over it; 0 for what cannot move
    Mat3 root_of_inertia = Mat3::Zero(); ///< lower triangle L with L J L^T = 1
    std::uint8_t fixed = 0;              ///< Fixity bits

    bool moves() const { return root_of_mass > 0; }
    /// A stiffness matrix in these coordinates, (rad/time)^2; components that are held have zeros.
    Mat6 scaled(const SpringMatrix& stiffness) const;
};

/// `inertia` about the centre, global axes. Held components are left out (the others follow from their momentum).
BodyFrame make_frame(const Vec3& centre, double mass, const Mat3& inertia, std::uint8_t fixed);

/// An upper bound of the eigenvalues of a positive semidefinite symmetric matrix. It exceeds the largest by less than 0.4 %, or more where it
/// is at most `enough`.
double largest_eigenvalue(const Mat6& matrix, double enough = 0);

} // namespace kaya
