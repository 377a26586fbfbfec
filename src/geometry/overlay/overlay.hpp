// The common refinement of two triangulations in a plane: places and areas of sub-contacts.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace kaya {

using Vec2 = Eigen::Vector2d;

/// One side: points and triangles in the coordinates of the common plane, in either orientation.
struct PlaneMesh {
    std::vector<Vec2> points;
    std::vector<std::array<int, 3>> triangles;
};

/// A vertex of the overlay. Its area is a third of the overlay's triangles around it, so that the areas sum to the overlap and sum(area *
/// f) is the integral of any f that is linear in each triangle of both sides: tractions are transferred consistently for any two meshes.
struct OverlayPoint {
    Vec2 place;
    double area = 0;
    Vec2 centre =
        Vec2::Zero(); ///< of that area, weighted with the linear function that is 1 here and 0 at all other points
    int vertex1 = -1; ///< the point of side 1 that lies here, or -1
    int vertex2 = -1;
    int triangle1 = 0; ///< triangles that contain the point, with its barycentric weights unless it is a vertex
    int triangle2 = 0;
    std::array<double, 3> weights1{}, weights2{};
};

struct Overlay {
    std::vector<OverlayPoint> points;
    Eigen::Matrix2d second_moment = Eigen::Matrix2d::Zero(); ///< of the overlap about the origin, exact
};

/// Points closer than `tolerance` are merged; thinner pieces are dropped. With `edge` above 0 the triangles of the overlay are divided into
/// smaller ones with edges of about that length. The contents of `result` are replaced, its memory is reused.
void overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge, Overlay& result);

/// How a face of a rigid block is cut in triangles for its contacts.
enum class FaceTriangles : std::uint8_t {
    fan,     ///< from its first corner
    radial,  ///< from its centre to its corners
    radial_8 ///< from its centre to its corners and the middles of its edges
};

/// The same face with other triangles. New points follow the old ones.
PlaneMesh radial_mesh(const PlaneMesh& mesh, FaceTriangles triangles);

/// The triangle of a mesh that holds a place, or the nearest one, with its barycentric weights (0 to 1).
int triangle_at(const PlaneMesh& mesh, const Vec2& place, std::array<double, 3>& weights);

/// Redistributes the areas so that the second moments of the points come as close to those of the overlap as the points allow. A square
/// whose corners own 1/3, 1/6, 1/3, 1/6 of it, as from its two triangles, resists tilting about one diagonal more than about the other;
/// with a quarter each it does not. With a point in the middle it resists as a continuous joint does. The sum of areas and their centre are
/// kept. For faces that do not bend: the areas are no longer those of the triangles.
void balance_areas(Overlay& overlay);

} // namespace kaya
