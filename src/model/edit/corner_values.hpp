// Values at the corners of a rigid block, passed on to the corners of its pieces or its zones.
#pragma once

#include "model/tables/model.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace kaya {

/// Displacement and pore pressure of a block as functions that are linear in the place: a body that moves as one has such a displacement. Through
/// the corners, where these are linear; else nearest to them, with the values of the corners that stay.
class CornerValues {
public:
    CornerValues(const Model& model, Row block) {
        const Span span = model.blocks.gridpoints[block];
        base_ << model.blocks.displacement[block], 0;
        origin_ = model.blocks.centroid[block];
        Eigen::MatrixXd places(span.count, 4), values(span.count, 4);
        for (Row i = 0; i < span.count; ++i) {
            const Row g = span.first + i;
            places.row(i) << (model.gridpoints.position[g] - origin_).transpose(), 1;
            values.row(i) << model.gridpoints.displacement[g].transpose(), model.gridpoints.pore_pressure[g];
            values.row(i) -= base_.transpose();
            corners_.push_back({model.gridpoints.position[g], model.gridpoints.pore_pressure[g]});
        }
        if (!values.isZero(0)) linear_ = places.colPivHouseholderQr().solve(values);
    }

    Vec3 displacement(const Vec3& place) const { return at(place).head<3>(); }
    double pore_pressure(const Vec3& place, double near) const {
        const auto same = std::ranges::find_if(
            corners_, [&](const Corner& corner) { return (corner.place - place).squaredNorm() <= near * near; });
        return same != corners_.end() ? same->pore_pressure : at(place)[3];
    }

private:
    Eigen::Vector4d at(const Vec3& place) const {
        Eigen::Vector4d from;
        from << place - origin_, 1;
        return base_ + linear_.transpose() * from;
    }

    struct Corner {
        Vec3 place;
        double pore_pressure;
    };
    Eigen::Vector4d base_; ///< differences from it are 0, exactly, in a block that has not turned
    Eigen::Matrix4d linear_ = Eigen::Matrix4d::Zero();
    Vec3 origin_;
    std::vector<Corner> corners_;
};

} // namespace kaya
