// Vertices of many blocks, one number for each place. Private to geometry.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace kaya {

/// Numbers increase with x, then y, then z of the places. Points within the tolerance of a place are that place.
class SharedPlaces {
public:
    explicit SharedPlaces(const std::vector<Polyhedron>& blocks);

    /// Numbers of a block's vertices; distinct even for a block whose own vertices are closer than the tolerance.
    const std::vector<std::vector<int>>& numbers() const { return numbers_; }
    const Vec3& place(int number) const { return places_[number]; }
    double tolerance() const { return tolerance_; }
    /// -1 when there is none.
    int find(const Vec3& x) const;

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const;
    };
    Cell cell_of(const Vec3& x) const;
    int add(const Vec3& x);

    std::vector<Vec3> places_;
    std::vector<std::vector<int>> numbers_;
    std::unordered_multimap<Cell, int, Hash> cells_;
    double tolerance_ = 0;
};

} // namespace kaya
