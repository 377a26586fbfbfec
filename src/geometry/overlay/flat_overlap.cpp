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
    vertices_.clear();
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
    Eigen::Vector2d of_area = Eigen::Vector2d::Zero(), first = of_area; // integrals of x, and of closure x
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();                   // of closure x x'
    const Corner& a = polygon_[0];
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i) {
        const Corner &b = polygon_[i], &c = polygon_[i + 1];
        const Eigen::Vector2d xb(b.u - a.u, b.v - a.v), xc(c.u - a.u, c.v - a.v), sum = xb + xc;
        const double area = 0.5 * (xb.x() * xc.y() - xb.y() * xc.x()), closure = a.closure + b.closure + c.closure;
        const Eigen::Vector2d weighted = b.closure * xb + c.closure * xc;
        area_ += area;
        of_area += area / 3 * sum;
        volume += area / 3 * closure;
        first += area / 12 * (weighted + closure * sum);
        energy +=
            area / 24 * (a.closure * a.closure + b.closure * b.closure + c.closure * c.closure + closure * closure);
        second += area / 60 *
                  (closure * (sum * sum.transpose() + xb * xb.transpose() + xc * xc.transpose()) +
                   weighted * sum.transpose() + sum * weighted.transpose() + 2 * b.closure * xb * xb.transpose() +
                   2 * c.closure * xc * xc.transpose());
    }
    moments_ = {};
    if (!(volume > 0)) return;
    const Eigen::Vector2d centre = first / volume;
    second = second / volume - centre * centre.transpose();
    moments_.volume = volume;
    moments_.centroid = place(a.u + centre.x(), a.v + centre.y());
    const Mat3 uv = axis_u_ * axis_v_.transpose();
    moments_.second = second(0, 0) * axis_u_ * axis_u_.transpose() + second(1, 1) * axis_v_ * axis_v_.transpose() +
                      second(0, 1) * (uv + uv.transpose());
    const Eigen::Vector2d middle = of_area / area_;
    volume_ = {volume, area_ * push_, area_ * place(a.u + middle.x(), a.v + middle.y()).cross(push_)};
    depth_ = {energy, volume * push_, volume * moments_.centroid.cross(push_)};
    for (const Corner& c : polygon_)
        for (const double half : {-0.5, 0.5}) vertices_.push_back(place(c.u, c.v) + half * c.closure * normal_);
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
