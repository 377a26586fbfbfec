// The stiffness of zones against the masses of their gridpoints, which bounds the time step.
#include "mechanics/zones/zone_frequencies.hpp"

#include "base/parallel.hpp"
#include "mechanics/zones/cells.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {

namespace {

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

std::array<Vec3, 4> places(const Model& model, Row z) {
    std::array<Vec3, 4> x;
    for (int a = 0; a < 4; ++a) x[a] = model.gridpoints.position[model.zones.gridpoints[z][a]];
    return x;
}

/// Of a volume 1 whose gradients have these products with themselves: the largest eigenvalue of its stiffness matrix, equation (7) of
/// docs/theory/time-step.md.
double stiffness_of(const Mat3& squares, const ElasticConstants& elastic) {
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(squares, Eigen::EigenvaluesOnly);
    const double greatest = (1 + rounding) * solver.eigenvalues()[2];
    return std::max(elastic.lambda, 0.0) * squares.trace() + elastic.two_shear * greatest;
}

/// Adds cells that strain together.
void add_cells(Model& model, Span zones, const ElasticConstants& elastic) {
    auto& g = model.gridpoints;
    for (Row first = zones.first; first < zones.end(); first += zones_of_cell) {
        const std::array<Row, 8> rows = corners_of_cell(&model.zones.gridpoints[first]);
        std::array<Vec3, 8> place;
        for (std::size_t c = 0; c < 8; ++c) place[c] = g.position[rows[c]];
        const double stiffness = stiffness_of_cell(place, elastic);
        for (const Row row : rows) g.zone_frequency[row] += stiffness / g.mass[row];
    }
}

} // namespace

double stiffness_of_cell(const std::array<Vec3, 8>& place, const ElasticConstants& elastic) {
    constexpr double with_warps = 4.0 / 3;
    std::array<Vec3, 8> gradient; // times the volume
    gradient.fill(Vec3::Zero());
    double volume = 0;
    for (const auto& corners : corners_of_zone) {
        const Corners zone({place[corners[0]], place[corners[1]], place[corners[2]], place[corners[3]]});
        volume += zone.volume;
        for (std::size_t a = 0; a < 4; ++a) gradient[corners[a]] += zone.volume * zone.gradient[a];
    }
    Mat3 squares = Mat3::Zero();
    for (const Vec3& b : gradient) squares += b * b.transpose() / (volume * volume);
    return with_warps * volume * stiffness_of(squares, elastic);
}

void zone_frequencies(Model& model, const ZoneLaws& laws) {
    auto& g = model.gridpoints;
    std::fill(g.zone_frequency.begin(), g.zone_frequency.end(), 0.0);
    constexpr std::size_t blocks_in_chunk = 4;
    // The zones of a block have its gridpoints alone.
    for_chunks(model.blocks.size(), blocks_in_chunk, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Span zones = model.blocks.zones[b];
            if (zones.count == 0) continue;
            const ZoneLaw& law = laws.of_block(static_cast<Row>(b));
            if (by_cells(law.together)) {
                add_cells(model, zones, law.elastic);
                continue;
            }
            for (Row z = zones.first; z < zones.end(); ++z) {
                const Corners now(places(model, z));
                Mat3 squares = Mat3::Zero();
                for (const auto& gradient : now.gradient) squares += gradient * gradient.transpose();
                const double stiffness = stiffness_of(squares, law.elastic) * now.volume;
                for (const Row row : model.zones.gridpoints[z]) g.zone_frequency[row] += stiffness / g.mass[row];
            }
        }
    });
}

} // namespace kaya
