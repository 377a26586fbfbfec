#include "model/edit/stop_motion.hpp"

#include "model/edit/links.hpp"

#include <algorithm>

namespace kaya {

void stop_motion(Model& model) {
    auto& points = model.gridpoints;
    for (std::size_t row = 0; row < points.size(); ++row)
        for (int axis = 0; axis < 3; ++axis)
            if ((points.fixed[row] & (fix_x << axis)) == 0) points.velocity[row][axis] = 0;
    auto& blocks = model.blocks;
    for (std::size_t row = 0; row < blocks.size(); ++row)
        for (int axis = 0; axis < 3; ++axis) {
            if ((blocks.fixed[row] & (fix_x << axis)) == 0) blocks.velocity[row][axis] = 0;
            if ((blocks.fixed[row] & (fix_rx << axis)) == 0) blocks.rotational_velocity[row][axis] = 0;
        }
    std::ranges::fill(blocks.angular_momentum, Vec3::Zero());
    links::clear(model.structures.member_nodes, {Role::motion});
}

} // namespace kaya
