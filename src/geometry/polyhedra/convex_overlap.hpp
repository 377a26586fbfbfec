// The intersection of two convex polyhedra: one is clipped by the faces of the other.
#pragma once

#include "base/vector.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kaya {

/// Origin of a face of a clipped polyhedron.
enum class FaceOrigin : std::uint8_t {
    subject, ///< it was there before
    clipper, ///< a face of the other polyhedron
    inner    ///< a plane between parts of the intersection
};

/// The points below a plane: normal . x <= reach.
struct HalfSpace {
    Vec3 normal; ///< outward
    double reach;

    double depth(const Vec3& x) const { return reach - normal.dot(x); }
};

/// A convex polyhedron that is clipped face by face. It reuses its memory.
class ConvexClip {
public:
    void clear();
    /// Becomes a copy of another one, without its working memory.
    void copy(const ConvexClip& other);
    /// Vertices first, then the faces with their corners anticlockwise from outside.
    void add_vertex(const Vec3& place) { vertices_.push_back(place); }
    void begin_face() { faces_.push_back({static_cast<int>(corners_.size()), FaceOrigin::subject}); }
    void add_corner(int vertex) { corners_.push_back(vertex); }

    /// Keeps the part below a plane, whose normal may have any length.
    void clip(const HalfSpace& plane, FaceOrigin origin);

    bool empty() const { return faces_.empty(); }
    const std::vector<Vec3>& vertices() const { return vertices_; }

    std::size_t face_count() const { return faces_.size(); }
    FaceOrigin origin(std::size_t face) const { return faces_[face].origin; }
    int corner_count(std::size_t face) const { return end(face) - faces_[face].first; }
    const Vec3& corner(std::size_t face, int i) const {
        return vertices_[static_cast<std::size_t>(corners_[static_cast<std::size_t>(faces_[face].first + i)])];
    }
    /// Area times outward normal, from the corners.
    Vec3 area_vector(std::size_t face) const;

private:
    struct Face {
        int first; ///< in corners_
        FaceOrigin origin;
    };
    /// Where an edge that is cut meets the plane.
    struct Cut {
        int inside, outside; ///< vertices of the edge before the cut
        int vertex;          ///< after it
        int next;            ///< the cut that follows around the cap
    };

    int end(std::size_t face) const {
        return face + 1 < faces_.size() ? faces_[face + 1].first : static_cast<int>(corners_.size());
    }
    int cut_at(int inside, int outside);
    void clip_faces();
    void close(FaceOrigin origin);

    std::vector<Vec3> vertices_, old_vertices_;
    std::vector<int> corners_, old_corners_;
    std::vector<Face> faces_, old_faces_;
    std::vector<double> distance_; ///< of the old vertices above the plane
    std::vector<int> renamed_;     ///< of the old vertices below it
    std::vector<Cut> cuts_;
};

/// Integrals over the common part.
struct OverlapMoments {
    double volume = 0;
    Vec3 centroid = Vec3::Zero();
    Mat3 second = Mat3::Zero(); ///< integral of (x - centroid)(x - centroid)' over volume: length^2
};

/// Exact integrals by tetrahedra over the faces (Tonon 2005). No volume where the polyhedron is empty.
OverlapMoments moments_of(const ConvexClip& part);

/// An integral over the intersection of two bodies, and minus its gradient for translations and rotations (about the origin) of the second
/// body.
struct OverlapGradient {
    double value = 0;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();

    void add(const OverlapGradient& other, double weight);
};

/// The volume. `second` says whether the subject is the second body.
OverlapGradient volume_gradient(const ConvexClip& part, double volume, bool second);

/// Scratch memory only.
struct DepthScratch {
    ConvexClip piece;
    std::vector<double> least; ///< depth of the part below each face
};

/// The integral of the depth below the surface of one body, the distance to the nearest of its faces. `of_subject`: of the body that was
/// clipped; `second`: it is the second one. `faces` are those of the body whose depth counts.
OverlapGradient depth_gradient(const ConvexClip& part, const std::vector<HalfSpace>& faces, bool of_subject,
                               bool second, DepthScratch& scratch);

} // namespace kaya
