#include "geometry/surface/few_parts.hpp"

#include "base/stop_point.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/convex_hull.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>

namespace kaya {
namespace {

/// Of the size of the body: what is nearer to a plane lies in it.
constexpr double rounding = 1e-9;

/// A part of the body, as convex parts and with its hull.
struct Piece {
    std::vector<std::shared_ptr<const Polyhedron>> parts;
    Surface hull;
    double volume = 0; ///< of the parts
    double volume_of_hull = 0;
    double excess() const { return volume_of_hull - volume; }
};

void add_hull(Piece& piece) {
    std::vector<Vec3> points;
    for (const auto& part : piece.parts) points.insert(points.end(), part->vertices.begin(), part->vertices.end());
    std::ranges::sort(points, comes_first);
    points.erase(std::unique(points.begin(), points.end()), points.end()); // parts share most of their corners
    piece.hull = convex_hull(points);
    piece.volume_of_hull = volume_of(triangles_of(piece.hull));
}

void add_volume(Piece& piece) {
    for (const auto& part : piece.parts) piece.volume += mass_properties(*part).volume;
}

/// The parts of the piece on both sides of a plane, and their hulls; nothing where all is on one side.
std::vector<Piece> divide(const Piece& piece, const Plane& plane, double near) {
    std::vector<Piece> halves(2);
    for (const auto& part : piece.parts) {
        double low = 0, high = 0;
        for (const Vec3& v : part->vertices) {
            low = std::min(low, plane.distance(v));
            high = std::max(high, plane.distance(v));
        }
        if (low < -near && high > near) {
            Cut parts = cut_with_band(*part, plane, near);
            if (parts.outcome == CutOutcome::cut) {
                halves[0].parts.push_back(std::make_shared<Polyhedron>(std::move(parts.below)));
                halves[1].parts.push_back(std::make_shared<Polyhedron>(std::move(parts.above)));
                continue;
            }
        }
        halves[high > -low ? 1 : 0].parts.push_back(part);
    }
    if (halves[0].parts.empty() || halves[1].parts.empty()) return {};
    for (Piece& half : halves) add_hull(half);
    return halves;
}

/// Planes across the principal axes of the piece.
void add_cross_sections(const Piece& piece, std::vector<Plane>& planes) {
    constexpr int sections = 5; // along each axis
    std::vector<MassProperties> masses;
    Vec3 sum = Vec3::Zero();
    for (const auto& part : piece.parts) {
        masses.push_back(mass_properties(*part));
        sum += masses.back().volume * masses.back().centroid;
    }
    const Vec3 centre = sum / piece.volume;
    Mat3 inertia = Mat3::Zero();
    for (const MassProperties& mass : masses) {
        const Vec3 arm = mass.centroid - centre;
        inertia += mass.inertia + mass.volume * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
    for (int k = 0; k < 3; ++k) {
        const Vec3 axis = axes.eigenvectors().col(k);
        double low = 0, high = 0;
        for (const Vec3& v : piece.hull.vertices) {
            low = std::min(low, axis.dot(v - centre));
            high = std::max(high, axis.dot(v - centre));
        }
        for (int i = 1; i <= sections; ++i)
            planes.push_back({axis, centre + (low + (high - low) * i / (sections + 1)) * axis});
    }
}

/// The planes of the largest faces of the parts that are not on the hull: of dents, and of cuts from them.
void add_dents(const Piece& piece, double near, std::vector<Plane>& planes) {
    constexpr std::size_t most = 12;
    struct Face {
        double area;
        Plane plane;
    };
    std::vector<Face> faces;
    for (const auto& part : piece.parts)
        for (const auto& face : part->faces) {
            const Plane plane{face_normal(*part, face), part->vertices[face.vertices[0]]};
            Vec3 twice = Vec3::Zero();
            for (std::size_t i = 2; i < face.vertices.size(); ++i)
                twice += (part->vertices[face.vertices[i - 1]] - plane.origin)
                             .cross(part->vertices[face.vertices[i]] - plane.origin);
            const auto beyond = [&](const Vec3& v) { return plane.distance(v) > 10 * near; };
            if (std::ranges::any_of(piece.hull.vertices, beyond)) faces.push_back({twice.norm(), plane});
        }
    std::ranges::stable_sort(faces, std::ranges::greater{}, &Face::area);
    std::vector<Plane> kept;
    for (const Face& face : faces) {
        if (kept.size() == most) break;
        const auto same = [&](const Plane& other) {
            return other.normal.cross(face.plane.normal).norm() < 1e-6 &&
                   std::abs(other.distance(face.plane.origin)) <= 10 * near;
        };
        if (std::ranges::none_of(kept, same)) kept.push_back(face.plane);
    }
    planes.insert(planes.end(), kept.begin(), kept.end());
}

/// The halves with the least volume of their hulls; nothing where no plane saves any.
std::vector<Piece> best_halves(const Piece& piece, double near) {
    constexpr double clearly = 1e-9;
    std::vector<Plane> planes;
    add_dents(piece, near, planes);
    add_cross_sections(piece, planes);
    std::vector<Piece> best;
    double least = piece.volume_of_hull * (1 - clearly);
    for (const Plane& plane : planes) {
        stop_point();
        std::vector<Piece> halves = divide(piece, plane, near);
        if (halves.empty()) continue;
        const double volume = halves[0].volume_of_hull + halves[1].volume_of_hull;
        if (volume >= least) continue;
        least = volume - clearly * piece.volume_of_hull; // the first of equals
        best = std::move(halves);
    }
    for (Piece& half : best) add_volume(half);
    return best;
}

/// The body within the planes of the faces, the largest first: triangles in one plane become one face.
Polyhedron body_within(const Surface& hull, double near) {
    const auto [low, high] = box_around(hull.vertices);
    const Vec3 margin = Vec3::Constant(0.1 * (high - low).norm());
    Polyhedron body = make_brick(low - margin, high + margin);
    struct Side {
        double area;
        Plane plane;
    };
    std::vector<Side> sides;
    for (const auto& [a, b, c] : triangles_of(hull)) {
        const Vec3 area = (b - a).cross(c - a);
        if (area.norm() > near * (high - low).norm()) sides.push_back({area.norm(), {area.normalized(), a}});
    }
    std::ranges::stable_sort(sides, std::ranges::greater{}, &Side::area);
    for (const Side& side : sides) {
        Cut parts = cut_with_band(body, side.plane, near);
        if (parts.outcome == CutOutcome::cut) body = std::move(parts.below);
    }
    return body;
}

} // namespace

std::vector<Polyhedron> few_convex_parts(const std::vector<Polyhedron>& parts, std::size_t most) {
    if (parts.size() <= most) return parts;
    std::vector<Piece> pieces(1);
    for (const Polyhedron& part : parts) pieces.front().parts.push_back(std::make_shared<Polyhedron>(part));
    add_hull(pieces.front());
    add_volume(pieces.front());
    const double near = rounding * size_of(pieces.front().hull.vertices), whole = pieces.front().volume;
    std::vector<Piece> finished;
    while (!pieces.empty() && pieces.size() + finished.size() < most) {
        const auto widest = std::ranges::max_element(pieces, {}, &Piece::excess);
        std::vector<Piece> halves;
        if (widest->excess() > 1e-6 * whole) halves = best_halves(*widest, near);
        if (halves.empty()) finished.push_back(std::move(*widest));
        pieces.erase(widest);
        std::ranges::move(halves, std::back_inserter(pieces));
    }
    std::ranges::move(pieces, std::back_inserter(finished));
    std::vector<Polyhedron> result;
    for (const Piece& piece : finished) result.push_back(body_within(piece.hull, near));
    return result;
}

} // namespace kaya
