#include "rigid_kernel.hpp"

#include <cmath>

namespace bench {

namespace {

constexpr double kn = 1e10, ks = 5e9, friction = 0.57735, cohesion = 1e5, damping = 0.8, mass = 2600;

template <class Eight> double sum(const Eight& v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

} // namespace

RigidKernel::RigidKernel(int along) {
    const auto row = [&](int i, int j, int k) { return (k * along + j) * along + i; };
    for (int k = 0; k < along; ++k)
        for (int j = 0; j < along; ++j)
            for (int i = 0; i < along; ++i) {
                Body b{};
                b.centre = {i + 0.5, j + 0.5, k + 0.5};
                b.orientation = {1, 0, 0, 0};
                if (k > 0) { // the lowest layer is fixed
                    b.inverse_mass = 1 / mass;
                    b.inverse_inertia = 6 / mass;
                    b.gravity = -9.81;
                }
                bodies_.push_back(b);
            }
    // One direction after another, and in each every second layer, as in a program with threads.
    for (int axis = 0; axis < 3; ++axis)
        for (int parity = 0; parity < 2; ++parity)
            for (int k = 0; k < along; ++k)
                for (int j = 0; j < along; ++j)
                    for (int i = 0; i < along; ++i) {
                        std::array<int, 3> at{i, j, k};
                        if (at[axis] % 2 != parity || at[axis] + 1 >= along) continue;
                        Pair p{};
                        p.first = row(i, j, k);
                        ++at[axis];
                        p.second = row(at[0], at[1], at[2]);
                        --at[axis];
                        p.n[axis] = -1;
                        for (int l = 0; l < 8; ++l) {
                            std::array<double, 3> x;
                            x[axis] = at[axis] + 1;
                            x[(axis + 1) % 3] = at[(axis + 1) % 3] + (l & 1);
                            x[(axis + 2) % 3] = at[(axis + 2) % 3] + (l >> 1 & 1);
                            p.x[l] = x[0], p.y[l] = x[1], p.z[l] = x[2];
                            p.area[l] = 1.0 / 8;
                        }
                        pairs_.push_back(p);
                    }
}

void RigidKernel::move(Body& b) const {
    for (int k = 0; k < 3; ++k) {
        double a = b.force[k] * b.inverse_mass + (k == 2 ? b.gravity : 0.0);
        a -= damping * std::abs(a) * (b.velocity[k] > 0 ? 1 : b.velocity[k] < 0 ? -1 : 0);
        b.velocity[k] += a * time_step_;
        b.centre[k] += b.velocity[k] * time_step_;
        double w = b.moment[k] * b.inverse_inertia;
        w -= damping * std::abs(w) * (b.spin[k] > 0 ? 1 : b.spin[k] < 0 ? -1 : 0);
        b.spin[k] += w * time_step_;
        b.force[k] = b.moment[k] = 0;
    }
    const auto& q = b.orientation;
    const double hx = 0.5 * time_step_ * b.spin[0], hy = 0.5 * time_step_ * b.spin[1],
                 hz = 0.5 * time_step_ * b.spin[2];
    std::array<double, 4> r{q[0] - hx * q[1] - hy * q[2] - hz * q[3], q[1] + hx * q[0] + hy * q[3] - hz * q[2],
                            q[2] - hx * q[3] + hy * q[0] + hz * q[1], q[3] + hx * q[2] - hy * q[1] + hz * q[0]};
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    for (int k = 0; k < 4; ++k) b.orientation[k] = r[k] / length;
}

void RigidKernel::load(Pair& p) {
    Body &a = bodies_[p.first], &b = bodies_[p.second];
    const auto& n = p.n;
    const Eight ax = p.x - a.centre[0], ay = p.y - a.centre[1], az = p.z - a.centre[2];
    const Eight bx = p.x - b.centre[0], by = p.y - b.centre[1], bz = p.z - b.centre[2];
    const Eight avx = a.velocity[0] + (a.spin[1] * az - a.spin[2] * ay),
                bvx = b.velocity[0] + (b.spin[1] * bz - b.spin[2] * by);
    const Eight avy = a.velocity[1] + (a.spin[2] * ax - a.spin[0] * az),
                bvy = b.velocity[1] + (b.spin[2] * bx - b.spin[0] * bz);
    const Eight avz = a.velocity[2] + (a.spin[0] * ay - a.spin[1] * ax),
                bvz = b.velocity[2] + (b.spin[0] * by - b.spin[1] * bx);
    const double half = 0.5 * time_step_;
    p.x += (avx + bvx) * half;
    p.y += (avy + bvy) * half;
    p.z += (avz + bvz) * half;
    const Eight ux = (avx - bvx) * time_step_, uy = (avy - bvy) * time_step_, uz = (avz - bvz) * time_step_;

    const Eight un = ux * n[0] + uy * n[1] + uz * n[2];
    const Eight out = p.shear_x * n[0] + p.shear_y * n[1] + p.shear_z * n[2];
    const Eight normal = p.normal - p.area * kn * un, ka = p.area * ks;
    const Eight sx = p.shear_x - out * n[0] - ka * (ux - un * n[0]);
    const Eight sy = p.shear_y - out * n[1] - ka * (uy - un * n[1]);
    const Eight sz = p.shear_z - out * n[2] - ka * (uz - un * n[2]);
    const Eight limit = normal * friction + p.area * cohesion, size2 = sx * sx + sy * sy + sz * sz;
    const Eight zero{};
    const Eight capped = limit > zero ? limit : zero;
    const Eight size2_or_one = size2 > zero ? size2 : zero + 1;
    Eight root;
    for (int l = 0; l < 8; ++l) root[l] = std::sqrt(size2_or_one[l]);
    const Eight scale = capped * capped < size2 ? capped / root : zero + 1;
    p.normal = normal > zero ? normal : zero;
    p.shear_x = normal > zero ? sx * scale : zero;
    p.shear_y = normal > zero ? sy * scale : zero;
    p.shear_z = normal > zero ? sz * scale : zero;

    const Eight fx = p.normal * n[0] + p.shear_x, fy = p.normal * n[1] + p.shear_y, fz = p.normal * n[2] + p.shear_z;
    const double x = sum(fx), y = sum(fy), z = sum(fz);
    a.force[0] += x, a.force[1] += y, a.force[2] += z;
    b.force[0] -= x, b.force[1] -= y, b.force[2] -= z;
    a.moment[0] += sum(ay * fz - az * fy), a.moment[1] += sum(az * fx - ax * fz), a.moment[2] += sum(ax * fy - ay * fx);
    b.moment[0] -= sum(by * fz - bz * fy), b.moment[1] -= sum(bz * fx - bx * fz), b.moment[2] -= sum(bx * fy - by * fx);
}

void RigidKernel::step() {
    for (auto& body : bodies_) move(body);
    for (auto& pair : pairs_) load(pair);
}

double RigidKernel::total_normal_force() const {
    double total = 0;
    for (const auto& pair : pairs_) total += sum(pair.normal);
    return total;
}

} // namespace bench
