// How a model fails: by sliding, by toppling, or by yield of its zones.
#pragma once

#include "model/tables/model.hpp"

#include <string>
#include <vector>

namespace kaya {

class Cycle;

/// Compares a model before and after its motion. docs/theory/slopes.md, "How it fails".
class FailureMode {
public:
    FailureMode(const Model& model, const Cycle& cycle);

    struct Shares {
        double turning = 0; ///< of the motion across joints: by blocks that turn, not by blocks that shift
        double zones = 0;   ///< of the work that was lost: in zones, not in joints
        bool joints_move = false;
        bool backward = false; ///< blocks rotate against their shift: the feet of columns move first
        double zones_high = 0; ///< how many zones lie over each other in the zones that moved far
        bool in_cells = false; ///< these are cells
        bool topples() const;
    };
    /// Since it was made. Blocks must be the same.
    Shares shares(const Model& model, const Cycle& cycle) const;

private:
    /// A block's motion as that of a rigid body, by least squares over its gridpoints.
    struct Motion {
        Vec3 centre = Vec3::Zero(), shift = Vec3::Zero(), turn = Vec3::Zero();
    };
    Vec3 shift(const Model& model, std::size_t gridpoint) const; ///< since the start
    Motion motion(const Model& model, Row block) const;
    double typical_shift(const Model& model) const;
    void count_zones(const Model& model, Shares& shares) const;
    static bool turns_backward(const Model& model, const std::vector<Motion>& motions);

    struct Joint {
        Row block1, block2;
        Vec3 position;
        double area;
    };
    std::vector<Joint> joints_;
    std::vector<Vec3> positions_, displacements_; ///< of gridpoints
    double joint_loss_, zone_loss_;
};

/// Over the height of what moved; fewer say nothing about a slope: their error is not in proportion to their size.
constexpr double fewest_zones = 2;

/// The mode's name and both shares.
std::string mode_text(const FailureMode::Shares& shares);

/// Whether a model has a factor of safety on fine zones, and `solve fos` searches it: docs/theory/slopes.md, "Shared strains".
enum class FineZones { unknown, on_request, searched };

/// How coarse the mesh is where zones yield, and what to do about it unless the factor on fine zones follows; "" where they do not.
std::string mesh_text(const FailureMode::Shares& shares, FineZones fine);

/// The block that has moved most since `start`, and the number of blocks that moved far; "" without motion.
std::string farthest_text(const Model& start, const Model& model, double factor);

} // namespace kaya
