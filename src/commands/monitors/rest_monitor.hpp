// Finds bodies that keep moving while the rest of a model is at rest.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// A block that moves.
struct MovingBody {
    Row block = no_row;
    double speed = 0;  ///< now, length/time
    double gained = 0; ///< displacement, length
    double rate = 0;   ///< mean velocity during this displacement, length/time
};

/// The fastest block that is not held; none when all are at rest. For a deformable one the mean of its gridpoints.
std::optional<MovingBody> fastest_body(const Model& model);

/// Sizes of the forces on each block: of its contacts, its loads and its weight.
std::vector<double> acting_forces(const Model& model);

/// "block 5 at (1, 2, 3)"
std::string body_text(const Model& model, const MovingBody& body);

/// Samples the displacements of blocks at a few cycles of a run, at increasing intervals.
class RestMonitor {
public:
    explicit RestMonitor(const Model& model);

    /// To be called after each cycle.
    void sample();

    std::int64_t cycles() const { return cycles_; }

    /// The block with the largest recent displacement among those that are not held and do not slow down: docs/theory/stopping.md. None
    /// when all come to rest, and when the run was too short to tell.
    std::optional<MovingBody> moving() const;

private:
    struct Mark {
        double time;
        std::vector<BlockId> blocks;
        std::vector<Vec3> centroid, vertex; ///< displacements
    };
    Mark mark() const;

    const Model& model_;
    std::vector<Mark> marks_;
    std::int64_t cycles_ = 0, stride_ = 1;
};

} // namespace kaya
