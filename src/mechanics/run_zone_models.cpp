#include "base/reduce.hpp"
#include "mechanics/crushed_zones.hpp"
#include "mechanics/dashpots.hpp"
#include "mechanics/phases.hpp"
#include "mechanics/zone_laws.hpp"
#include "model/measure.hpp"
#include "model/water.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <fmt/format.h>

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

namespace {

constexpr std::size_t most = static_cast<std::size_t>(most_zones_in_batch);

/// What a zone model sees of a batch, and what the account of energy needs besides.
struct Columns {
    double strain[6][most], before[6][most], stress[6][most], volume[most], volume_strain[most], pressure[most], dissipation[most];
    double* history[KAYA_JMODEL_MAX_HISTORY];
    kaya_zbatch batch;

    Columns(Model& model, const ZoneBatch& rows, const ZoneLaw& law) {
        batch = {};
        batch.n = static_cast<std::size_t>(rows.last - rows.first);
        batch.properties = law.values.data();
        batch.time_step = model.clock.time_step;
        batch.volume = volume;
        batch.pore_pressure = pressure;
        batch.dissipation = dissipation;
        batch.state = model.zones.state.data() + rows.first;
        for (int k = 0; k < 6; ++k) {
            batch.strain_inc[k] = strain[k];
            batch.stress[k] = stress[k];
        }
        for (std::size_t k = 0; k < law.model->history.size(); ++k) history[k] = model.zones.history[k].data() + rows.first;
        batch.history = history;
        std::fill_n(dissipation, batch.n, 0.0);
    }
};

/// The strain of a step and the stress before it, turned with the material.
struct Deformation {
    double volume;
    Mat3 strain, stress;
};

/// Gradient of the step's motion with respect to the configuration in its middle: a rigid turn gives no strain (Hughes and
/// Winget 1980, Int. J. Numer. Meth. Eng. 15).
Deformation deformation_of(const Model& model, std::size_t z) {
    const bool large = model.settings.large_strain;
    std::array<Vec3, 4> way, middle = places(model, z);
    for (int a = 0; a < 4; ++a) {
        way[a] = model.clock.time_step * model.gridpoints.velocity[model.zones.gridpoints[z][a]];
        if (large) middle[a] -= 0.5 * way[a];
    }
    const Corners mid(middle);
    Mat3 gradient = Mat3::Zero();
    for (int a = 0; a < 4; ++a) gradient += way[a] * mid.gradient[a].transpose();
    Deformation d{mid.volume, 0.5 * (gradient + gradient.transpose()), matrix_of(model.zones.stress[z])};
    if (!large) return d;
    const Mat3 spin = 0.5 * (gradient - gradient.transpose());
    const Mat3 turn = (Mat3::Identity() - 0.5 * spin).inverse() * (Mat3::Identity() + 0.5 * spin);
    d.stress = turn * d.stress * turn.transpose();
    return d;
}

/// Means of a quantity over neighbours, by volume: over the cell of a zone where its block has cells, else over the zones at
/// each gridpoint and back. Zones of other blocks and of other materials do not count.
template <class Put> void average(const Model& model, const Adjacency& adjacency, ZoneScratch& scratch, const ZoneLaws& laws,
                                 std::vector<double>& values, const Put& put) {
    const auto& blocks = model.blocks;
    const auto& volume = scratch.volume;
    scratch.at_gridpoint.resize(model.gridpoints.size());
    for_chunks(model.gridpoints.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t g = first; g < last; ++g) {
            const Row block = model.gridpoints.block[g];
            if (!blocks.deformable[block] || blocks.cell_zones[block] > 0 || !laws.of_block(block).averages) continue;
            double sum = 0, whole = 0;
            const Row row = static_cast<Row>(g);
            for (auto c = adjacency.corners.begin(row); c != adjacency.corners.end(row); ++c) {
                sum += volume[*c / 4] * values[*c / 4];
                whole += volume[*c / 4];
            }
            scratch.at_gridpoint[g] = whole > 0 ? sum / whole : 0;
        }
    });
    for_chunks(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Row block = static_cast<Row>(b);
            if (!blocks.deformable[b] || !laws.of_block(block).averages) continue;
            const Span span = blocks.zones[b];
            const Row cell = blocks.cell_zones[b];
            for (Row z = span.first; z < span.end() && cell > 0; z += cell) {
                double sum = 0, whole = 0;
                for (Row k = z; k < z + cell; ++k) {
                    sum += volume[k] * values[k];
                    whole += volume[k];
                }
                for (Row k = z; k < z + cell; ++k) put(k, sum / whole);
            }
            for (Row z = span.first; z < span.end() && cell == 0; ++z) {
                double sum = 0;
                for (const Row g : model.zones.gridpoints[z]) sum += scratch.at_gridpoint[g];
                put(z, 0.25 * sum);
            }
        }
    });
}

Diagnostic failed(const Model& model, const ZoneBatch& rows, const ZoneLaw& law, const ZoneFailure& failure) {
    const Row zone = rows.first + static_cast<Row>(failure.row), block = model.zones.block[zone];
    const Vec3 centre = zone_centroid(model, zone);
    Diagnostic d(failure.message, "look at the model's properties and at how fast the zones are loaded", Fault::run);
    d.code = "zone-model-failed";
    d.add(fmt::format("zone {} of block {}, at ({:.6g}, {:.6g}, {:.6g})", zone + 1, model.blocks.number[block], centre.x(), centre.y(),
                      centre.z()));
    const auto& place = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])].place;
    if (!place.empty()) d.add(fmt::format("zone model '{}' was given at {}", law.model->name, place));
    return d;
}

