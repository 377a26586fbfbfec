#include "zone_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace bench {

namespace {

typedef double Eight __attribute__((vector_size(64)));
typedef double Four __attribute__((vector_size(32)));
typedef long long Mask __attribute__((vector_size(64)));

constexpr double radians = 0.017453292519943295, gravity = -9.81, damping = 0.8;

struct Vector {
    Eight x, y, z;
};
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Eight dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Eight root(const Eight& a) {
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_pd(0xff, a);
#else
    Eight r;
    for (int l = 0; l < 8; ++l) r[l] = std::sqrt(a[l]);
    return r;
#endif
}
inline Eight size_of(const Eight& a) { return a < 0 ? -a : a; }
inline Eight pick(const Mask& mask, const Eight& yes, const Eight& no) { return mask ? yes : no; }
inline int count_of(const Mask& mask) {
#if defined(__AVX512DQ__)
    return __builtin_popcount(_mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)));
#else
    int n = 0;
    for (int l = 0; l < 8; ++l) n -= static_cast<int>(mask[l]);
    return n;
#endif
}

inline Eight join(const Four& a, const Four& b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); }

/// Rows of x, y, z as lanes.
inline Vector gather(const Four* rows, const int (&at)[8]) {
    const Eight a = join(rows[at[0]], rows[at[4]]), b = join(rows[at[1]], rows[at[5]]);
    const Eight c = join(rows[at[2]], rows[at[6]]), d = join(rows[at[3]], rows[at[7]]);
    const Eight xz01 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                y01 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight xz23 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14),
                y23 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// The inverse, with addition; rows may repeat.
inline void scatter(Four* rows, const int (&at)[8], const Vector& v) {
    const Eight zero{};
    const Eight xy0 = __builtin_shufflevector(v.x, v.y, 0, 8, 2, 10, 4, 12, 6, 14),
                xy1 = __builtin_shufflevector(v.x, v.y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight z0 = __builtin_shufflevector(v.z, zero, 0, 8, 2, 10, 4, 12, 6, 14),
                z1 = __builtin_shufflevector(v.z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight r02 = __builtin_shufflevector(xy0, z0, 0, 1, 8, 9, 2, 3, 10, 11),
                r46 = __builtin_shufflevector(xy0, z0, 4, 5, 12, 13, 6, 7, 14, 15);
    const Eight r13 = __builtin_shufflevector(xy1, z1, 0, 1, 8, 9, 2, 3, 10, 11),
                r57 = __builtin_shufflevector(xy1, z1, 4, 5, 12, 13, 6, 7, 14, 15);
    rows[at[0]] += __builtin_shufflevector(r02, r02, 0, 1, 2, 3);
    rows[at[1]] += __builtin_shufflevector(r13, r13, 0, 1, 2, 3);
    rows[at[2]] += __builtin_shufflevector(r02, r02, 4, 5, 6, 7);
    rows[at[3]] += __builtin_shufflevector(r13, r13, 4, 5, 6, 7);
    rows[at[4]] += __builtin_shufflevector(r46, r46, 0, 1, 2, 3);
    rows[at[5]] += __builtin_shufflevector(r57, r57, 0, 1, 2, 3);
    rows[at[6]] += __builtin_shufflevector(r46, r46, 4, 5, 6, 7);
    rows[at[7]] += __builtin_shufflevector(r57, r57, 4, 5, 6, 7);
}

/// Eigenvalues and axes of symmetric matrices by Jacobi's rotations, four sweeps. Ascending.
struct Principal {
    Eight value[3], axis[3][3]; ///< axis[i][p]: component i of the axis of value p

    explicit Principal(const Eight (&s)[6]) {
        Eight a[3][3] = {{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}};
        const Eight zero{}, one = zero + 1;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) axis[i][k] = i == k ? one : zero;
        for (int sweep = 0; sweep < 4; ++sweep) {
            rotate<0, 1>(a);
            rotate<0, 2>(a);
            rotate<1, 2>(a);
        }
        for (int i = 0; i < 3; ++i) value[i] = a[i][i];
        put_less_first(0, 1);
        put_less_first(1, 2);
        put_less_first(0, 1);
    }

private:
    template <int P, int Q> void rotate(Eight (&a)[3][3]) {
        constexpr int R = 3 - P - Q;
        const Eight apart = a[Q][Q] - a[P][P], off = a[P][Q];
        const Eight below = size_of(apart) + root(apart * apart + 4 * off * off) + 1e-300;
        Eight t = (off + off) / below;
        t = pick(apart < 0, -t, t);
        const Eight c = 1 / root(t * t + 1), s = t * c;
        a[P][P] -= t * off;
        a[Q][Q] += t * off;
        a[P][Q] = a[Q][P] = Eight{};
        const Eight p = a[R][P], q = a[R][Q];
        a[R][P] = a[P][R] = c * p - s * q;
        a[R][Q] = a[Q][R] = s * p + c * q;
        for (int i = 0; i < 3; ++i) {
            const Eight u = axis[i][P], w = axis[i][Q];
            axis[i][P] = c * u - s * w;
            axis[i][Q] = s * u + c * w;
        }
    }
    void put_less_first(int i, int j) {
        const Mask swap = value[j] < value[i];
        const auto exchange = [&](Eight& a, Eight& b) {
            const Eight x = a;
            a = pick(swap, b, x);
            b = pick(swap, x, b);
        };
        exchange(value[i], value[j]);
        for (int r = 0; r < 3; ++r) exchange(axis[r][i], axis[r][j]);
    }
};

} // namespace

