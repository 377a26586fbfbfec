// Loads with places on rigid blocks: adding them, and dividing them among pieces of a cut block. docs/theory/loads.md.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"
#include "model/tables/placed_load_table.hpp"

#include <array>
#include <initializer_list>
#include <map>
#include <span>
#include <vector>

namespace kaya {

struct Model;

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

/// A traction as loads on the equal parts, n² of them, of its triangle, with the same force and moment; a point load itself.
std::vector<PlacedLoad> divided(const PlacedLoad& load, int n);

/// The parts of a load on convex pieces that together fill a block. Points on the border of several belong to each in equal parts.
std::vector<std::vector<PlacedLoad>> parts_on(const PlacedLoad& load, std::span<const Polyhedron> pieces);

} // namespace kaya
