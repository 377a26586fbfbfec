#include "geometry/polyhedra/convex_overlap.hpp"

#include <Eigen/Geometry>

namespace kaya {

namespace {

/// The mean of the vertices: numbers stay small.
Vec3 middle_of(const ConvexClip& part) {
    Vec3 sum = Vec3::Zero();
    part.each_vertex([&](const Vec3& v) { sum += v; });
    return sum / static_cast<double>(part.vertex_count());
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

} // namespace

OverlapMoments moments_of(const ConvexClip& part) {
    OverlapMoments m;
    if (part.empty() || part.vertex_count() == 0) return m;
    const Vec3 origin = middle_of(part);
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero(); // its lower triangle
    each_tetrahedron(part, origin, [&](double volume, const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 sum = a + b + c;
        m.volume += volume;
        first += 0.25 * volume * sum;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j)
                second(i, j) += 0.05 * volume * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
    });
    if (!(m.volume > 0)) return {};
    const Vec3 centre = first / m.volume;
    m.centroid = origin + centre;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) m.second(i, j) = m.second(j, i) = second(i, j) / m.volume - centre[i] * centre[j];
    return m;
}

void OverlapGradient::add(const OverlapGradient& other, double weight) {
    value += weight * other.value;
    force += weight * other.force;
    moment += weight * other.moment;
}

OverlapGradient volume_gradient(const ConvexClip& part, double volume, bool second) {
    OverlapGradient gradient;
    gradient.value = volume;
    // The subject's own surface moves with it; the second body is pushed by its own, or against that of the first.
    const double sense = second ? -1 : 1;
    for (std::size_t f = 0; f < part.face_count(); ++f) {
        if (part.origin(f) != FaceOrigin::subject) continue;
        const Vec3& a = part.corner(f, 0);
        for (int i = 1; i + 1 < part.corner_count(f); ++i) {
            const Vec3 &b = part.corner(f, i), &c = part.corner(f, i + 1);
            const Vec3 push = 0.5 * sense * (b - a).cross(c - a);
            gradient.force += push;
            gradient.moment += (a + b + c).cross(push) / 3;
        }
    }
    return gradient;
}

} // namespace kaya
