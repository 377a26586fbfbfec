#include "base/reduce.hpp"
#include "mechanics/dashpots.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace kaya {

namespace {

constexpr std::size_t grain = 256;
constexpr double rounding = 1e-9; ///< of an eigenvalue

/// Volume and gradients of the shape functions of a linear tetrahedron.
struct Corners {
    std::array<Vec3, 4> gradient;
    double volume;

    explicit Corners(const std::array<Vec3, 4>& x) {
        const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
        const Vec3 c1 = e2.cross(e3), c2 = e3.cross(e1), c3 = e1.cross(e2);
        const double six_volumes = e1.dot(c1);
        volume = six_volumes / 6;
        gradient[1] = c1 / six_volumes;
        gradient[2] = c2 / six_volumes;
        gradient[3] = c3 / six_volumes;
        gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    }
};

std::array<Vec3, 4> places(const Model& model, std::size_t z) {
    std::array<Vec3, 4> x;
    for (int a = 0; a < 4; ++a) x[a] = model.gridpoints.position[model.zones.gridpoints[z][a]];
    return x;
}

void put_forces(const Model& model, std::size_t z, std::vector<Vec3>& corner_forces) {
    const Corners now(places(model, z));
    const Mat3 stress = matrix_of(model.zones.stress[z] + model.zones.dashpot[z]);
    for (int a = 0; a < 4; ++a) corner_forces[4 * z + a] = -now.volume * (stress * now.gradient[a]);
}

} // namespace

ZoneSums run_zone_models(Model& model, const std::vector<ElasticConstants>& elastic, std::vector<Vec3>& corner_forces) {
    auto& zones = model.zones;
    const auto& v = model.gridpoints.velocity;
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    const double damping = stiffness_damping(model.settings) / step;
    return reduce_chunks(zones.size(), grain, ZoneSums{}, [&](std::size_t first, std::size_t last) {
        ZoneSums sums;
        for (std::size_t z = first; z < last; ++z) {
            std::array<Vec3, 4> way, middle = places(model, z);
            for (int a = 0; a < 4; ++a) {
                way[a] = step * v[zones.gridpoints[z][a]];
                if (large) middle[a] -= 0.5 * way[a];
            }
            // Gradient of the step's motion with respect to the configuration in its middle: a rigid turn
            // gives no strain (Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15).
            const Corners mid(middle);
            Mat3 gradient = Mat3::Zero();
            for (int a = 0; a < 4; ++a) gradient += way[a] * mid.gradient[a].transpose();
            const Mat3 strain = 0.5 * (gradient + gradient.transpose());
            Mat3 stress = matrix_of(zones.stress[z]);
            if (large) {
                const Mat3 spin = 0.5 * (gradient - gradient.transpose());
                const Mat3 turn = (Mat3::Identity() - 0.5 * spin).inverse() * (Mat3::Identity() + 0.5 * spin);
                stress = turn * stress * turn.transpose();
            }
            const Mat3 before = stress;
            const auto& [lambda, two_shear] = elastic[zones.block[z]];
            stress += two_shear * strain;
            stress.diagonal().array() += lambda * strain.trace();
            zones.stress[z] = stress_of(stress);
            sums.work += 0.5 * mid.volume * (before + stress).cwiseProduct(strain).sum();
            if (damping > 0) {
                const Mat3 viscous = damping * (stress - before), last_one = matrix_of(zones.dashpot[z]);
                sums.damped += 0.5 * mid.volume * (last_one + viscous).cwiseProduct(strain).sum();
                zones.dashpot[z] = stress_of(viscous);
            }
            put_forces(model, z, corner_forces);
        }
        return sums;
    }, [](ZoneSums& sum, const ZoneSums& part) {
        sum.work += part.work;
        sum.damped += part.damped;
    });
}

void zone_forces(const Model& model, std::vector<Vec3>& corner_forces) {
    corner_forces.assign(4 * model.zones.size(), Vec3::Zero());
    for_chunks(model.zones.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t z = first; z < last; ++z) put_forces(model, z, corner_forces);
    });
}

void zone_frequencies(Model& model, const std::vector<ElasticConstants>& elastic) {
    auto& g = model.gridpoints;
    std::fill(g.zone_frequency.begin(), g.zone_frequency.end(), 0.0);
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        const Corners now(places(model, z));
        Mat3 squares = Mat3::Zero();
        for (const auto& gradient : now.gradient) squares += gradient * gradient.transpose();
        // The largest eigenvalue of a zone's stiffness matrix: equation (7) of docs/theory/time-step.md.
        const auto& [lambda, two_shear] = elastic[model.zones.block[z]];
        Eigen::SelfAdjointEigenSolver<Mat3> solver;
        solver.computeDirect(squares, Eigen::EigenvaluesOnly);
        const double largest = (1 + rounding) * solver.eigenvalues()[2];
        const double stiffness = (std::max(lambda, 0.0) * squares.trace() + two_shear * largest) * now.volume;
        for (const Row row : model.zones.gridpoints[z]) g.zone_frequency[row] += stiffness / g.mass[row];
    }
}

} // namespace kaya
