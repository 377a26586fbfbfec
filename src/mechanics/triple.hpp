// Vectors and rotations of one body as plain numbers. The compiler keeps them in registers, where it would put an Eigen
// vector on the stack by parts and wait for it to be read back whole.
#pragma once

#include "base/vector.hpp"
#include "mechanics/eight.hpp"

#include <cmath>

namespace kaya {

struct Triple {
    double x, y, z;

    explicit Triple(const Vec3& v) : x(v.x()), y(v.y()), z(v.z()) {}
    Triple(double a, double b, double c) : x(a), y(b), z(c) {}
    friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
    double dot(const Triple& o) const { return x * o.x + y * o.y + z * o.z; }
    Triple cross(const Triple& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    Eight3 eights() const { return {kaya::eights(x), kaya::eights(y), kaya::eights(z)}; }
    Vec3 vector() const { return {x, y, z}; }
};

/// A rotation as a quaternion of length 1.
struct Rotor {
    double w;
    Triple v;

    Rotor conjugate() const { return {w, {-v.x, -v.y, -v.z}}; }
    friend Rotor operator*(const Rotor& a, const Rotor& b) {
        return {a.w * b.w - a.v.dot(b.v), a.w * b.v + b.w * a.v + a.v.cross(b.v)};
    }
    Triple turned(const Triple& x) const {
        const Triple t = 2 * v.cross(x);
        return x + w * t + v.cross(t);
    }
    /// By a vector, angle times axis. Steps are small: below a thousandth of a turn the series is exact to the last
    /// bit and much faster than the functions.
    static Rotor by(const Triple& angle) {
        const double half2 = 0.25 * angle.dot(angle);
        if (half2 < 1e-5)
            return {1 - half2 * (0.5 - half2 * (1.0 / 24)), (0.5 - half2 * (1.0 / 12 - half2 * (1.0 / 240))) * angle};
        const double half = std::sqrt(half2);
        return {std::cos(half), (0.5 * std::sin(half) / half) * angle};
    }
};

/// The inverse of a symmetric matrix that is positive definite.
class SymmetricInverse {
public:
    /// Of `scale` times the matrix.
    SymmetricInverse(const Mat3& m, double scale) {
        const double a = m(0, 0), b = m(1, 1), c = m(2, 2), d = m(1, 2), e = m(0, 2), f = m(0, 1);
        xx_ = b * c - d * d;
        xy_ = d * e - f * c;
        xz_ = f * d - b * e;
        const double factor = 1 / (scale * (a * xx_ + f * xy_ + e * xz_));
        xx_ *= factor;
        xy_ *= factor;
        xz_ *= factor;
        yy_ = (a * c - e * e) * factor;
        yz_ = (e * f - a * d) * factor;
        zz_ = (a * b - f * f) * factor;
    }
    Triple operator*(const Triple& v) const {
        return {xx_ * v.x + xy_ * v.y + xz_ * v.z, xy_ * v.x + yy_ * v.y + yz_ * v.z,
                xz_ * v.x + yz_ * v.y + zz_ * v.z};
    }
    /// Trace of the product of the inverse with the inertia of a unit mass at the arm v, in any direction: the
    /// compliance to three forces of 1 there.
    double of_arm(const Triple& v) const {
        const double x2 = v.x * v.x, y2 = v.y * v.y, z2 = v.z * v.z;
        return xx_ * (y2 + z2) + yy_ * (x2 + z2) + zz_ * (x2 + y2) -
               2 * (xy_ * v.x * v.y + yz_ * v.y * v.z + xz_ * v.x * v.z);
    }

private:
    double xx_, yy_, zz_, yz_, xz_, xy_;
};

} // namespace kaya
