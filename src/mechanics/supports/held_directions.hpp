// Directions in which bodies are held: rollers of gridpoints and of rigid blocks.
#pragma once

#include "mechanics/supports/boundary.hpp"

#include <array>
#include <map>
#include <span>

namespace kaya {

/// Adds a direction to a roller when it is new, orthogonal to the existing ones.
void add_direction(Roller& roller, Vec3 direction, double speed);
/// The same with all directions of another roller.
void add_directions(Roller& roller, const Roller& other);

/// Rollers by value, so that equal ones are shared.
class RollerRows {
public:
    explicit RollerRows(Model& model);
    std::int32_t row(const Roller& roller);

private:
    using Key = std::array<double, 12>;
    static Key key(const Roller& roller);
    std::vector<Roller>& rollers_;
    std::map<Key, std::int32_t> rows_;
};

/// Holds the velocity along a direction (of any length) at `speed`: of the centroid of a rigid block, of each gridpoint of other blocks.
/// Replaces a hold along the same direction; others stay.
void hold_direction(Model& model, const Bodies& bodies, const Vec3& direction, double speed);

/// Frees all directions.
void free_directions(Model& model, const Bodies& bodies);

/// The roller of a rigid block: all its vertices share it.
inline const Roller& roller_of(const Model& model, Row block) {
    if (model.rollers.size() == 1) return model.rollers.front(); // nothing is held
    return model.rollers[static_cast<std::size_t>(model.gridpoints.roller[model.blocks.gridpoints[block].first])];
}
/// The roller of joined blocks: the directions of all of them.
Roller roller_of_body(const Model& model, std::span<const Row> members);

} // namespace kaya
