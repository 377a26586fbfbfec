// The bare method of a rigid block cycle: a reference for the speed of a program.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bench {

/// Unit cubes packed `along` in each direction, eight sub-contacts on every common face with Coulomb's law; the lowest layer is fixed and
/// the others rest on it. It omits what kaya must do: sub-contacts never leave their contact, there is one material, the law is compiled
/// in, there is no energy account and orientations are not exact.
class RigidKernel {
public:
    explicit RigidKernel(int along);

    void step();
    std::size_t bodies() const { return bodies_.size(); }
    std::size_t pairs() const { return pairs_.size(); }
    /// Sum of the normal forces of all sub-contacts: at rest the weight above every layer.
    double total_normal_force() const;

private:
    typedef double Eight __attribute__((vector_size(64)));

    struct Body {
        std::array<double, 3> centre, velocity, spin, force, moment;
        std::array<double, 4> orientation;
        double inverse_mass, inverse_inertia, gravity;
    };
    struct Pair {
        Eight x, y, z, area, normal, shear_x, shear_y, shear_z;
        std::array<double, 3> n; ///< from the second body to the first
        int first, second;
    };
    void move(Body& body) const;
    void load(Pair& pair);

    std::vector<Body> bodies_;
    std::vector<Pair> pairs_;
    double time_step_ = 1e-4;
};

} // namespace bench
