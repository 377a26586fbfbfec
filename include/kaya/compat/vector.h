/* SPDX-License-Identifier: MIT */
/* Vectors of three numbers, in global axes. */
#ifndef KAYA_COMPAT_VECTOR_H
#define KAYA_COMPAT_VECTOR_H

#include <cmath>

class DVect3 {
public:
    DVect3() = default;
    DVect3(double x, double y, double z) : x_(x), y_(y), z_(z) {}
    explicit DVect3(double all) : x_(all), y_(all), z_(all) {}

    double x() const { return x_; }
    double y() const { return y_; }
    double z() const { return z_; }
    double& x() { return x_; }
    double& y() { return y_; }
    double& z() { return z_; }
    double& rx() { return x_; }
    double& ry() { return y_; }
    double& rz() { return z_; }

    double mag2() const { return x_ * x_ + y_ * y_ + z_ * z_; }
    double mag() const { return std::sqrt(mag2()); }

    DVect3& operator+=(const DVect3& b) {
        x_ += b.x_;
        y_ += b.y_;
        z_ += b.z_;
        return *this;
    }
    DVect3& operator-=(const DVect3& b) {
        x_ -= b.x_;
        y_ -= b.y_;
        z_ -= b.z_;
        return *this;
    }
    DVect3& operator*=(double factor) {
        x_ *= factor;
        y_ *= factor;
        z_ *= factor;
        return *this;
    }
    DVect3& operator/=(double divisor) {
        x_ /= divisor;
        y_ /= divisor;
        z_ /= divisor;
        return *this;
    }
    DVect3 operator-() const { return {-x_, -y_, -z_}; }

    friend DVect3 operator+(DVect3 a, const DVect3& b) { return a += b; }
    friend DVect3 operator-(DVect3 a, const DVect3& b) { return a -= b; }
    friend DVect3 operator*(DVect3 a, double factor) { return a *= factor; }
    friend DVect3 operator*(double factor, DVect3 a) { return a *= factor; }
    friend DVect3 operator/(DVect3 a, double divisor) { return a /= divisor; }
    friend bool operator==(const DVect3& a, const DVect3& b) { return a.x_ == b.x_ && a.y_ == b.y_ && a.z_ == b.z_; }
    friend bool operator!=(const DVect3& a, const DVect3& b) { return !(a == b); }
    /* scalar product */
    friend double operator|(const DVect3& a, const DVect3& b) { return a.x_ * b.x_ + a.y_ * b.y_ + a.z_ * b.z_; }

private:
    double x_ = 0, y_ = 0, z_ = 0;
};

#endif
