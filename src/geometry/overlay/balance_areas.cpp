// Areas of sub-contacts by which rigid faces resist tilting as a continuous joint does.
#include "geometry/overlay/overlay_scratch.hpp"

#include "base/plane_cross.hpp"
#include "base/vector.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// The shortest solution of a x = b for a symmetric matrix without negative eigenvalues, on the space where it has
/// any: few points leave fewer than three things to choose.
Vec3 least_squares(const Mat3& a, const Vec3& b) {
    constexpr double nothing = 1e-9; // an eigenvalue, in parts of the largest
    const double trace = a.trace();
    const double pairs = 0.5 * (trace * trace - a.squaredNorm()); // sum of the products of two eigenvalues
    if (pairs <= nothing * trace * trace) {
        // One eigenvalue only, as four points leave it; the longest column is its eigenvector.
        int longest = 0;
        a.diagonal().maxCoeff(&longest);
        const Vec3 mode = a.col(longest).normalized();
        return mode * (mode.dot(b) / trace);
    }
    Mat3 adjoint; // its eigenvalues are those products
    adjoint << a.col(1).cross(a.col(2)), a.col(2).cross(a.col(0)), a.col(0).cross(a.col(1));
    const double determinant = a.col(0).dot(adjoint.col(0));
    // Rounding makes a determinant of 1e-16 trace^3.
    if (determinant > nothing * trace * std::max(pairs, 1e-6 * trace * trace)) return adjoint * b / determinant;
    // Two, as five points leave them: the adjoint matrix is along the third eigenvector, which gets an eigenvalue.
    int longest = 0;
    adjoint.diagonal().maxCoeff(&longest);
    const Vec3 none = adjoint.col(longest).normalized();
    const Mat3 whole = a + trace * none * none.transpose();
    const Vec3 right = b - none * none.dot(b);
    adjoint << whole.col(1).cross(whole.col(2)), whole.col(2).cross(whole.col(0)), whole.col(0).cross(whole.col(1));
    return adjoint * right / whole.col(0).dot(adjoint.col(0));
}

using SampleGroup = OverlayScratch::SampleGroup;
using Four = SampleGroup::Four;

