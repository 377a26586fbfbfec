#include "geometry/polyhedra/convex_overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

void ConvexClip::clear() {
    vertices_.clear();
    corners_.clear();
    faces_.clear();
}

void ConvexClip::copy(const ConvexClip& other) {
    vertices_ = other.vertices_;
    corners_ = other.corners_;
    faces_ = other.faces_;
}

/// The vertex at which an edge leaves the plane's lower side; both faces at the edge find the same one.
int ConvexClip::cut_at(int inside, int outside) {
    for (std::size_t i = 0; i < cuts_.size(); ++i)
        if (cuts_[i].inside == inside && cuts_[i].outside == outside) return static_cast<int>(i);
    const auto in = static_cast<std::size_t>(inside), out = static_cast<std::size_t>(outside);
    const double part = distance_[in] / (distance_[in] - distance_[out]);
    cuts_.push_back({inside, outside, static_cast<int>(vertices_.size()), -1});
    vertices_.push_back(old_vertices_[in] + part * (old_vertices_[out] - old_vertices_[in]));
    return static_cast<int>(cuts_.size()) - 1;
}

void ConvexClip::clip(const HalfSpace& plane, FaceOrigin origin) {
    distance_.resize(vertices_.size());
    bool any_above = false, any_below = false;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        distance_[i] = -plane.depth(vertices_[i]);
        (distance_[i] > 0 ? any_above : any_below) = true;
    }
    if (!any_above) return;
    if (!any_below) return clear();
    vertices_.swap(old_vertices_);
    corners_.swap(old_corners_);
    faces_.swap(old_faces_);
    clear();
    cuts_.clear();
    renamed_.assign(old_vertices_.size(), -1);
    for (std::size_t i = 0; i < old_vertices_.size(); ++i)
        if (!(distance_[i] > 0)) {
            renamed_[i] = static_cast<int>(vertices_.size());
            vertices_.push_back(old_vertices_[i]);
        }
    clip_faces();
    close(origin);
}

void ConvexClip::clip_faces() {
    for (std::size_t f = 0; f < old_faces_.size(); ++f) {
        const int first = old_faces_[f].first;
        const int last = f + 1 < old_faces_.size() ? old_faces_[f + 1].first : static_cast<int>(old_corners_.size());
        const std::size_t begun = corners_.size();
        int left = -1, entered_first = -1; // cuts where the loop crosses the plane upward and back
        for (int i = first; i < last; ++i) {
            const int a = old_corners_[static_cast<std::size_t>(i)];
            const int b = old_corners_[static_cast<std::size_t>(i + 1 < last ? i + 1 : first)];
            const bool a_below = renamed_[static_cast<std::size_t>(a)] >= 0,
                       b_below = renamed_[static_cast<std::size_t>(b)] >= 0;
            if (a_below) corners_.push_back(renamed_[static_cast<std::size_t>(a)]);
            if (a_below == b_below) continue;
            const int cut = a_below ? cut_at(a, b) : cut_at(b, a);
            corners_.push_back(cuts_[static_cast<std::size_t>(cut)].vertex);
            if (a_below) {
                left = cut;
            } else if (left >= 0) {
                // The cap uses this edge in the opposite direction.
                cuts_[static_cast<std::size_t>(cut)].next = left;
                left = -1;
            } else {
                entered_first = cut;
            }
        }
        if (left >= 0 && entered_first >= 0) cuts_[static_cast<std::size_t>(entered_first)].next = left;
        if (corners_.size() - begun >= 3) faces_.push_back({static_cast<int>(begun), old_faces_[f].origin});
        else corners_.resize(begun);
    }
}

/// The new face on the plane: the cuts, each with the one that follows it.
void ConvexClip::close(FaceOrigin origin) {
    for (std::size_t start = 0; start < cuts_.size(); ++start) {
        if (cuts_[start].vertex < 0) continue;
        const std::size_t begun = corners_.size();
        for (int at = static_cast<int>(start); at >= 0 && cuts_[static_cast<std::size_t>(at)].vertex >= 0;) {
            Cut& cut = cuts_[static_cast<std::size_t>(at)];
            corners_.push_back(cut.vertex);
            cut.vertex = -1;
            at = cut.next;
        }
        if (corners_.size() - begun >= 3) faces_.push_back({static_cast<int>(begun), origin});
        else corners_.resize(begun);
    }
}

Vec3 ConvexClip::area_vector(std::size_t face) const {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = corner(face, 0);
    for (int i = 1; i + 1 < corner_count(face); ++i)
        sum += (corner(face, i) - origin).cross(corner(face, i + 1) - origin);
    return 0.5 * sum;
}

namespace {

/// The mean of the vertices: numbers stay small.
Vec3 middle_of(const ConvexClip& part) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& v : part.vertices()) sum += v;
    return sum / static_cast<double>(part.vertices().size());
}

