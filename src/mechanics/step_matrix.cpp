#include "mechanics/step_matrix.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kaya {

namespace {

/// Squarings of a matrix: the 2^8th root of a trace is at most 6^(1/256) times the largest eigenvalue.
constexpr int squarings = 8;
/// What a flat body's inertia is short of by rounding, in parts of the largest.
constexpr double rounding = 1e-14;

Mat3 cross_matrix(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// The lower triangle L with L m L^T = 1: the inverse of Cholesky's factor.
Mat3 inverse_root(const Mat3& m) {
    const double a = std::sqrt(m(0, 0)), b = m(1, 0) / a, c = m(2, 0) / a;
    const double d = std::sqrt(m(1, 1) - b * b), e = (m(2, 1) - b * c) / d;
    const double f = std::sqrt(m(2, 2) - c * c - e * e);
    Mat3 inverse;
    inverse << 1 / a, 0, 0, -b / (a * d), 1 / d, 0, (b * e / d - c) / (a * f), -e / (d * f), 1 / f;
    return inverse;
}

// Plain loops: the compiler warns of what Eigen's vector instructions leave unset here.

double trace_of(const Mat6& m) {
    double trace = 0;
    for (int i = 0; i < 6; ++i) trace += m(i, i);
    return trace;
}

/// Of a symmetric matrix times a number.
Mat6 square_of(const Mat6& m, double factor) {
    Mat6 square;
    for (int j = 0; j < 6; ++j) {
        double column[6] = {0, 0, 0, 0, 0, 0};
        for (int k = 0; k < 6; ++k) {
            const double f = factor * factor * m(k, j);
            for (int i = 0; i < 6; ++i) column[i] += f * m(i, k);
        }
        for (int i = 0; i < 6; ++i) square(i, j) = column[i];
    }
    return square;
}

} // namespace

// A spring of weight w at the place r that sees the motion v = u + t x r of its body: (n . v)^2 = (n . u + t . (r x n))^2
// across the plane and v.v = u.u + 2 u . (t x r) + t . (r.r - r r^T) t in all directions.
void add_springs(Mat6& matrix, const SpringSums& springs, const Vec3& normal, const Vec3& arm, double times) {
    const Moments all = (springs.shear * times).from(arm), across = (springs.normal * times).from(arm);
    const double weight = across.weight - all.weight;
    const Mat3 n = cross_matrix(normal);
    const Vec3 lever = (across.first - all.first).cross(normal);
    const Mat3 first = cross_matrix(all.first);
    const Mat3 second = n * (across.second - all.second) * n.transpose();

    matrix.topLeftCorner<3, 3>() += weight * normal * normal.transpose();
    matrix.topLeftCorner<3, 3>().diagonal().array() += all.weight;
    const Mat3 mixed = normal * lever.transpose() - first;
    matrix.topRightCorner<3, 3>() += mixed;
    matrix.bottomLeftCorner<3, 3>() += mixed.transpose();
    matrix.bottomRightCorner<3, 3>() += second - all.second;
    matrix.bottomRightCorner<3, 3>().diagonal().array() += all.second.trace();
}

Mat6 BodyFrame::scaled(const Mat6& stiffness) const {
    Mat6 result;
    result.topLeftCorner<3, 3>() = root_of_mass * root_of_mass * stiffness.topLeftCorner<3, 3>();
    result.topRightCorner<3, 3>() = root_of_mass * stiffness.topRightCorner<3, 3>() * root_of_inertia.transpose();
    result.bottomRightCorner<3, 3>() =
        root_of_inertia * stiffness.bottomRightCorner<3, 3>() * root_of_inertia.transpose();
    for (int k = 0; k < 3; ++k)
        if (fixed & (1 << k)) {
            result.row(k).setZero();
            result.col(k).head<3>().setZero();
        }
    result.bottomLeftCorner<3, 3>() = result.topRightCorner<3, 3>().transpose();
    return result;
}

BodyFrame make_frame(const Vec3& centre, double mass, const Mat3& inertia, std::uint8_t fixed) {
    BodyFrame frame;
    frame.centre = centre;
    frame.fixed = fixed;
    if (!(mass > 0) || fixed == 63 /* all */) return frame;
    frame.root_of_mass = 1 / std::sqrt(mass);
    Mat3 free = inertia;
    free.diagonal().array() += rounding * inertia.trace();
    for (int k = 0; k < 3; ++k)
        if (fixed & (8 << k)) {
            free.row(k).setZero();
            free.col(k).setZero();
            free(k, k) = 1;
        }
    frame.root_of_inertia = inverse_root(free);
    for (int k = 0; k < 3; ++k)
        if (fixed & (8 << k)) frame.root_of_inertia.row(k).setZero();
    return frame;
}

// tr(S^p)^(1/p) falls to the largest eigenvalue as p grows.
double largest_eigenvalue(const Mat6& matrix) {
    double trace = trace_of(matrix);
    if (!(trace > 0)) return 0;
    Mat6 power = matrix;
    double log = 0, part = 1;
    for (int i = 0; i < squarings; ++i) {
        log += part * std::log(trace);
        part *= 0.5;
        power = square_of(power, 1 / trace);
        trace = trace_of(power);
        if (trace > 1 - 1e-13) break; // one direction is all
    }
    return std::exp(log + part * std::log(trace));
}

} // namespace kaya
