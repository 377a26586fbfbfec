#include "geometry/polyhedra/convex_clip.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {

void ConvexClip::clear() {
    vertices_.clear();
    kept_.clear();
    corner_count_ = 0;
    faces_.clear();
}

void ConvexClip::copy(const ConvexClip& other) {
    vertices_ = other.vertices_;
    kept_ = other.kept_;
    corner_count_ = 0;
    std::copy_n(other.corners_.data(), other.corner_count_, room_for(other.corner_count_));
    corner_count_ = other.corner_count_;
    faces_ = other.faces_;
}

void ConvexClip::add_vertex(const Vec3& place) {
    kept_.push_back(static_cast<int>(vertices_.size()));
    vertices_.push_back(place);
}

void ConvexClip::add_corner(int vertex) {
    *room_for(1) = vertex;
    ++corner_count_;
    ++faces_.back().count;
    faces_.back().vertices |= bit_of(vertex);
}

/// The cut of an edge that leaves the plane's lower side; both faces at the edge find the same one.
int ConvexClip::cut_at(int inside, int outside) {
    for (std::size_t i = 0; i < cuts_.size(); ++i)
        if (cuts_[i].inside == inside && cuts_[i].outside == outside) return static_cast<int>(i);
    const auto in = static_cast<std::size_t>(inside), out = static_cast<std::size_t>(outside);
    const double part = height_[in] / (height_[in] - height_[out]);
    cuts_.push_back({inside, outside, static_cast<int>(vertices_.size()), -1});
    vertices_.push_back(vertices_[in] + part * (vertices_[out] - vertices_[in]));
    return static_cast<int>(cuts_.size()) - 1;
}

void ConvexClip::clip(const HalfSpace& plane, FaceOrigin origin) {
    height_.resize(vertices_.size());
    std::uint64_t above = 0, below = 0;
    for (const int v : kept_) {
        const double height = -plane.depth(vertices_[static_cast<std::size_t>(v)]);
        height_[static_cast<std::size_t>(v)] = height;
        (height > 0 ? above : below) |= bit_of(v);
    }
    if (above == 0) return;
    if (below == 0) return clear();
    cuts_.clear();
    const std::size_t count = faces_.size();
    std::size_t kept = 0;
    for (std::size_t f = 0; f < count; ++f) {
        const Face face = faces_[f];
        if ((face.vertices & above) == 0) faces_[kept++] = face;
        else if ((face.vertices & below) != 0)
            if (const Face rest = cut_face(face); rest.count > 0) faces_[kept++] = rest;
    }
    faces_.resize(kept);
    drop_above();
    close(origin);
}

/// The part of a face below the plane, without corners where nothing is left.
ConvexClip::Face ConvexClip::cut_face(const Face& face) {
    Face rest{static_cast<int>(corner_count_), 0, 0, face.origin};
    int* const first = room_for(2 * static_cast<std::size_t>(face.count)); // each corner and each cut
    int* to = first;
    int left = -1, entered_first = -1; // cuts where the loop crosses the plane upward and back
    const auto add = [&](int vertex) {
        *to++ = vertex;
        rest.vertices |= bit_of(vertex);
    };
    const int* const corners = corners_.data() + face.first;
    int a = corners[0];
    bool a_above = is_above(a);
    for (int i = 0; i < face.count; ++i) {
        const int b = corners[i + 1 < face.count ? i + 1 : 0];
        const bool b_above = is_above(b);
        if (!a_above) add(a);
        if (a_above != b_above) {
            const int cut = a_above ? cut_at(b, a) : cut_at(a, b);
            add(cuts_[static_cast<std::size_t>(cut)].vertex);
            if (!a_above) {
                left = cut;
            } else if (left >= 0) {
                // The cap uses this edge in the opposite direction.
                cuts_[static_cast<std::size_t>(cut)].next = left;
                left = -1;
            } else {
                entered_first = cut;
            }
        }
        a = b;
        a_above = b_above;
    }
    if (left >= 0 && entered_first >= 0) cuts_[static_cast<std::size_t>(entered_first)].next = left;
    if (to - first < 3) return rest;
    rest.count = static_cast<int>(to - first);
    corner_count_ += static_cast<std::size_t>(rest.count);
    return rest;
}

void ConvexClip::drop_above() {
    std::size_t kept = 0;
    for (const int v : kept_)
        if (!is_above(v)) kept_[kept++] = v;
    kept_.resize(kept);
    for (const Cut& cut : cuts_) kept_.push_back(cut.vertex);
}

/// The new face on the plane: the cuts, each with the one that follows it.
void ConvexClip::close(FaceOrigin origin) {
    for (std::size_t start = 0; start < cuts_.size(); ++start) {
        if (cuts_[start].vertex < 0) continue;
        Face cap{static_cast<int>(corner_count_), 0, 0, origin};
        int* const corners = room_for(cuts_.size());
        for (int at = static_cast<int>(start); at >= 0 && cuts_[static_cast<std::size_t>(at)].vertex >= 0;) {
            Cut& cut = cuts_[static_cast<std::size_t>(at)];
            corners[cap.count++] = cut.vertex;
            cap.vertices |= bit_of(cut.vertex);
            cut.vertex = -1;
            at = cut.next;
        }
        if (cap.count < 3) continue;
        faces_.push_back(cap);
        corner_count_ += static_cast<std::size_t>(cap.count);
    }
}

Vec3 ConvexClip::area_vector(std::size_t face) const {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = corner(face, 0);
    for (int i = 1; i + 1 < corner_count(face); ++i)
        sum += (corner(face, i) - origin).cross(corner(face, i + 1) - origin);
    return 0.5 * sum;
}

} // namespace kaya
