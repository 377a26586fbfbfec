// The surface of Mohr and Coulomb with a tension cut-off in principal stresses, and the return to it. The surface consists of planes and
// elasticity is linear, so that the return is exact: Koiter (1953) for edges and corners where several planes flow at once;
// docs/zone-models/mohr-coulomb.md has the equations, (n) below are their numbers.
#pragma once

#include "stdlib/zones/zone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace kaya::zones {

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// k s1 - s3 = q, flow m s1 - s3, and s1 <= tension: stresses are tension positive, s1 is the greatest.
struct Strength {
    double slope;    ///< k = (1 + sin phi)/(1 - sin phi)
    double uniaxial; ///< q = 2 c sqrt(k)
    double flow;     ///< m, of the dilation angle
    double tension;

    static double slope_of(double degrees) {
        const double sine = std::sin(degrees * radians);
        return (1 + sine) / (1 - sine);
    }
    /// The cut-off is below the apex.
    static Strength of(double cohesion, double friction, double dilation, double tension) {
        Strength s{slope_of(friction), 0, slope_of(dilation), tension};
        s.uniaxial = 2 * cohesion * std::sqrt(s.slope);
        if (s.slope > 1) s.tension = std::min(tension, s.uniaxial / (s.slope - 1));
        return s;
    }
    bool holds(double greatest, double least) const { // both are computed: a vector loop has no branches
        return (slope * greatest - least <= uniaxial) & (greatest <= tension);
    }
};

/// Result of a step of flow.
struct Flow {
    Vector3 strain{}; ///< plastic, in principal axes
    bool shear = false, tension = false;
    double along_tension = 0; ///< plastic strain by the cut-off
};

/// A plane of the surface: (a . s) <= r, flow along b.
struct Plane {
    Vector3 a, b;
    double r;
    bool of_tension;
};

/// The planes that meet where s1 >= s2 >= s3.
inline std::array<Plane, 6> planes_of(const Strength& s) {
    const double k = s.slope, m = s.flow, q = s.uniaxial, t = s.tension;
    return {Plane{{k, 0, -1}, {m, 0, -1}, q, false}, Plane{{k, -1, 0}, {m, -1, 0}, q, false},
            Plane{{0, k, -1}, {0, m, -1}, q, false}, Plane{{1, 0, 0}, {1, 0, 0}, t, true},
            Plane{{0, 1, 0}, {0, 1, 0}, t, true},    Plane{{0, 0, 1}, {0, 0, 1}, t, true}};
}

/// Which planes flow at once: faces, edges, corners, in the order in which they are tried. Numbers are those of planes_of.
struct ActiveSet {
    int count;
    int plane[3];
};
inline constexpr ActiveSet active_sets[] = {
    {1, {0}},       {1, {3}},       {2, {0, 2}},    {2, {0, 1}},    {2, {0, 3}},    {2, {3, 4}},   {3, {0, 1, 3}},
    {3, {0, 3, 4}}, {3, {0, 2, 3}}, {3, {0, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 4, 5}}, {3, {0, 1, 2}}};

/// Solves n equations (n <= 3) by elimination with pivots; false where they are not independent.
inline bool solve(int n, double (&m)[3][3], double (&x)[3]) {
    for (int c = 0; c < n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < n; ++r)
            if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
        if (std::abs(m[pivot][c]) < 1e-12 * std::abs(m[0][0]) || m[pivot][c] == 0) return false;
        for (int k = 0; k < n; ++k) std::swap(m[c][k], m[pivot][k]);
        std::swap(x[c], x[pivot]);
        for (int r = c + 1; r < n; ++r) {
            const double f = m[r][c] / m[c][c];
            for (int k = c; k < n; ++k) m[r][k] -= f * m[c][k];
            x[r] -= f * x[c];
        }
    }
    for (int c = n - 1; c >= 0; --c) {
        for (int k = c + 1; k < n; ++k) x[c] -= m[c][k] * x[k];
        x[c] /= m[c][c];
    }
    return true;
}

/// The return to the surface (3) of principal stresses, the greatest first.
class Return {
public:
    Return(const Strength& strength, const Moduli& moduli, const Vector3& tried)
        : moduli_(moduli), planes_(planes_of(strength)), tried_(tried),
          size_(std::max({std::abs(tried[0]), std::abs(tried[2]), strength.uniaxial / (1 + strength.slope)})) {}

