#include "mechanics/contact/plane_motion.hpp"

#include "mechanics/shape/flat_face.hpp"
#include "model/measure/overlap_rows.hpp"

#include <Eigen/QR>
#include <cmath>

namespace kaya {

PlaneMotion::PlaneMotion(const Model& model, Row c) {
    constexpr double misfit = 1e-6; // of the largest displacement
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    if (!between_rigid(model, c) || model.contacts.kind[c] != ContactKind::joint) return;
    if (span.count == 0 || !(model.contacts.area[c] > 0)) return;
    const PlaneAxes axes = axes_of(model.contacts.normal[c]);
    origin_ = model.contacts.position[c];
    size_ = std::sqrt(model.contacts.area[c]);
    u_ = axes.u;
    v_ = axes.v;
    Eigen::MatrixX3d places(span.count, 3);
    Eigen::MatrixX4d moved(span.count, 4), stressed(span.count, 4);
    bool all = true;
    for (Row k = 0; k < span.count; ++k) {
        const Row s = span.first + k;
        places.row(k) = coordinates(subs.position[s]);
        moved.row(k) << subs.normal_displacement[s], Vec3(subs.shear_displacement[s]).transpose();
        stressed.row(k) << subs.normal_force[s], Vec3(subs.shear_force[s]).transpose();
        stressed.row(k) /= subs.area[s];
        all = all && subs.area[s] > 0;
    }
    const auto fit = places.completeOrthogonalDecomposition();
    const auto off = [&](const Eigen::MatrixX4d& values, Eigen::Matrix<double, 4, 3>& field) -> Eigen::MatrixX4d {
        field = fit.solve(values).transpose();
        return (places * field.transpose() - values).cwiseAbs();
    };
    const Eigen::MatrixX4d off_motion = off(moved, motion_);
    along_normal_ = off_motion.col(0).maxCoeff() <= misfit * moved.col(0).cwiseAbs().maxCoeff();
    in_plane_ = off_motion.rightCols<3>().maxCoeff() <= misfit * moved.rightCols<3>().cwiseAbs().maxCoeff();
    carries_ = all && off(stressed, traction_).maxCoeff() <= misfit * stressed.cwiseAbs().maxCoeff();
}

} // namespace kaya
