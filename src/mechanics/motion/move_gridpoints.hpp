// Gridpoints of deformable blocks, chunk by chunk: move_bodies.hpp says what that reads and writes.
#pragma once

#include "mechanics/motion/motion.hpp"
#include "mechanics/motion/move_bodies.hpp"

namespace kaya {

class GridpointMotion {
public:
    static constexpr std::size_t grain =
        1024; ///< gridpoints in a chunk, whose sums are added up in the order of the chunks

    GridpointMotion(Model& model, const QuietPoints& quiet, const TieLists& ties);

    /// A chunk, but for gridpoints that are tied to each other.
    MotionSums move(std::size_t first, std::size_t last);
    /// The part that must wait for all chunks; `chunks` are their sums. Returns the sums of all gridpoints.
    MotionSums finish(MotionSums chunks);

private:
    void move_point(Row row, MotionLanes& sums);

    Model& model_;
    const QuietPoints& quiet_;
    const TieLists& ties_;
    const DampingFactors damping_;
    const Lanes gravity_;
    const bool travels_; ///< the contact search needs the distance
};

} // namespace kaya