double sum(const Four& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// Where the areas change the second moments by less there is nothing to be had.
constexpr double least_effect = 1e-9;

/// Limits a relative change of area so that no point loses more than three quarters of its area or quadruples it.
double allowed_part(double change) { return change < -0.75 ? -0.75 / change : change > 3 ? 3 / change : 1; }

/// Axes about the centre in which the overlap's own second moments are the unit matrix.
struct Axes {
    Vec2 centre;
    double scale_x, scale_y, shear;
};

/// For four points, which leave one change: that of the dependency between their places, sum n = sum n x = 0.
void balance_four(std::vector<OverlayPoint>& points, double whole, const Axes& axes) {
    std::array<Vec2, 4> at;
    for (int i = 0; i < 4; ++i) {
        const Vec2 d = points[i].place - axes.centre;
        at[i] = {axes.scale_x * d.x(), axes.scale_y * (d.y() - axes.shear * d.x())};
    }
    const auto doubled = [&](int a, int b, int c) { return cross(at[b] - at[a], at[c] - at[a]); };
    const std::array<double, 4> n{doubled(1, 2, 3), -doubled(0, 2, 3), doubled(0, 1, 3), -doubled(0, 1, 2)};
    Vec3 wrong(-1, -1, 0), effect = Vec3::Zero();
    double size = 0;
    for (int i = 0; i < 4; ++i) {
        const Vec3 f(at[i].x() * at[i].x(), at[i].y() * at[i].y(), std::sqrt(2.0) * at[i].x() * at[i].y());
        const double weight = points[i].area / whole;
        wrong += weight * f;
        effect += n[i] * f;
        size += n[i] * n[i] / weight;
    }
    const double squared = effect.squaredNorm();
    if (!(squared > least_effect * size)) return;
    const double amount = -effect.dot(wrong) / squared;
    double part = 1;
    std::array<double, 4> change;
    for (int i = 0; i < 4; ++i) part = std::min(part, allowed_part(change[i] = amount * n[i] * whole / points[i].area));
    for (int i = 0; i < 4; ++i) points[i].area *= 1 + part * change[i];
}

/// The same for any number of points: the smallest changes of their areas that do it.
void balance_many(std::vector<OverlayPoint>& points, double whole, const Axes& axes,
                  std::vector<SampleGroup>& samples) {
    // The second moments u u, v v, u v minus their targets 1, 1, 0. (The root of 2 makes a sum of squares that does not depend on the
    // axes.)
    samples.clear();
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 3, 2> mixed = Eigen::Matrix<double, 3, 2>::Zero();
    Vec3 mean = Vec3::Zero();
    for (std::size_t first = 0; first < points.size(); first += SampleGroup::size) {
        SampleGroup& s = samples.emplace_back();
        Four x = Four::Zero(), y = Four::Zero();
        s.weight.setZero();
        for (std::size_t i = 0; i < SampleGroup::size && first + i < points.size(); ++i) {
            const OverlayPoint& p = points[first + i];
            x[i] = p.place.x() - axes.centre.x();
            y[i] = p.place.y() - axes.centre.y();
            s.weight[i] = p.area / whole;
        }
        s.u = axes.scale_x * x;
        s.v = axes.scale_y * (y - axes.shear * x);
        s.f = {s.u * s.u, s.v * s.v, std::sqrt(2.0) * s.u * s.v};
        const Four wu = s.weight * s.u, wv = s.weight * s.v;
        spread(0, 0) += sum(wu * s.u);
        spread(0, 1) += sum(wu * s.v);
        spread(1, 1) += sum(wv * s.v);
        for (int k = 0; k < 3; ++k) {
            mixed(k, 0) += sum(wu * s.f[k]);
            mixed(k, 1) += sum(wv * s.f[k]);
            mean[k] += sum(s.weight * s.f[k]);
        }
    }
    spread(1, 0) = spread(0, 1);
    const Vec3 wrong = mean - Vec3(1, 1, 0);
    if (wrong.norm() < 1e-12) return;
    // Relative changes of the areas that keep their sum and centre: the functions minus their projections on 1, x and y in the scalar
    // product weighted with the areas.
    const Eigen::Matrix<double, 3, 2> slope = mixed * spread.inverse();
    Mat3 effect = Mat3::Zero();
    for (auto& s : samples) {
        for (int k = 0; k < 3; ++k) s.f[k] -= mean[k] + slope(k, 0) * s.u + slope(k, 1) * s.v;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l <= k; ++l) effect(k, l) += sum(s.weight * s.f[k] * s.f[l]);
    }
    effect = Mat3(effect.selfadjointView<Eigen::Lower>());
    const double trace = effect.trace();
    if (!(trace > least_effect)) return;
    const Vec3 amount = -least_squares(effect, wrong);

    double part = 1;
    for (auto& s : samples) {
        s.change = amount[0] * s.f[0] + amount[1] * s.f[1] + amount[2] * s.f[2];
        for (int i = 0; i < Four::SizeAtCompileTime; ++i) {
            if (s.weight[i] > 0) part = std::min(part, allowed_part(s.change[i])); // otherwise no point
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].area *=
            1 + part * samples[i / SampleGroup::size].change[static_cast<Eigen::Index>(i % SampleGroup::size)];
}

} // namespace

void balance_areas(Overlay& overlay) {
    OverlayScratch scratch;
    balance_areas(overlay, scratch);
}

void balance_areas(Overlay& overlay, OverlayScratch& scratch) {
    auto& points = overlay.points;
    if (points.size() < 4) return; // the centre decides
    double whole = 0;
    Vec2 centre = Vec2::Zero();
    for (const auto& p : points) {
        whole += p.area;
        centre += p.area * p.place;
    }
    centre /= whole;

    // Coordinates in which the overlap's own second moments are the unit matrix, by its Cholesky factor.
    const Eigen::Matrix2d exact = overlay.second_moment / whole - centre * centre.transpose();
    const double xx = exact(0, 0), xy = exact(0, 1), determinant = exact.determinant(), size = exact.trace();
    if (!(xx > 0 && determinant > 1e-18 * size * size)) return;
    const Axes axes{centre, 1 / std::sqrt(xx), std::sqrt(xx / determinant), xy / xx};
    if (points.size() == 4) balance_four(points, whole, axes);
    else balance_many(points, whole, axes, scratch.samples);
}

} // namespace kaya
