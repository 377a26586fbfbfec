// The vectors and matrices that every other folder uses.
#pragma once

#include <Eigen/Core>

namespace kaya {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Symmetric tensor in the order of the language: xx yy zz xy xz yz; compression negative.
using Stress = Eigen::Matrix<double, 6, 1>;

inline Mat3 matrix_of(const Stress& s) {
    Mat3 m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return m;
}

inline Stress stress_of(const Mat3& m) {
    Stress s;
    s << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
    return s;
}

} // namespace kaya
