// Random vectors and rotations for tests of elements.
#pragma once

#include "base/vector.hpp"

#include <Eigen/Geometry>
#include <random>

namespace kaya::test {

inline Mat3 turn_of(const Vec3& rotation) {
    const double angle = rotation.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() : Mat3::Identity();
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double most) { return std::uniform_real_distribution<double>(-most, most)(engine_); }
    Vec3 vector(double most) { return {(*this)(most), (*this)(most), (*this)(most)}; }
    Mat3 turn() {
        return Eigen::Quaterniond((*this)(1), (*this)(1), (*this)(1), (*this)(1)).normalized().toRotationMatrix();
    }

private:
    std::mt19937 engine_;
};

} // namespace kaya::test
