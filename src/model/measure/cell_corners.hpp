// Cells of six zones, which follow each other in the tables.
#pragma once

#include "model/tables/blocks.hpp"

#include <array>

namespace kaya {

constexpr Row zones_of_cell = 6;

/// The corners of the cell whose six zones begin at `zones`, in the order of the walks of hexahedron_mesh: corner i + 2 j + 4 k is at the
/// ends i, j, k of its three axes.
template <class Point> std::array<Point, 8> corners_of_cell(const std::array<Point, 4>* zones) {
    return {zones[0][0], zones[0][1], zones[1][1], zones[0][2], zones[2][1], zones[2][2], zones[1][2], zones[0][3]};
}

} // namespace kaya
