// Water pressure in joints and zones: docs/theory/loads.md, "Water".
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Water pressure according to the settings; compression positive, never below 0.
class WaterPressure {
public:
    explicit WaterPressure(const Model& model);

    /// Below a table, or of a field; not where gridpoints have it.
    double at(const Vec3& place) const;
    /// The same without the limit at 0: linear in position, except below a ground surface.
    double unlimited_at(const Vec3& place) const;
    /// Whether it is linear in position where it is above 0: not below a ground surface.
    bool is_linear() const;
    double at_gridpoint(Row gridpoint) const;
    /// Mean of the zone's gridpoints.
    double of_zone(Row zone) const;

private:
    const Model& model_;
    double at_origin_ = 0; ///< linear in position, before the limit at 0
    Vec3 gradient_ = Vec3::Zero();
    double weight_ = 0; ///< of the water below a ground surface
};

} // namespace kaya