ZoneKernel::ZoneKernel(int blocks, int cells, const Strength& strength, bool joints) {
    constexpr double young = 10e9, poisson = 0.25;
    const double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
    const auto slope_of = [](double degrees) {
        return (1 + std::sin(degrees * radians)) / (1 - std::sin(degrees * radians));
    };
    const double phi = strength.friction * radians;
    material_ = {bulk - 2 * shear / 3,
                 2 * shear,
                 bulk + 4 * shear / 3,
                 2600,
                 std::sin(phi),
                 std::cos(phi),
                 slope_of(strength.friction),
                 slope_of(strength.dilation),
                 strength.cohesion,
                 std::min(strength.tension, strength.cohesion / std::tan(phi))};
    time_step_ = 0.2 / cells / std::sqrt(material_.bulk_stiff / material_.density);
    blocks_ = static_cast<std::size_t>(blocks) * blocks * blocks;
    nodes_in_block_ = static_cast<std::size_t>(cells + 1) * (cells + 1) * (cells + 1);
    groups_in_block_ = (static_cast<std::size_t>(6) * cells * cells * cells + 7) / 8;
    zones_ = 8 * groups_in_block_ * blocks_;
    position_.resize(blocks_ * nodes_in_block_);
    velocity_.resize(position_.size());
    force_.resize(position_.size());
    for (std::size_t b = 0; b < blocks_; ++b) make_block(blocks, cells, static_cast<int>(b));
    joints_of_block_.push_back(0);
    for (std::size_t b = 0; b < blocks_; ++b) {
        if (joints) join(blocks, cells, static_cast<int>(b));
        joints_of_block_.push_back(joints_.size());
    }
    start(0);
}

void ZoneKernel::make_block(int blocks, int cells, int block) {
    const int n = cells + 1, first = static_cast<int>(nodes_in_block_) * block;
    const double h = 1.0 / cells;
    const auto node = [&](const std::array<int, 3>& at) { return first + (at[2] * n + at[1]) * n + at[0]; };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                position_[node({i, j, k})] =
                    Four{block % blocks + i * h, block / blocks % blocks + j * h, block / (blocks * blocks) + k * h, 0};
    // Adjacent cubes in the lanes, so that corners of one kind are different gridpoints; groups in the order of their positions.
    constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    constexpr bool turned[6] = {false, true, true, false, false, true};
    std::vector<std::array<int, 4>> zones;
    for (int kind = 0; kind < 6; ++kind)
        for (int cell = 0; cell < cells * cells * cells; ++cell) {
            std::array<int, 3> at{cell % cells, cell / cells % cells, cell / (cells * cells)};
            std::array<int, 4> corner{node(at)};
            for (int s = 0; s < 3; ++s) {
                ++at[order[kind][s]];
                corner[s + 1] = node(at);
            }
            if (turned[kind]) std::swap(corner[2], corner[3]);
            zones.push_back(corner);
        }
    while (zones.size() % 8 != 0) zones.push_back(zones.back());
    std::vector<std::size_t> sorted(groups_in_block_);
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::size_t a, std::size_t b) { return zones[8 * a][0] < zones[8 * b][0]; });
    const double quarter = material_.density * h * h * h / 6 / 4;
    for (const std::size_t g : sorted) {
        Group group{};
        for (int l = 0; l < 8; ++l)
            for (int a = 0; a < 4; ++a) {
                group.corner[a][l] = zones[8 * g + l][a];
                position_[group.corner[a][l]][3] += quarter; // first, the mass
            }
        groups_.push_back(group);
    }
    for (std::size_t i = 0; i < nodes_in_block_; ++i) position_[first + i][3] = 1 / position_[first + i][3];
}

