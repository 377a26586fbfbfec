#include "mechanics/supports/loads_to_zones.hpp"

#include "mechanics/supports/boundary.hpp"
#include "model/edit/placed_loads.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace kaya {

namespace {

/// A traction is put on the gridpoints from this many parts of each side of its triangle.
constexpr int parts = 8;

/// Forces at gridpoints, by function of time.
class GridpointForces {
public:
    GridpointForces(const Model& model, Row block) : model_(model), block_(block) {}

    void add(const Vec3& force, const Vec3& place, std::int32_t function) {
        Row best = no_row;
        Vec3 weights;
        double least = std::numeric_limits<double>::infinity();
        const Span span = model_.blocks.triangles[block_];
        for (Row t = span.first; t < span.end(); ++t) {
            const Vec3 found = weights_in_triangle({at(t, 0), at(t, 1), at(t, 2)}, place);
            // How far it is outside of the triangle, and above it.
            const double outside = std::max(0.0, -found.minCoeff());
            const Vec3 area = triangle_area_vector(model_, t), corner = at(t, 0);
            const double above = std::abs(area.normalized().dot(place - corner)) / std::sqrt(area.norm());
            if (outside + above < least) least = outside + above, best = t, weights = found;
        }
        if (best == no_row) return;
        for (std::size_t k = 0; k < 3; ++k)
            forces_[{function, model_.triangles.gridpoints[best][k]}] += weights[static_cast<int>(k)] * force;
    }

    void give(Model& model) const {
        for (const auto& [at, force] : forces_)
            for (int axis = 0; axis < 3; ++axis)
                if (force[axis] != 0) add_load(model, {at.second}, axis, force[axis], at.first);
    }

private:
    struct Zero : Vec3 {
        Zero() : Vec3(Vec3::Zero()) {}
    };
    Vec3 at(Row triangle, std::size_t corner) const {
        return model_.gridpoints.position[model_.triangles.gridpoints[triangle][corner]];
    }

    const Model& model_;
    Row block_;
    std::map<std::pair<std::int32_t, Row>, Zero> forces_;
};

/// Whether a row is a load on a block as a whole.
bool is_of_rigid_block(const BoundaryHistories& histories, std::size_t row) {
    return histories.what[row] == BoundaryHistories::What::load && histories.gridpoint[row] == no_row;
}

/// Forces without places, and moments, constant or in time.
bool has_more(const Model& model, Row block, const std::vector<PlacedLoad>& placed) {
    constexpr double rounding = 1e-9;
    std::map<std::int32_t, std::pair<Vec3, double>> by_function; // what is left, and the size of all
    const auto add = [&](std::int32_t function, const Vec3& force) {
        auto& [left, size] = by_function.try_emplace(function, Vec3::Zero(), 0).first->second;
        left += force;
        size += force.norm();
    };
    add(constant_in_time, model.blocks.load[block]);
    for (const PlacedLoad& load : placed) add(load.function, -(load.force[0] + load.force[1] + load.force[2]));
    const auto& histories = model.boundary_histories;
    bool moment = !model.blocks.torque[block].isZero(0);
    for (std::size_t i = 0; i < histories.size(); ++i) {
        if (!is_of_rigid_block(histories, i) || histories.block[i] != model.blocks.id[block]) continue;
        const std::int32_t component = histories.component[i];
        if (component < 3) add(histories.function[i], histories.amplitude[i] * Vec3::Unit(component));
        moment = moment || (component >= 3 && component < BoundaryHistories::motions);
    }
    return moment || std::ranges::any_of(by_function, [](const auto& of) {
               return of.second.first.norm() > rounding * of.second.second;
           });
}

/// The blocks that have loads as rigid ones.
std::set<BlockId> loaded_blocks(const Model& model, const std::vector<Row>& blocks) {
    std::set<BlockId> loaded(model.placed_loads.block.begin(), model.placed_loads.block.end());
    const auto& histories = model.boundary_histories;
    for (std::size_t i = 0; i < histories.size(); ++i)
        if (is_of_rigid_block(histories, i)) loaded.insert(histories.block[i]);
    for (const Row block : blocks)
        if (!model.blocks.load[block].isZero(0) || !model.blocks.torque[block].isZero(0))
            loaded.insert(model.blocks.id[block]);
    return loaded;
}

} // namespace

std::vector<std::int32_t> put_loads_on_zones(Model& model, const std::vector<Row>& blocks) {
    std::vector<std::int32_t> lost;
    const auto loaded = loaded_blocks(model, blocks);
    for (const Row block : blocks) {
        if (!model.blocks.deformable[block] || !loaded.contains(model.blocks.id[block])) continue;
        const std::vector<PlacedLoad> loads = take_placed_loads(model, block);
        if (has_more(model, block, loads)) lost.push_back(model.blocks.number[block]);
        model.blocks.load[block].setZero();
        model.blocks.torque[block].setZero();
        model.blocks.load_arms[block].setZero();
        GridpointForces forces(model, block);
        for (const PlacedLoad& load : loads)
            for (const PlacedLoad& part : divided(load, parts))
                for (std::size_t k = 0; k < 3; ++k)
                    if (!part.force[k].isZero(0)) forces.add(part.force[k], part.place[k], part.function);
        forces.give(model);
    }
    if (!loaded.empty()) tidy_boundary_histories(model); // those of the blocks as rigid ones
    return lost;
}

} // namespace kaya
