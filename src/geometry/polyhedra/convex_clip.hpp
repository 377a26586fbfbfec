// A convex polyhedron that is cut by planes.
#pragma once

#include "base/vector.hpp"

#include <cstddef>
#include <cstdint>
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

/// A convex polyhedron that is clipped face by face. It reuses its memory: vertices that are cut off and old corners stay until it is
/// cleared, so that a cut writes what is new only.
class ConvexClip {
public:
    void clear();
    /// Becomes a copy of another one, without its working memory.
    void copy(const ConvexClip& other);
    /// Vertices first, then the faces with their corners anticlockwise from outside.
    void add_vertex(const Vec3& place);
    void begin_face() { faces_.push_back({static_cast<int>(corner_count_), 0, 0, FaceOrigin::subject}); }
    void add_corner(int vertex);

    /// Keeps the part below a plane, whose normal may have any length.
    void clip(const HalfSpace& plane, FaceOrigin origin);

    bool empty() const { return faces_.empty(); }
    /// Calls `visit` with the place of each vertex.
    template <class Visit> void each_vertex(const Visit& visit) const {
        for (const int v : kept_) visit(vertices_[static_cast<std::size_t>(v)]);
    }
    std::size_t vertex_count() const { return kept_.size(); }

    std::size_t face_count() const { return faces_.size(); }
    FaceOrigin origin(std::size_t face) const { return faces_[face].origin; }
    int corner_count(std::size_t face) const { return faces_[face].count; }
    const Vec3& corner(std::size_t face, int i) const {
        return vertices_[static_cast<std::size_t>(corners_[static_cast<std::size_t>(faces_[face].first + i)])];
    }
    /// Area times outward normal, from the corners.
    Vec3 area_vector(std::size_t face) const;

private:
    struct Face {
        int first, count;       ///< in corners_
        std::uint64_t vertices; ///< a bit for each, see bit_of
        FaceOrigin origin;
    };
    /// Where an edge that is cut meets the plane.
    struct Cut {
        int inside, outside; ///< vertices of the edge
        int vertex;          ///< the new one
        int next;            ///< the cut that follows around the cap
    };

    /// Vertices may share a bit: a bit that is missing is certain.
    static std::uint64_t bit_of(int vertex) { return std::uint64_t{1} << (static_cast<unsigned>(vertex) % 64); }
    bool is_above(int vertex) const { return height_[static_cast<std::size_t>(vertex)] > 0; }
    /// The end of the list of corners, with room for more of them.
    int* room_for(std::size_t more) {
        if (corners_.size() < corner_count_ + more) corners_.resize(2 * (corner_count_ + more));
        return corners_.data() + corner_count_;
    }
    int cut_at(int inside, int outside);
    Face cut_face(const Face& face);
    void close(FaceOrigin origin);
    void drop_above();

    std::vector<Vec3> vertices_;
    std::vector<int> kept_;    ///< vertices that are not cut off
    std::vector<int> corners_; ///< and room for more
    std::size_t corner_count_ = 0;
    std::vector<Face> faces_;
    std::vector<double> height_; ///< of the vertices above the last plane
    std::vector<Cut> cuts_;
};

} // namespace kaya
