// Boundaries that absorb waves: docs/theory/loads.md.
#pragma once

#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

struct ElasticConstants;

/// Dashpots of the gridpoints on quiet boundaries; derived.
struct QuietPoints {
    std::vector<Row> index;    ///< by gridpoint: row below, or no_row; empty when nothing is quiet
    std::vector<Mat3> dashpot; ///< force against velocity, force*time/length

    bool at(std::size_t gridpoint) const { return !index.empty() && index[gridpoint] != no_row; }
};

/// Tractions -rho Cp v_n and -rho Cs v_s (Lysmer and Kuhlemeyer 1969, J. Eng. Mech. Div. ASCE 95) on quiet triangles, a third at each
/// corner; on both triangles of an outer face of a cell the mean of its diagonals. Areas and normals are those of the block when its zones
/// were created. `elastic` has the constants of the blocks.
QuietPoints quiet_points(const Model& model, const std::vector<ElasticConstants>& elastic);

/// Force of a dashpot on a gridpoint in a step, at the mean of the velocities before and after it, and so stable for any step. `force` is
/// the sum of all other forces; held components (Fixity bits) keep their velocity.
Vec3 quiet_force(const Mat3& dashpot, double mass, const Vec3& velocity, const Vec3& force, std::uint8_t fixed,
                 double step);

} // namespace kaya