    /// Whether these planes flow at once; then the stress and the flow. Inlined: with constant numbers no loop remains.
    [[gnu::always_inline]] bool flows(const ActiveSet& active, Vector3& s, Flow& flow) const {
        const int count = active.count;
        double matrix[3][3] = {}, amount[3] = {};
        for (int i = 0; i < count; ++i) {
            const Plane& plane = planes_[active.plane[i]];
            for (int j = 0; j < count; ++j) matrix[i][j] = dot(plane.a, stress_of(planes_[active.plane[j]].b));
            amount[i] = dot(plane.a, tried_) - plane.r;
        }
        if (!solve(count, matrix, amount)) return false;
        const double least = -rounding * size_ / moduli_.shear;
        if (std::any_of(amount, amount + count, [&](double x) { return x < least; })) return false;
        Vector3 strain{};
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) strain[k] += std::max(amount[i], 0.0) * planes_[active.plane[i]].b[k];
        const Vector3 lost = stress_of(strain), back{tried_[0] - lost[0], tried_[1] - lost[1], tried_[2] - lost[2]};
        if (std::any_of(planes_.begin(), planes_.end(),
                        [&](const Plane& p) { return dot(p.a, back) - p.r > rounding * size_ * length_of(p); }))
            return false;
        s = back;
        flow.strain = strain;
        for (int i = 0; i < count; ++i) {
            const bool of_tension = planes_[active.plane[i]].of_tension;
            (of_tension ? flow.tension : flow.shear) = true;
            if (of_tension) flow.along_tension += std::max(amount[i], 0.0);
        }
        return true;
    }

private:
    Vector3 stress_of(const Vector3& strain) const {
        const double volume = moduli_.lame() * (strain[0] + strain[1] + strain[2]);
        return {volume + 2 * moduli_.shear * strain[0], volume + 2 * moduli_.shear * strain[1],
                volume + 2 * moduli_.shear * strain[2]};
    }

    const Moduli& moduli_;
    const std::array<Plane, 6> planes_;
    const Vector3& tried_;
    /// Of the coefficients of a plane: an excess over it is so much larger than the distance from it.
    static double length_of(const Plane& p) { return std::abs(p.a[0]) + std::abs(p.a[1]) + std::abs(p.a[2]); }

    static constexpr double rounding = 1e-10;
    const double size_; ///< of the stresses
};

/// Brings principal stresses to the tip of a surface, where all are `tip`.
inline Flow to_tip(double tip, const Moduli& moduli, Vector3& s) {
    Flow flow;
    const double young = 9 * moduli.bulk * moduli.shear / (3 * moduli.bulk + moduli.shear),
                 poisson = 0.5 - young / (6 * moduli.bulk);
    const Vector3 lost{s[0] - tip, s[1] - tip, s[2] - tip};
    const double sum = lost[0] + lost[1] + lost[2];
    for (int k = 0; k < 3; ++k) flow.strain[k] = ((1 + poisson) * lost[k] - poisson * sum) / young;
    flow.along_tension = std::max(0.0, flow.strain[0]);
    flow.tension = true;
    s = {tip, tip, tip};
    return flow;
}

/// Brings principal stresses (the greatest first) back to the surface (3).
inline Flow return_to(const Strength& strength, const Moduli& moduli, Vector3& s) {
    Flow flow;
    if (strength.holds(s[0], s[2])) return flow;
    const Vector3 tried = s;
    const Return back(strength, moduli, tried);
    if (back.flows({1, {0}}, s, flow)) return flow; // by far the most
    for (std::size_t i = 1; i < std::size(active_sets); ++i)
        if (back.flows(active_sets[i], s, flow)) return flow;
    // Beyond every corner.
    return to_tip(std::isfinite(strength.tension) ? strength.tension : 0, moduli, s);
}

/// Bits of the state, as state_names has them: present flow and earlier flow.
inline constexpr const char* states_of_flow = "shear-now tension-now shear-past tension-past";
enum State : std::uint32_t { shear_now = 1, tension_now = 2, shear_past = 4, tension_past = 8 };

inline std::uint32_t state_after(std::uint32_t before, bool shear, bool tension) {
    std::uint32_t state = before & (shear_past | tension_past);
    if (before & shear_now) state |= shear_past;
    if (before & tension_now) state |= tension_past;
    return state | (shear ? shear_now : 0u) | (tension ? tension_now : 0u);
}

inline std::uint32_t bits_of(const Flow& flow) {
    return (flow.shear ? shear_now : 0u) | (flow.tension ? tension_now : 0u);
}

/// Marks the flow of the step before as past.
inline void forget_flow(kaya_zbatch& batch) {
    for (std::size_t i = 0; i < batch.n; ++i) batch.state[i] = state_after(batch.state[i], false, false);
}

/// The measure of plastic shear strain (5): the root of the second invariant of its deviator.
inline double shear_measure(const Vector3& strain) {
    const double mean = (strain[0] + strain[1] + strain[2]) / 3;
    double sum = 0;
    for (const double e : strain) sum += (e - mean) * (e - mean);
    return std::sqrt(0.5 * sum);
}

} // namespace kaya::zones
