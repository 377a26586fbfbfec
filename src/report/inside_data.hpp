// The inside of blocks for the page, which fills cuts and finds surfaces of equal value there.
#pragma once

#include "model/tables/model.hpp"

#include <string>

namespace kaya {

/// A JSON object: for each shown block the number of its gridpoints inside and of its zones; then the places of these gridpoints, the
/// corners of the zones (counted within the block, those on its surface first, as in scene_json) and the fields of the gridpoints. Null
/// when there are more zones than a page can hold.
std::string inside_json(const Model& model, const Vec3& centre);

} // namespace kaya