void ZoneKernel::start(double speed) {
    for (std::size_t i = 0; i < position_.size(); ++i) {
        const Four& x = position_[i];
        velocity_[i] = Four{speed * (std::sin(2 * x[1]) + 0.3 * x[2]), speed * std::cos(3 * x[2]),
                            speed * (std::sin(1.7 * x[0]) - 0.2 * x[2]), 0};
        force_[i] = Four{};
    }
    for (auto& group : groups_)
        for (auto& component : group.stress) component = Eight{};
    for (auto& joint : joints_) {
        joint.normal = 2e5 * joint.area;
        for (auto& component : joint.shear) component = Eight{};
        joint.intact = Mask{} - 1;
    }
}

void ZoneKernel::move(std::size_t first, std::size_t last) {
    const Four pull{0, 0, gravity, 0}, step{time_step_, time_step_, time_step_, 0};
    for (std::size_t i = first; i < last; ++i) {
        const Four a = force_[i] * position_[i][3] + pull;
        const Four size = a < 0 ? -a : a;
        const Four brake = damping * (velocity_[i] < 0 ? -size : size);
        velocity_[i] += (a - brake) * step;
        position_[i] += velocity_[i] * step;
        force_[i] = Four{};
    }
}

void ZoneKernel::load(Group& group) {
    Vector x[4], v[4];
    for (int a = 0; a < 4; ++a) {
        x[a] = gather(position_.data(), group.corner[a]);
        v[a] = gather(velocity_.data(), group.corner[a]);
    }
    const Vector e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
    const Vector w1 = v[1] - v[0], w2 = v[2] - v[0], w3 = v[3] - v[0];
    const Vector c1 = cross(e2, e3), c2 = cross(e3, e1), c3 = cross(e1, e2);
    const Eight scale = time_step_ / dot(e1, c1), half = 0.5 * scale;
    const auto gradient = [&](const Eight& a, const Eight& b, const Eight& c) {
        return Vector{a * c1.x + b * c2.x + c * c3.x, a * c1.y + b * c2.y + c * c3.y, a * c1.z + b * c2.z + c * c3.z};
    };
    const Vector gx = gradient(w1.x, w2.x, w3.x), gy = gradient(w1.y, w2.y, w3.y), gz = gradient(w1.z, w2.z, w3.z);
    const Eight dxx = gx.x * scale, dyy = gy.y * scale, dzz = gz.z * scale;
    const Eight dxy = (gx.y + gy.x) * half, dxz = (gx.z + gz.x) * half, dyz = (gy.z + gz.y) * half;
    const Eight wxy = (gx.y - gy.x) * half, wxz = (gx.z - gz.x) * half, wyz = (gy.z - gz.y) * half;

    auto& s = group.stress;
    const Eight xx = s[0], yy = s[1], zz = s[2], xy = s[3], xz = s[4], yz = s[5];
    const Eight volume = material_.lame * (dxx + dyy + dzz);
    const double g2 = material_.two_shear;
    const Eight t1 = wxy * xy, t2 = wxz * xz, t3 = wyz * yz; // Jaumann: W s - s W
    s[0] = xx + (g2 * dxx + volume) + 2 * (t1 + t2);
    s[1] = yy + (g2 * dyy + volume) + 2 * (t3 - t1);
    s[2] = zz + (g2 * dzz + volume) - 2 * (t2 + t3);
    s[3] = (g2 * dxy + xy) + (wxy * (yy - xx) + wxz * yz + wyz * xz);
    s[4] = (g2 * dxz + xz) + (wxz * (zz - xx) + wxy * yz - wyz * xy);
    s[5] = (g2 * dyz + yz) + (wyz * (zz - yy) - wxy * xz - wxz * xy);

    // Certainly elastic: by the invariants, without the principal stresses.
    const Eight mean = (s[0] + s[1] + s[2]) * (1.0 / 3), u0 = s[0] - mean, u1 = s[1] - mean, u2 = s[2] - mean;
    const Eight second = 0.5 * (u0 * u0 + u1 * u1 + u2 * u2) + (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    const Eight shear_room = material_.cohesion * material_.cosine - mean * material_.sine,
                tension_room = material_.tension - mean;
    const Eight shear_limit = shear_room * size_of(shear_room) * (1 / (1 + material_.sine * material_.sine / 3));
    const Eight tension_limit = tension_room * size_of(tension_room) * 0.75;
    const Mask yields = pick(shear_limit < tension_limit, shear_limit, tension_limit) < second;
    if (const int count = count_of(yields); count != 0) {
        yielding_ += count;
        Eight back[6];
        std::copy_n(s, 6, back);
        bring_back(back);
        for (int k = 0; k < 6; ++k) s[k] = pick(yields, back[k], s[k]);
    }

    Eight z[6];
    for (int k = 0; k < 6; ++k) z[k] = s[k] * (-1.0 / 6);
    const auto force = [&](const Vector& c) {
        return Vector{z[0] * c.x + z[3] * c.y + z[4] * c.z, z[3] * c.x + z[1] * c.y + z[5] * c.z,
                      z[4] * c.x + z[5] * c.y + z[2] * c.z};
    };
    const Vector f1 = force(c1), f2 = force(c2), f3 = force(c3);
    const Vector f0{-(f1.x + f2.x + f3.x), -(f1.y + f2.y + f3.y), -(f1.z + f2.z + f3.z)};
    scatter(force_.data(), group.corner[0], f0);
    scatter(force_.data(), group.corner[1], f1);
    scatter(force_.data(), group.corner[2], f2);
    scatter(force_.data(), group.corner[3], f3);
}

/// Return to the surface along the flow: shear where the tension cut-off is farther away, otherwise tension.
void ZoneKernel::bring_back(Eight (&stress)[6]) const {
    const Principal principal(stress);
    const auto& m = material_;
    const auto& p = principal.value;
    const double strength = 2 * m.cohesion * std::sqrt(m.slope), a1 = m.bulk_stiff, a2 = m.lame;
    const double along = std::sqrt(1 + m.slope * m.slope) + m.slope, corner = m.tension * m.slope - strength;
    const Eight shear = p[0] - p[2] * m.slope + strength, tension = m.tension - p[2]; // negative where the zone yields
    const Eight side = (p[2] - m.tension) + along * (p[0] - corner);
    const Mask tears = (side > 0) & (tension < 0), slides = (shear < 0) & ~(side > 0);
    const Eight zero{};
    const double below = (a1 - a2 * m.flow) - (a2 - a1 * m.flow) * m.slope;
    const Eight ls = pick(slides, shear * (1 / below), zero), lt = pick(tears, -tension * (1 / a1), zero);
    const Eight back[3] = {p[0] - ls * (a1 - a2 * m.flow) - lt * a2, p[1] - ls * (a2 * (1 - m.flow)) - lt * a2,
                           p[2] - ls * (a2 - a1 * m.flow) - lt * a1};
    const auto& q = principal.axis;
    const auto component = [&](int i, int k) {
        return back[0] * q[i][0] * q[k][0] + back[1] * q[i][1] * q[k][1] + back[2] * q[i][2] * q[k][2];
    };
    stress[0] = component(0, 0);
    stress[1] = component(1, 1);
    stress[2] = component(2, 2);
    stress[3] = component(0, 1);
    stress[4] = component(0, 2);
    stress[5] = component(1, 2);
}

/// The face of a block towards its neighbour in each direction: gridpoints of either side with triangles of the other.
void ZoneKernel::join(int blocks, int cells, int block) {
    const int n = cells + 1;
    const std::array<int, 3> at{block % blocks, block / blocks % blocks, block / (blocks * blocks)},
        next{1, blocks, blocks * blocks};
    int lane = 0;
    const auto add = [&](const std::array<int, 4>& corner, int axis, double sign) {
        if (lane == 0) {
            joints_.emplace_back();
            joints_.back() = Joint{};
        }
        Joint& joint = joints_.back();
        for (int l = lane; l < (lane == 0 ? 8 : lane + 1); ++l) // remaining lanes have no area
            for (int a = 0; a < 4; ++a) joint.corner[a][l] = corner[a];
        joint.weight[0][lane] = 1;
        joint.direction[axis][lane] = sign;
        joint.area[lane] = 0.5 / (n * n);
        lane = (lane + 1) % 8;
        ++sub_contacts_;
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (at[axis] + 1 >= blocks) continue;
        const auto node = [&](bool other, int u, int v) {
            std::array<int, 3> place{};
            place[axis] = other ? 0 : cells;
            place[(axis + 1) % 3] = u;
            place[(axis + 2) % 3] = v;
            return static_cast<int>(nodes_in_block_) * (block + (other ? next[axis] : 0)) +
                   (place[2] * n + place[1]) * n + place[0];
        };
        for (const bool other : {false, true})
            for (int u = 0; u < n; ++u)
                for (int v = 0; v < n; ++v) {
                    const int u2 = u < cells ? u + 1 : u - 1, v2 = v < cells ? v + 1 : v - 1;
                    add({node(other, u, v), node(!other, u, v), node(!other, u2, v), node(!other, u, v2)}, axis,
                        other ? 1 : -1);
                }
    }
}

void ZoneKernel::load(Joint& j) {
    constexpr double normal_stiffness = 1e10, shear_stiffness = 5e9, friction = 0.57735, cohesion = 1e5, tension = 5e4;
    const Vector a = gather(velocity_.data(), j.corner[0]);
    const Vector b0 = gather(velocity_.data(), j.corner[1]), b1 = gather(velocity_.data(), j.corner[2]),
                 b2 = gather(velocity_.data(), j.corner[3]);
    const Eight w0 = j.weight[0], w1 = j.weight[1], w2 = 1 - w0 - w1;
    const auto mean = [&](const Eight& x, const Eight& y, const Eight& z) { return w0 * x + w1 * y + w2 * z; };
    const Vector u{(a.x - mean(b0.x, b1.x, b2.x)) * time_step_, (a.y - mean(b0.y, b1.y, b2.y)) * time_step_,
                   (a.z - mean(b0.z, b1.z, b2.z)) * time_step_};
    const Vector n{j.direction[0], j.direction[1], j.direction[2]}, before{j.shear[0], j.shear[1], j.shear[2]};
    const Eight along = dot(u, n), out = dot(before, n), ks = j.area * shear_stiffness;
    const auto sheared = [&](const Eight& f, const Eight& d, const Eight& slip) {
        return f - out * d - ks * (slip - along * d);
    };
    const Vector s{sheared(before.x, n.x, u.x), sheared(before.y, n.y, u.y), sheared(before.z, n.z, u.z)};
    const Eight zero{}, normal = j.normal - j.area * normal_stiffness * along;
    const Mask opens = normal < pick(j.intact, -tension * j.area, zero);
    Eight limit = friction * normal + pick(j.intact, cohesion * j.area, zero);
    limit = pick(limit < 0, zero, limit);
    const Eight size2 = dot(s, s);
    const Mask slips = limit * limit < size2;
    const Eight scale = pick(opens, zero, pick(slips, limit / root(size2 + 1e-300), zero + 1));
    j.normal = pick(opens, zero, normal);
    j.shear[0] = s.x * scale;
    j.shear[1] = s.y * scale;
    j.shear[2] = s.z * scale;
    j.intact &= ~opens & ~slips;
    const Vector f{j.normal * n.x + j.shear[0], j.normal * n.y + j.shear[1], j.normal * n.z + j.shear[2]};
    const auto part = [&](const Eight& w) { return Vector{-w * f.x, -w * f.y, -w * f.z}; };
    scatter(force_.data(), j.corner[0], f);
    scatter(force_.data(), j.corner[1], part(w0));
    scatter(force_.data(), j.corner[2], part(w1));
    scatter(force_.data(), j.corner[3], part(w2));
}

void ZoneKernel::step() {
    yielding_ = 0;
    if (!joints_.empty()) move(0, position_.size()); // joints need the motion of both blocks
    for (std::size_t b = 0; b < blocks_; ++b) {
        if (joints_.empty()) move(b * nodes_in_block_, (b + 1) * nodes_in_block_);
        for (std::size_t g = b * groups_in_block_; g < (b + 1) * groups_in_block_; ++g) load(groups_[g]);
        for (std::size_t i = joints_of_block_[b]; i < joints_of_block_[b + 1]; ++i) load(joints_[i]);
    }
}

std::array<double, 3> ZoneKernel::sum_of_forces() const {
    Four sum{};
    for (const auto& force : force_) sum += force;
    return {sum[0], sum[1], sum[2]};
}

double ZoneKernel::largest_force() const {
    double largest = 0;
    for (const auto& force : force_)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(force[k]));
    return largest;
}

} // namespace bench
