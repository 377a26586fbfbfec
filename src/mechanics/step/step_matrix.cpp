#include "mechanics/step/step_matrix.hpp"

#include "mechanics/lanes/triple.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <type_traits>

namespace kaya {

namespace {

/// Squarings of a matrix: the 2^8th root of a trace is at most 6^(1/256) times the largest eigenvalue.
constexpr std::size_t squarings = 8;
/// Rounding deficit of a flat body's inertia, in parts of the largest moment.
constexpr double rounding = 1e-14;

/// The lower triangle L with L m L^T = 1: the inverse of Cholesky's factor.
Mat3 inverse_root(const Mat3& m) {
    const double a = std::sqrt(m(0, 0)), b = m(1, 0) / a, c = m(2, 0) / a;
    const double d = std::sqrt(m(1, 1) - b * b), e = (m(2, 1) - b * c) / d;
    const double f = std::sqrt(m(2, 2) - c * c - e * e);
    Mat3 inverse;
    inverse << 1 / a, 0, 0, -b / (a * d), 1 / d, 0, (b * e / d - c) / (a * f), -e / (d * f), 1 / f;
    return inverse;
}

Mat3 symmetric(const Eight& e) {
    Mat3 m;
    m << e[0], e[5], e[4], e[5], e[1], e[3], e[4], e[3], e[2];
    return m;
}

/// Second moments of the points about a place at -arm, as plain numbers.
struct SecondMoments {
    double weight;
    Triple first;
    double xx, yy, zz, yz, xz, xy;

