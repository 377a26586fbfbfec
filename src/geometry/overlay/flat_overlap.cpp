#include "geometry/overlay/flat_overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// A plane as heights over the plane that the polygon is drawn in.
struct Heights {
    double at_origin, along_u, along_v;

    double at(double u, double v) const { return at_origin + u * along_u + v * along_v; }
};

Heights heights_of(const ConvexFace& face, const Vec3& origin, const Vec3& normal, const Vec3& axis_u,
                   const Vec3& axis_v) {
    const double steep = face.outward.dot(normal);
    return {face.outward.dot(face.corners[0] - origin) / steep, -face.outward.dot(axis_u) / steep,
            -face.outward.dot(axis_v) / steep};
}

} // namespace

bool FlatOverlap::find(const ConvexFace& face1, const ConvexFace& face2) {
    polygon_.clear();
    deepest_below_ = 0;
    if (face1.corners.size() < 3 || face2.corners.size() < 3) return false;
    project(face1, face2);
    keep_closed();
    for (const Corner& c : polygon_) deepest_below_ = std::max(deepest_below_, c.closure);
    clip_by_second();
    if (polygon_.size() < 3) return false;
    integrate();
    if (!(moments_.volume > 0) || !(area_ > 0)) return false;
    push_edges();
    return true;
}

/// Draws both faces in the plane midway between them, and the closure at the corners of the first.
void FlatOverlap::project(const ConvexFace& face1, const ConvexFace& face2) {
    origin_ = face1.corners[0]; // numbers stay small
    normal_ = (face1.outward - face2.outward).normalized();
    int least = 0;
    normal_.cwiseAbs().minCoeff(&least);
    axis_u_ = normal_.cross(Vec3::Unit(least)).normalized();
    axis_v_ = normal_.cross(axis_u_);
    const Heights one = heights_of(face1, origin_, normal_, axis_u_, axis_v_),
                  two = heights_of(face2, origin_, normal_, axis_u_, axis_v_);
    height_ = 0.5 * (one.at_origin + two.at_origin);
    slope_u_ = 0.5 * (one.along_u + two.along_u);
    slope_v_ = 0.5 * (one.along_v + two.along_v);
    // Where the second body moves by w its face rises by w . push.
    push_ = normal_ - two.along_u * axis_u_ - two.along_v * axis_v_;
    for (const Vec3& x : face1.corners) {
        const double u = axis_u_.dot(x - origin_), v = axis_v_.dot(x - origin_);
        polygon_.push_back({u, v, one.at(u, v) - two.at(u, v), false});
    }
    second_.clear();
    for (auto x = face2.corners.rbegin(); x != face2.corners.rend(); ++x)
        second_.push_back({axis_u_.dot(*x - origin_), axis_v_.dot(*x - origin_)});
}

/// Keeps the part that `above_` does not mark (Sutherland and Hodgman 1974). The new edge lies on the second face or not.
void FlatOverlap::cut(bool of_second) {
    if (std::none_of(above_.begin(), above_.end(), [](double h) { return h > 0; })) return;
    polygon_.swap(old_);
    polygon_.clear();
    for (std::size_t i = 0; i < old_.size(); ++i) {
        const std::size_t next = i + 1 == old_.size() ? 0 : i + 1;
        const Corner &p = old_[i], &q = old_[next];
        const double hp = above_[i], hq = above_[next];
        if (!(hp > 0)) polygon_.push_back(p);
        if ((hp > 0) == (hq > 0)) continue;
        const double part = hp / (hp - hq);
        polygon_.push_back({p.u + part * (q.u - p.u), p.v + part * (q.v - p.v),
                            p.closure + part * (q.closure - p.closure), hp > 0 ? p.of_second : of_second});
    }
}

void FlatOverlap::keep_closed() {
    above_.clear();
    for (const Corner& c : polygon_) above_.push_back(-c.closure);
    cut(false); // no edge at all: nothing is closed there
}

void FlatOverlap::clip_by_second() {
    for (std::size_t i = 0; i < second_.size() && polygon_.size() >= 3; ++i) {
        const auto &a = second_[i], &b = second_[i + 1 == second_.size() ? 0 : i + 1];
        above_.clear();
        for (const Corner& c : polygon_) above_.push_back((c.u - a[0]) * (b[1] - a[1]) - (c.v - a[1]) * (b[0] - a[0]));
        cut(true);
    }
}

