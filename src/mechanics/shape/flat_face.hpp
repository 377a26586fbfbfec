// A face in the coordinates of the contact plane.
#pragma once

#include "geometry/overlay/overlay.hpp"
#include "mechanics/shape/surfaces.hpp"

#include <Eigen/Geometry>
#include <array>
#include <span>

namespace kaya {

struct PlaneAxes {
    Vec3 u, v;
};

inline PlaneAxes axes_of(const Vec3& normal) {
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 u = normal.cross(Vec3::Unit(least)).normalized();
    return {u, normal.cross(u)};
}

struct FlatFace {
    PlaneMesh mesh;   ///< its own triangles
    PlaneMesh radial; ///< the triangles used for contacts, if they differ
    PlaneMesh other;  ///< along the other diagonals, if it has them: take_other
    bool is_radial;
    std::span<const Row> rows; ///< the gridpoint of each point

    void project(const Model& model, const Surfaces& surfaces, Row face, const PlaneAxes& axes, const Vec3& origin) {
        rows = surfaces.corners(face);
        mesh.points.clear();
        for (const Row g : rows) {
            const Vec3 d = model.gridpoints.position[g] - origin;
            mesh.points.emplace_back(d.dot(axes.u), d.dot(axes.v));
        }
        const auto triangles = surfaces.triangles(face);
        mesh.triangles.assign(triangles.begin(), triangles.end());
        const FaceTriangles wanted = model.blocks.face_triangles[model.faces.block[face]];
        is_radial = wanted != FaceTriangles::fan;
        if (is_radial) radial = radial_mesh(mesh, wanted);
    }
    /// Whether it has triangles along the other diagonals, which are then in `other`.
    bool take_other(const Surfaces& surfaces, Row face) {
        const auto triangles = surfaces.other_triangles(face);
        if (is_radial || triangles.empty()) return false;
        other.points = mesh.points;
        other.triangles.assign(triangles.begin(), triangles.end());
        return true;
    }
    /// The triangles for contacts: along the own diagonals or the others.
    const PlaneMesh& on(bool others) const { return others ? other : is_radial ? radial : mesh; }

    /// The corner of a rigid block's face at a place, or -1.
    int corner_at(const Vec2& place, double tolerance) const {
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            if ((mesh.points[i] - place).squaredNorm() <= tolerance * tolerance) return static_cast<int>(i);
        return -1;
    }
    Attachment attach_corner_or_place(const Vec2& place, int corner) const {
        std::array<double, 3> weights{1, 0, 0};
        const int triangle = corner < 0 ? triangle_at(mesh, place, weights) : 0;
        return attach(place, corner, triangle, weights);
    }
    Attachment attach(const Vec2& place, int vertex, int triangle, std::array<double, 3> weights,
                      bool others = false) const {
        if (vertex >= 0 && vertex < static_cast<int>(rows.size()))
            return {{rows[vertex], rows[vertex], rows[vertex]}, {1, 0, 0}};
        if (is_radial) triangle = triangle_at(mesh, place, weights);
        Attachment a;
        for (int k = 0; k < 3; ++k) {
            a.gridpoints[k] = rows[(others ? other : mesh).triangles[triangle][k]];
            a.weights[k] = weights[k];
        }
        return a;
    }
};

} // namespace kaya