/// Runs the model of a batch. What is to be averaged goes to `scratch`.
ZoneSums run_batch(Model& model, const ZoneBatch& rows, const ZoneLaw& law, ZoneScratch& scratch, std::vector<Vec3>& corner_forces) {
    auto& zones = model.zones;
    const double damping = stiffness_damping(model.settings) / model.clock.time_step;
    Columns columns(model, rows, law);
    const WaterPressure water(model);
    const std::size_t n = columns.batch.n;
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t z = static_cast<std::size_t>(rows.first) + i;
        const Deformation d = deformation_of(model, z);
        if (!(d.volume > 0)) throw turned_over(model, static_cast<Row>(z));
        columns.volume[i] = d.volume;
        columns.pressure[i] = water.of_zone(static_cast<Row>(z));
        columns.volume_strain[i] = d.strain.trace();
        const double more = law.averages ? (scratch.mean_strain[z] - columns.volume_strain[i]) / 3 : 0;
        for (int k = 0; k < 6; ++k) {
            const bool normal = k < 3;
            columns.strain[k][i] = d.strain(row[k], column[k]) + (normal ? more : 0);
            columns.before[k][i] = d.stress(row[k], column[k]);
            columns.stress[k][i] = columns.before[k][i] + (normal ? columns.pressure[i] : 0);
        }
    }
    if (const auto failure = law.model->run(columns.batch)) throw failed(model, rows, law, *failure);
    const double bulk = law.elastic.lambda + law.elastic.two_shear / 3;
    ZoneSums sums;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t z = static_cast<std::size_t>(rows.first) + i;
        Stress stress, change;
        double work = 0, viscous_work = 0, mean = 0;
        for (int k = 0; k < 6; ++k) {
            const double times = k < 3 ? 1 : 2, strain = columns.strain[k][i];
            stress[k] = columns.stress[k][i] - (k < 3 ? columns.pressure[i] : 0);
            change[k] = stress[k] - columns.before[k][i];
            if (k < 3) mean += change[k] / 3;
            work += times * (columns.before[k][i] + stress[k]) * strain;
            if (damping > 0) viscous_work += times * (zones.dashpot[z][k] + damping * change[k]) * strain;
        }
        zones.stress[z] = stress;
        if (damping > 0) zones.dashpot[z] = damping * change;
        if (law.averages) {
            scratch.flow[z] = mean - bulk * scratch.mean_strain[z];
            const double sum = (stress[0] + stress[1] + stress[2] + columns.before[0][i] + columns.before[1][i] + columns.before[2][i]) / 3;
            work += sum * (columns.volume_strain[i] - scratch.mean_strain[z]); // the forces act on what the zone itself does
        } else {
            put_forces(model, z, corner_forces);
        }
        sums.work += 0.5 * columns.volume[i] * work;
        sums.damped += 0.5 * columns.volume[i] * viscous_work;
    }
    return sums;
}

/// Volume strains of the zones that average, and their means.
void average_strain(const Model& model, const ZoneLaws& laws, const Adjacency& adjacency, ZoneScratch& scratch) {
    const std::size_t zones = model.zones.size();
    for (auto* column : {&scratch.volume, &scratch.strain, &scratch.mean_strain, &scratch.flow}) column->resize(zones);
    for_chunks(laws.batches.size(), 1, [&](std::size_t first, std::size_t) {
        const ZoneBatch& rows = laws.batches[first];
        if (!laws.laws[rows.law].averages) return;
        for (Row z = rows.first; z < rows.last; ++z) {
            const Deformation d = deformation_of(model, static_cast<std::size_t>(z));
            scratch.volume[z] = d.volume;
            scratch.strain[z] = d.strain.trace();
        }
    });
    average(model, adjacency, scratch, laws, scratch.strain, [&](Row z, double mean) { scratch.mean_strain[z] = mean; });
}

/// The plastic change of the mean stress likewise; then the forces. Returns the work that goes with it.
ZoneSums average_flow(Model& model, const ZoneLaws& laws, const Adjacency& adjacency, ZoneScratch& scratch,
                  std::vector<Vec3>& corner_forces) {
    average(model, adjacency, scratch, laws, scratch.flow, [&](Row z, double mean) {
        scratch.flow[z] = mean - scratch.flow[z];
    });
    return reduce_chunks(
        laws.batches.size(), 1, ZoneSums{},
        [&](std::size_t first, std::size_t) {
            ZoneSums sums;
            const ZoneBatch& rows = laws.batches[first];
            for (Row z = rows.first; z < rows.last && laws.laws[rows.law].averages; ++z) {
                for (int k = 0; k < 3; ++k) model.zones.stress[z][k] += scratch.flow[z];
                sums.work += 0.5 * scratch.volume[z] * scratch.flow[z] * scratch.strain[z];
                put_forces(model, static_cast<std::size_t>(z), corner_forces);
            }
            return sums;
        },
        [](ZoneSums& sum, const ZoneSums& part) { sum.add(part); });
}

} // namespace

ZoneSums run_zone_models(Model& model, const ZoneLaws& laws, const Adjacency& adjacency, ZoneScratch& scratch,
                         std::vector<Vec3>& corner_forces) {
    const bool averages = laws.any_averages();
    if (averages) average_strain(model, laws, adjacency, scratch);
    ZoneSums sums = reduce_chunks(
        laws.batches.size(), 1, ZoneSums{},
        [&](std::size_t first, std::size_t) {
            const ZoneBatch& rows = laws.batches[first];
            return run_batch(model, rows, laws.laws[rows.law], scratch, corner_forces);
        },
        [](ZoneSums& sum, const ZoneSums& part) { sum.add(part); });
    if (averages) sums.add(average_flow(model, laws, adjacency, scratch, corner_forces));
    return sums;
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
