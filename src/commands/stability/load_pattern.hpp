// Loads that are scaled by one factor, as one force on one displacement: docs/push-over.md, equation (1).
#pragma once

#include "model/tables/model.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// The free bodies on which the loads act, with the forces of a factor of 1. The displacement that belongs to them is the one on which a
/// force as large as the sum of theirs does the same work.
class LoadPattern {
public:
    /// `gravity`: the force per mass along the direction in which gravity is scaled, 0 for none; `variable`: scales loads, none if empty. Masses
    /// must be known. Throws Diagnostic when nothing that is free is loaded.
    LoadPattern(const Model& model, const Vec3& gravity, const std::string& variable);

    /// Whether bodies have come or gone since.
    bool is_of(const Model& model) const;

    double force() const {
        return force_;
    } ///< sum of the amounts of all forces, or of the moments where there is no force
    bool turns() const { return turns_; } ///< there are moments only, and the displacement is a rotation
    double velocity(const Model& model) const;
    /// Change of the acceleration with the factor, where nothing else acts.
    double answer(const Model& model) const;

private:
    struct Part {
        Row block, gridpoint; ///< one of them is no_row
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        Mat3 arms = Mat3::Zero(); ///< arm in the block's own axes, times force
    };
    void add_gravity(const Model& model, const Vec3& gravity);
    void add_loads(const Model& model, const std::string& variable);
    Part& part_of(Row block, Row gridpoint);
    static Vec3 moment_now(const Model& model, const Part& part);

    std::vector<Part> parts_;
    std::map<std::pair<Row, Row>, std::size_t> places_; ///< of the part of a block and a gridpoint
    std::size_t blocks_ = 0, gridpoints_ = 0;
    double force_ = 0;
    bool turns_ = false;
};

} // namespace kaya
