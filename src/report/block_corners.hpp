// Corners of blocks as columns of the page, which counts them within their block.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace kaya {

/// The gridpoints on the surface of a block, in the order of their first triangles.
struct BlockCorners {
    BlockCorners(const Model& model, Row block);

    /// Adds a gridpoint unless it is there. Returns its number in this block.
    std::uint32_t add(Row gridpoint);

    std::vector<Row> rows;
    std::map<Row, std::uint32_t> number;
};

/// Three numbers for each corner: its place before it moved is place - displacement.
struct CornerPlaces {
    void add(const Vec3& place, const Vec3& displacement);
    void add(const Model& model, std::span<const Row> gridpoints, const Vec3& centre);

    /// Two members of an object.
    std::string json() const;

    std::vector<float> places, displacements;
};

/// A member of an object.
std::string column_json(const char* name, const std::vector<std::uint32_t>& numbers);

} // namespace kaya