/// Exact integrals over the triangles of a fan, the closure being linear.
void FlatOverlap::integrate() {
    area_ = deepest_ = 0;
    for (const Corner& c : polygon_) deepest_ = std::max(deepest_, c.closure);
    double volume = 0, energy = 0;
    double area_u = 0, area_v = 0, first_u = 0, first_v = 0; // integrals of x, and of closure x
    double uu = 0, uv = 0, vv = 0;                           // of closure x x'
    const Corner& a = polygon_[0];
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i) {
        const Corner &b = polygon_[i], &c = polygon_[i + 1];
        const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v, u = bu + cu, v = bv + cv;
        const double area = 0.5 * (bu * cv - bv * cu), closure = a.closure + b.closure + c.closure;
        const double weighted_u = b.closure * bu + c.closure * cu, weighted_v = b.closure * bv + c.closure * cv;
        area_ += area;
        area_u += area / 3 * u;
        area_v += area / 3 * v;
        volume += area / 3 * closure;
        first_u += area / 12 * (weighted_u + closure * u);
        first_v += area / 12 * (weighted_v + closure * v);
        energy +=
            area / 24 * (a.closure * a.closure + b.closure * b.closure + c.closure * c.closure + closure * closure);
        const double of_b = closure + 2 * b.closure, of_c = closure + 2 * c.closure;
        uu += area / 60 * (closure * u * u + of_b * bu * bu + of_c * cu * cu + 2 * weighted_u * u);
        uv += area / 60 * (closure * u * v + of_b * bu * bv + of_c * cu * cv + weighted_u * v + weighted_v * u);
        vv += area / 60 * (closure * v * v + of_b * bv * bv + of_c * cv * cv + 2 * weighted_v * v);
    }
    moments_ = {};
    if (!(volume > 0)) return;
    const double centre_u = first_u / volume, centre_v = first_v / volume;
    uu = uu / volume - centre_u * centre_u;
    uv = uv / volume - centre_u * centre_v;
    vv = vv / volume - centre_v * centre_v;
    moments_.volume = volume;
    moments_.centroid = place(a.u + centre_u, a.v + centre_v);
    const Vec3 along = uu * axis_u_ + uv * axis_v_, across = uv * axis_u_ + vv * axis_v_;
    moments_.second = axis_u_ * along.transpose() + axis_v_ * across.transpose();
    volume_ = {volume, area_ * push_, area_ * place(a.u + area_u / area_, a.v + area_v / area_).cross(push_)};
    depth_ = {energy, volume * push_, volume * moments_.centroid.cross(push_)};
    double square = 0;
    for (const Corner& c : polygon_) {
        const double u = c.u - a.u - centre_u, v = c.v - a.v - centre_v, high = 0.5 * c.closure;
        square = std::max(square, u * u + v * v + high * high);
    }
    extent_ = std::sqrt(square);
}

/// The sides of the second body move with it.
void FlatOverlap::push_edges() {
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
        if (!polygon_[i].of_second) continue;
        const Corner &p = polygon_[i], &q = polygon_[i + 1 == polygon_.size() ? 0 : i + 1];
        const Vec3 outward = (q.v - p.v) * axis_u_ - (q.u - p.u) * axis_v_; // times the length
        const Vec3 xp = place(p.u, p.v), xq = place(q.u, q.v);
        const double cp = p.closure, cq = q.closure;
        volume_.force -= (cp + cq) / 2 * outward;
        volume_.moment -= ((cp / 3 + cq / 6) * xp + (cp / 6 + cq / 3) * xq).cross(outward);
        depth_.force -= (cp * cp + cp * cq + cq * cq) / 6 * outward;
        depth_.moment -=
            ((cp * cp / 8 + cp * cq / 12 + cq * cq / 24) * xp + (cp * cp / 24 + cp * cq / 12 + cq * cq / 8) * xq)
                .cross(outward);
    }
}

Vec3 FlatOverlap::longest_edge() const {
    double most = 0;
    Vec3 longest = Vec3::Zero();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const Corner &p = polygon_[i], &q = polygon_[i + 1 == polygon_.size() ? 0 : i + 1];
        const double u = q.u - p.u, v = q.v - p.v;
        if (u * u + v * v <= most) continue;
        most = u * u + v * v;
        longest = u * axis_u_ + v * axis_v_;
    }
    return longest;
}

} // namespace kaya