/// Calls `each` with the volume of the tetrahedra between a place and the triangles of the faces, and with their corners from there.
template <class Each> void each_tetrahedron(const ConvexClip& part, const Vec3& from, Each each) {
    for (std::size_t f = 0; f < part.face_count(); ++f) {
        const Vec3 a = part.corner(f, 0) - from;
        for (int i = 1; i + 1 < part.corner_count(f); ++i) {
            const Vec3 b = part.corner(f, i) - from, c = part.corner(f, i + 1) - from;
            each(a.dot(b.cross(c)) / 6, a, b, c);
        }
    }
}

struct VolumeCentre {
    double volume = 0;
    Vec3 centroid = Vec3::Zero();
};

VolumeCentre volume_centre(const ConvexClip& part) {
    const Vec3 origin = middle_of(part);
    double whole = 0;
    Vec3 first = Vec3::Zero();
    each_tetrahedron(part, origin, [&](double volume, const Vec3& a, const Vec3& b, const Vec3& c) {
        whole += volume;
        first += 0.25 * volume * (a + b + c);
    });
    return {whole, origin + first / whole};
}

} // namespace

OverlapMoments moments_of(const ConvexClip& part) {
    OverlapMoments m;
    if (part.empty() || part.vertices().empty()) return m;
    const Vec3 origin = middle_of(part);
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    each_tetrahedron(part, origin, [&](double volume, const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 sum = a + b + c;
        m.volume += volume;
        first += 0.25 * volume * sum;
        second += 0.05 * volume * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    });
    if (!(m.volume > 0)) return {};
    const Vec3 centre = first / m.volume;
    m.centroid = origin + centre;
    m.second = second / m.volume - centre * centre.transpose();
    return m;
}

void OverlapGradient::add(const OverlapGradient& other, double weight) {
    value += weight * other.value;
    force += weight * other.force;
    moment += weight * other.moment;
}

namespace {

/// Adds the integrals of pressure n and x x n over a face; the pressure is linear and given at the corners.
template <class Pressure>
void push(const ConvexClip& part, std::size_t face, double sense, const Pressure& pressure, OverlapGradient& sum) {
    const Vec3& a = part.corner(face, 0);
    const double pa = pressure(a);
    for (int i = 1; i + 1 < part.corner_count(face); ++i) {
        const Vec3 &b = part.corner(face, i), &c = part.corner(face, i + 1);
        const Vec3 area = 0.5 * sense * (b - a).cross(c - a);
        const double pb = pressure(b), pc = pressure(c), whole = pa + pb + pc;
        sum.force -= whole / 3 * area;
        sum.moment -= (pa * a + pb * b + pc * c + whole * (a + b + c)).cross(area) / 12;
    }
}

} // namespace

OverlapGradient volume_gradient(const ConvexClip& part, double volume, bool second) {
    OverlapGradient gradient;
    gradient.value = volume;
    // The subject's own surface moves with it; the second body is pushed by its own, or against that of the first.
    for (std::size_t f = 0; f < part.face_count(); ++f)
        if (part.origin(f) == FaceOrigin::subject)
            push(
                part, f, second ? 1 : -1, [](const Vec3&) { return 1.0; }, gradient);
    return gradient;
}

OverlapGradient depth_gradient(const ConvexClip& part, const std::vector<HalfSpace>& faces, bool of_subject,
                               bool second, DepthScratch& scratch) {
    // The faces that may be the nearest somewhere. No place is deeper than the deepest corner below any one face.
    std::vector<double>& least = scratch.least;
    ConvexClip& piece = scratch.piece;
    least.clear();
    double deepest = std::numeric_limits<double>::infinity();
    for (const HalfSpace& face : faces) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& x : part.vertices()) {
            const double depth = face.depth(x);
            low = std::min(low, depth);
            high = std::max(high, depth);
        }
        least.push_back(low);
        deepest = std::min(deepest, high);
    }
    const FaceOrigin pushed = of_subject ? FaceOrigin::clipper : FaceOrigin::subject;
    const double sense =
        of_subject == second ? -1 : 1; // the surface of the second body is pushed, or that of the first pushes it
    OverlapGradient gradient;
    const auto near = [&](std::size_t i) { return least[i] <= deepest; };
    const auto add = [&](const ConvexClip& region, const HalfSpace& face) {
        const auto depth = [&](const Vec3& x) { return face.depth(x); };
        const VolumeCentre centre = volume_centre(region);
        if (!(centre.volume > 0)) return;
        gradient.value += centre.volume * face.depth(centre.centroid);
        for (std::size_t f = 0; f < region.face_count(); ++f)
            if (region.origin(f) == pushed) push(region, f, sense, depth, gradient);
    };
    std::size_t count = 0, only = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (near(i)) {
            ++count;
            only = i;
        }
    if (count == 1) {
        add(part, faces[only]);
        return gradient;
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (!near(i)) continue;
        piece.copy(part);
        for (std::size_t j = 0; j < faces.size() && !piece.empty(); ++j)
            if (j != i && near(j))
                piece.clip({faces[j].normal - faces[i].normal, faces[j].reach - faces[i].reach}, FaceOrigin::inner);
        if (!piece.empty()) add(piece, faces[i]);
    }
    return gradient;
}

} // namespace kaya
