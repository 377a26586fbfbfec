// Where loads act on rigid blocks. Blocks::load and Blocks::load_arms are their present sums, and BoundaryHistories has those that change
// with time; the places say which piece of a block that is cut keeps which load. docs/theory/loads.md.
#pragma once

#include "geometry/polyhedron.hpp"
#include "model/boundary_histories.hpp"

#include <array>
#include <initializer_list>
#include <map>
#include <span>
#include <vector>

namespace kaya {

struct Model;

/// A load is a point with a force, or a triangle under a linear traction with the forces at its corners.
class PlacedLoads : public Table<PlacedLoads> {
public:
    Column<BlockId> block;
    Column<Mat3> arms;   ///< columns: the corners, from the centroid in the block's axes; of a point all are the same
    Column<Mat3> forces; ///< columns: forces at the corners, global axes; of a point the first is all of it
    Column<std::int32_t> function; ///< row of Model::time_functions, or constant_in_time

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("arms", arms, Role::geometry);
        visit("forces", forces, Role::load);
        visit("function", function, ColumnRole<TimeFunction>{Role::condition, true});
    }
};

/// A row of them, in global axes.
struct PlacedLoad {
    std::array<Vec3, 3> place, force;
    std::int32_t function = constant_in_time;

    static PlacedLoad at(const Vec3& place, const Vec3& force) {
        return {{place, place, place}, {force, Vec3::Zero(), Vec3::Zero()}, constant_in_time};
    }
};

/// Adds loads to the table; those with one place and function share a row. Rows that are zero, and those of blocks that are gone or have
/// zones, are dropped.
class LoadPlaces {
public:
    explicit LoadPlaces(Model& model);
    void add(Row block, const PlacedLoad& load);

private:
    Model& model_;
    std::map<BlockId, std::vector<Row>> rows_;
};

/// Constant loads of a block along these axes have no place any more.
void forget_places(Model& model, Row block, std::initializer_list<int> axes);

/// Removes the loads of a block from the table.
std::vector<PlacedLoad> take_placed_loads(Model& model, Row block);

/// The parts of a load on convex pieces that together fill a block. Points on the border of several belong to each in equal parts.
std::vector<std::vector<PlacedLoad>> parts_on(const PlacedLoad& load, std::span<const Polyhedron> pieces);

} // namespace kaya
