// Vectors and rotations of one body as plain numbers. The compiler keeps them in registers; it would store an Eigen vector on the stack by
// parts and stall when it is read as a whole.
#pragma once

#include "base/vector.hpp"
#include "mechanics/lanes/eight.hpp"

#include <cmath>
#include <type_traits>

namespace kaya {

/// T is double for one body, Eight for eight of them.
template <class T> struct TripleOf {
    T x, y, z;

    explicit TripleOf(const Vec3& v) requires std::is_same_v<T, double> : x(v.x()), y(v.y()), z(v.z()) {}
    TripleOf(const T& a, const T& b, const T& c) : x(a), y(b), z(c) {}
    friend TripleOf operator+(const TripleOf& a, const TripleOf& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend TripleOf operator-(const TripleOf& a, const TripleOf& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    template <class Scalar>
    requires std::is_same_v<Scalar, T> || std::is_arithmetic_v<Scalar>
    friend TripleOf operator*(const Scalar& s, const TripleOf& a) { return {s * a.x, s * a.y, s * a.z}; }
    T dot(const TripleOf& o) const { return x * o.x + y * o.y + z * o.z; }
    TripleOf cross(const TripleOf& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    Eight3 eights() const requires std::is_same_v<T, double> {
        return {kaya::eights(x), kaya::eights(y), kaya::eights(z)};
    }
    Vec3 vector() const requires std::is_same_v<T, double> { return {x, y, z}; }
};
using Triple = TripleOf<double>;

/// A rotation as a quaternion of length 1.
template <class T> struct RotorOf {
    T w;
    TripleOf<T> v;

    RotorOf conjugate() const { return {w, {-v.x, -v.y, -v.z}}; }
    friend RotorOf operator*(const RotorOf& a, const RotorOf& b) {
        return {a.w * b.w - a.v.dot(b.v), a.w * b.v + b.w * a.v + a.v.cross(b.v)};
    }
    TripleOf<T> turned(const TripleOf<T>& x) const {
        const TripleOf<T> t = (v + v).cross(x);
        return x + w * t + v.cross(t);
    }
    /// By a vector, angle times axis. Steps are small: below a thousandth of a turn the series is exact to the last
    /// bit and much faster than the functions.
    static RotorOf by(const TripleOf<T>& angle) {
        const T half2 = 0.25 * angle.dot(angle);
        if (all(half2 < 1e-5))
            return {1 - half2 * (0.5 - half2 * (1.0 / 24)), (0.5 - half2 * (1.0 / 12 - half2 * (1.0 / 240))) * angle};
        if constexpr (std::is_same_v<T, double>) {
            const double half = std::sqrt(half2);
            return {std::cos(half), (0.5 * std::sin(half) / half) * angle};
        } else {
            RotorOf rotors{T{}, {T{}, T{}, T{}}};
            for (int l = 0; l < eight; ++l) {
                const auto one = RotorOf<double>::by({angle.x[l], angle.y[l], angle.z[l]});
                rotors.w[l] = one.w;
                rotors.v.x[l] = one.v.x, rotors.v.y[l] = one.v.y, rotors.v.z[l] = one.v.z;
            }
            return rotors;
        }
    }
};
using Rotor = RotorOf<double>;

/// The inverse of a symmetric matrix that is positive definite.
template <class T> class SymmetricInverseOf {
public:
    /// Of `scale` times the matrix with the diagonal a, b, c and off it d (yz), e (xz), f (xy).
    SymmetricInverseOf(const T& a, const T& b, const T& c, const T& d, const T& e, const T& f, const T& scale) {
        xx_ = b * c - d * d;
        xy_ = d * e - f * c;
        xz_ = f * d - b * e;
        const T factor = 1 / (scale * (a * xx_ + f * xy_ + e * xz_));
        xx_ *= factor;
        xy_ *= factor;
        xz_ *= factor;
        yy_ = (a * c - e * e) * factor;
        yz_ = (e * f - a * d) * factor;
        zz_ = (a * b - f * f) * factor;
    }
    SymmetricInverseOf(const Mat3& m, double scale) requires std::is_same_v<T, double>
        : SymmetricInverseOf(m(0, 0), m(1, 1), m(2, 2), m(1, 2), m(0, 2), m(0, 1), scale) {}
    template <class V> TripleOf<V> operator*(const TripleOf<V>& v) const {
        return {xx_ * v.x + xy_ * v.y + xz_ * v.z, xy_ * v.x + yy_ * v.y + yz_ * v.z,
                xz_ * v.x + yz_ * v.y + zz_ * v.z};
    }
    /// Trace of the product of the inverse with the inertia of a unit mass at the arm v, in any direction: the
    /// compliance to three forces of 1 there.
    template <class V> V of_arm(const TripleOf<V>& v) const {
        const V x2 = v.x * v.x, y2 = v.y * v.y, z2 = v.z * v.z;
        return xx_ * (y2 + z2) + yy_ * (x2 + z2) + zz_ * (x2 + y2) -
               2 * (xy_ * v.x * v.y + yz_ * v.y * v.z + xz_ * v.x * v.z);
    }

private:
    T xx_, yy_, zz_, yz_, xz_, xy_;
};
using SymmetricInverse = SymmetricInverseOf<double>;

} // namespace kaya