    SecondMoments(const Moments& m, const Triple& arm) : weight(m.weight), first(Triple(m.first) + weight * arm) {
        const auto moved = [&](double second, double f_i, double f_j, double a_i, double a_j) {
            return second + a_i * f_j + a_j * f_i;
        };
        const Triple f(m.first);
        const auto& s = m.second;
        xx = moved(s(0, 0), first.x, f.x, arm.x, arm.x);
        yy = moved(s(1, 1), first.y, f.y, arm.y, arm.y);
        zz = moved(s(2, 2), first.z, f.z, arm.z, arm.z);
        yz = moved(s(1, 2), first.y, f.z, arm.y, arm.z);
        xz = moved(s(0, 2), first.x, f.z, arm.x, arm.z);
        xy = moved(s(0, 1), first.x, f.y, arm.x, arm.y);
    }
    SecondMoments operator-(const SecondMoments& o) const {
        SecondMoments d = *this;
        d.weight -= o.weight;
        d.first = first - o.first;
        d.xx -= o.xx, d.yy -= o.yy, d.zz -= o.zz;
        d.yz -= o.yz, d.xz -= o.xz, d.xy -= o.xy;
        return d;
    }
    Triple operator*(const Triple& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
    }
    double trace() const { return xx + yy + zz; }
};

/// A matrix of six columns, each in the first six lanes.
using SixColumns = std::array<Eight, 6>;

SixColumns columns_of(const Mat6& m) {
    SixColumns columns;
    for (int j = 0; j < 6; ++j) columns[j] = load_rows(m.col(j).data(), 6);
    return columns;
}

double trace_of(const SixColumns& m) { return ((m[0][0] + m[1][1]) + (m[2][2] + m[3][3])) + (m[4][4] + m[5][5]); }

/// The square of a symmetric matrix times a number.
SixColumns square_of(const SixColumns& m, double factor) {
    SixColumns square;
    const Eight twice = eights(factor * factor);
    for (std::size_t j = 0; j < 6; ++j) {
        const Eight f = twice * m[j];
        const auto of = [&]<int k>(std::integral_constant<int, k>) {
            return Eight(__builtin_shufflevector(f, f, k, k, k, k, k, k, k, k) * m[k]);
        };
        square[j] = ((of(std::integral_constant<int, 0>{}) + of(std::integral_constant<int, 1>{})) +
                     (of(std::integral_constant<int, 2>{}) + of(std::integral_constant<int, 3>{}))) +
                    (of(std::integral_constant<int, 4>{}) + of(std::integral_constant<int, 5>{}));
    }
    return square;
}

} // namespace

// A spring of weight w at the place r that sees the motion v = u + t x r of its body: (n . v)^2 = (n . u + t . (r x n))^2
// across the plane and v.v = u.u + 2 u . (t x r) + t . (r.r - r r^T) t in all directions. With D the second moments across the plane less
// those along it, [n] D [n]^T = (tr D - n . D n) 1 - D - tr D n n^T + (D n) n^T + n (D n)^T for a unit vector n.
SpringMatrix::SpringMatrix(const SpringSums& springs, const Vec3& normal, const Vec3& arm) {
    const Triple n(normal), a(arm);
    const SecondMoments along(springs.shear, a), more = SecondMoments(springs.normal, a) - along;
    const Triple of_normal = more * n, lever = more.first.cross(n);
    const double trace = more.trace(), all = trace - n.dot(of_normal) + along.trace();
    const auto second = [&](double of_i, double of_j, double n_i, double n_j, double of_more, double of_along) {
        return of_i * n_j + n_i * (of_j - trace * n_j) - of_more - of_along;
    };
    const double k = more.weight, w = along.weight;
    const Triple &f = along.first, &l = lever;
    translations = Eight{
        k * n.x * n.x + w, k * n.y * n.y + w, k * n.z * n.z + w, k * n.y * n.z, k * n.x * n.z, k * n.x * n.y, 0, 0};
    mixed = Eight{n.x * l.x, n.y * l.x - f.z, n.z * l.x + f.y, n.x * l.y + f.z,
                  n.y * l.y, n.z * l.y - f.x, n.x * l.z - f.y, n.y * l.z + f.x};
    rotations = Eight{second(of_normal.x, of_normal.x, n.x, n.x, more.xx, along.xx) + all,
                      second(of_normal.y, of_normal.y, n.y, n.y, more.yy, along.yy) + all,
                      second(of_normal.z, of_normal.z, n.z, n.z, more.zz, along.zz) + all,
                      second(of_normal.y, of_normal.z, n.y, n.z, more.yz, along.yz),
                      second(of_normal.x, of_normal.z, n.x, n.z, more.xz, along.xz),
                      second(of_normal.x, of_normal.y, n.x, n.y, more.xy, along.xy),
                      n.z * l.z,
                      0};
}

Mat6 BodyFrame::scaled(const SpringMatrix& stiffness) const {
    Mat3 mixed;
    for (int k = 0; k < 8; ++k) mixed(k % 3, k / 3) = stiffness.mixed[k];
    mixed(2, 2) = stiffness.rotations[6];
    Mat6 result;
    result.topLeftCorner<3, 3>() = root_of_mass * root_of_mass * symmetric(stiffness.translations);
    result.topRightCorner<3, 3>() = root_of_mass * mixed * root_of_inertia.transpose();
    result.bottomRightCorner<3, 3>() = root_of_inertia * symmetric(stiffness.rotations) * root_of_inertia.transpose();
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

// tr(S^p)^(1/p) falls to the largest eigenvalue as p grows: it is t0 t1^(1/2) t2^(1/4) ..., each t the trace of the square of the matrix
// that was divided by the previous one. It is at most `enough` where r, the square of the previous r over the trace, is at least 1.
double largest_eigenvalue(const Mat6& matrix, double enough) {
    std::array<double, squarings + 1> traces;
    SixColumns power = columns_of(matrix);
    traces[0] = trace_of(power);
    if (!(traces[0] > 0)) return 0;
    std::size_t last = 0;
    double r = enough / traces[0];
    while (last < squarings && r < 1) {
        power = square_of(power, 1 / traces[last]);
        traces[++last] = trace_of(power);
        r *= r / traces[last];
        if (traces[last] > 1 - 1e-13) break; // one direction is all
    }
    double product = 1;
    for (; last > 0; --last) product = std::sqrt(traces[last] * product);
    return traces[0] * product;
}

} // namespace kaya
