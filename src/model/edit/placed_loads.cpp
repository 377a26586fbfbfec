#include "model/edit/placed_loads.hpp"

#include "model/tables/model.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// A corner of a polygon under a linear traction.
struct Loaded {
    Vec3 place, traction;
};
using LoadedPolygon = std::vector<Loaded>;

/// Places of a body that differ by less are one.
double precision(double volume, const Vec3& place) {
    constexpr double of_size = 1e-9, of_coordinates = 1e-14;
    return of_size * std::cbrt(volume) + of_coordinates * place.cwiseAbs().maxCoeff();
}

double area_of(const std::array<Vec3, 3>& x) { return 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm(); }

bool is_point(const PlacedLoad& load) {
    const auto& x = load.place;
    return !(area_of(x) > 1e-12 * std::max((x[1] - x[0]).squaredNorm(), (x[2] - x[0]).squaredNorm()));
}

/// Inverse of the consistent loads f_k = (2 t_k + t_l + t_m) A/12.
LoadedPolygon tractions_of(const PlacedLoad& load) {
    const Vec3 sum = load.force[0] + load.force[1] + load.force[2];
    const double area = area_of(load.place);
    LoadedPolygon polygon;
    for (std::size_t k = 0; k < 3; ++k) polygon.push_back({load.place[k], 3 / area * (4 * load.force[k] - sum)});
    return polygon;
}

PlacedLoad load_of(const Loaded& a, const Loaded& b, const Loaded& c) {
    PlacedLoad load{{a.place, b.place, c.place}, {}};
    const double part = area_of(load.place) / 12;
    const Vec3 sum = a.traction + b.traction + c.traction;
    load.force = {part * (a.traction + sum), part * (b.traction + sum), part * (c.traction + sum)};
    return load;
}

/// Height of a place above a face of a piece.
double height(const Polyhedron& piece, const Polyhedron::Face& face, const Vec3& x) {
    return face_normal(piece, face).dot(x - piece.vertices[static_cast<std::size_t>(face.vertices[0])]);
}

double rounding_of(const Polyhedron& piece, const PlacedLoad& load) {
    return precision(mass_properties(piece).volume, load.place[0]);
}

/// Whether the triangle of a load lies on a face.
bool lies_on(const PlacedLoad& load, const Polyhedron& piece, const Polyhedron::Face& face, double tolerance) {
    constexpr double warped = 100; // faces of imported blocks are flat to 1e-7 of their size
    return std::ranges::all_of(load.place,
                               [&](const Vec3& x) { return std::abs(height(piece, face, x)) <= warped * tolerance; });
}

/// Keeps the part of the polygon below a face (Sutherland and Hodgman 1974).
void keep_below(LoadedPolygon& polygon, const Polyhedron& piece, const Polyhedron::Face& face, double tolerance) {
    std::vector<double> heights;
    for (const Loaded& p : polygon) {
        const double h = height(piece, face, p.place);
        heights.push_back(std::abs(h) <= tolerance ? 0 : h);
    }
    LoadedPolygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = i + 1 == polygon.size() ? 0 : i + 1;
        const double here = heights[i], there = heights[next];
        if (here <= 0) kept.push_back(polygon[i]);
        if (!((here > 0 && there < 0) || (here < 0 && there > 0))) continue;
        const double part = here / (here - there);
        const Loaded &p = polygon[i], &q = polygon[next];
        kept.push_back({p.place + part * (q.place - p.place), p.traction + part * (q.traction - p.traction)});
    }
    polygon = std::move(kept);
    if (polygon.size() < 3) polygon.clear();
}

/// Parts of the triangle of a load on pieces. False if they do not cover it.
bool share_triangle(const PlacedLoad& load, std::span<const Polyhedron> pieces,
                    std::vector<std::vector<PlacedLoad>>& parts) {
    constexpr double covered = 1 - 1e-6;
    double area = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double tolerance = rounding_of(pieces[i], load);
        LoadedPolygon polygon = tractions_of(load);
        for (const auto& face : pieces[i].faces)
            if (!lies_on(load, pieces[i], face, tolerance)) keep_below(polygon, pieces[i], face, tolerance);
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            PlacedLoad part = load_of(polygon[0], polygon[k], polygon[k + 1]);
            part.function = load.function;
            if (is_point(part)) continue;
            area += area_of(part.place);
            parts[i].push_back(part);
        }
    }
    return area >= covered * area_of(load.place);
}

/// How far a place is outside of a piece.
double outside(const Polyhedron& piece, const Vec3& x) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& face : piece.faces) most = std::max(most, height(piece, face, x));
    return std::max(0.0, most);
}

/// Forces at the corners of a load, as loads of points.
void share_points(const PlacedLoad& load, std::span<const Polyhedron> pieces,
                  std::vector<std::vector<PlacedLoad>>& parts) {
    double tolerance = 0;
    for (const Polyhedron& piece : pieces) tolerance = std::max(tolerance, rounding_of(piece, load));
    for (std::size_t k = 0; k < 3; ++k) {
        if (load.force[k].isZero(0)) continue;
        std::vector<double> far;
        for (const Polyhedron& piece : pieces) far.push_back(outside(piece, load.place[k]));
        const double least = *std::ranges::min_element(far);
        const auto near = [&](double d) { return d <= least + tolerance; };
        PlacedLoad part = PlacedLoad::at(load.place[k], load.force[k] / std::ranges::count_if(far, near));
        part.function = load.function;
        for (std::size_t i = 0; i < pieces.size(); ++i)
            if (near(far[i])) parts[i].push_back(part);
    }
}

} // namespace

LoadPlaces::LoadPlaces(Model& model) : model_(model) {
    auto& loads = model.placed_loads;
    std::vector<Row> kept;
    for (std::size_t i = 0; i < loads.size(); ++i) {
        const Row b = model.blocks.ids.row(loads.block[i]);
        if (b == no_row || model.blocks.deformable[b] || loads.forces[i].isZero(0)) continue;
        rows_[loads.block[i]].push_back(static_cast<Row>(kept.size()));
        kept.push_back(static_cast<Row>(i));
    }
    if (kept.size() != loads.size()) loads.gather(kept);
}

void LoadPlaces::add(Row b, const PlacedLoad& load) {
    auto& loads = model_.placed_loads;
    const Mat3 to_own = turn_of(model_.blocks, b).transpose();
    Mat3 arms, forces;
    for (int k = 0; k < 3; ++k) {
        arms.col(k) = to_own * (load.place[static_cast<std::size_t>(k)] - model_.blocks.centroid[b]);
        forces.col(k) = load.force[static_cast<std::size_t>(k)];
    }
    std::vector<Row>& rows = rows_[model_.blocks.id[b]];
    const double near = precision(model_.blocks.volume[b], model_.blocks.centroid[b]);
    for (const Row row : rows)
        if (loads.function[row] == load.function && (loads.arms[row] - arms).cwiseAbs().maxCoeff() <= near) {
            loads.forces[row] += forces;
            return;
        }
    const std::size_t row = loads.size();
    loads.resize(row + 1);
    loads.block[row] = model_.blocks.id[b];
    loads.arms[row] = arms;
    loads.forces[row] = forces;
    loads.function[row] = load.function;
    rows.push_back(static_cast<Row>(row));
}

void forget_places(Model& model, Row b, std::initializer_list<int> axes) {
    auto& loads = model.placed_loads;
    for (std::size_t i = 0; i < loads.size(); ++i)
        if (loads.block[i] == model.blocks.id[b] && loads.function[i] == constant_in_time)
            for (const int axis : axes) loads.forces[i].row(axis).setZero();
}

std::vector<PlacedLoad> take_placed_loads(Model& model, Row b) {
    auto& loads = model.placed_loads;
    const Mat3 turn = turn_of(model.blocks, b);
    std::vector<PlacedLoad> taken;
    std::vector<Row> kept;
    for (std::size_t i = 0; i < loads.size(); ++i) {
        if (loads.block[i] != model.blocks.id[b]) {
            kept.push_back(static_cast<Row>(i));
            continue;
        }
        if (loads.forces[i].isZero(0)) continue;
        PlacedLoad& load = taken.emplace_back();
        for (int k = 0; k < 3; ++k) {
            load.place[static_cast<std::size_t>(k)] = model.blocks.centroid[b] + turn * loads.arms[i].col(k);
            load.force[static_cast<std::size_t>(k)] = loads.forces[i].col(k);
        }
        load.function = loads.function[i];
    }
    if (kept.size() != loads.size()) loads.gather(kept);
    return taken;
}

std::vector<PlacedLoad> divided(const PlacedLoad& load, int n) {
    if (is_point(load)) return {load};
    const LoadedPolygon whole = tractions_of(load);
    const auto node = [&](int i, int j) {
        const Vec3 weights = Vec3(i, j, n - i - j) / n;
        Loaded at{Vec3::Zero(), Vec3::Zero()};
        for (std::size_t k = 0; k < 3; ++k) {
            at.place += weights[static_cast<int>(k)] * whole[k].place;
            at.traction += weights[static_cast<int>(k)] * whole[k].traction;
        }
        return at;
    };
    std::vector<PlacedLoad> parts;
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            parts.push_back(load_of(node(i, j), node(i + 1, j), node(i, j + 1)));
            if (i + j + 1 < n) parts.push_back(load_of(node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)));
        }
    for (PlacedLoad& part : parts) part.function = load.function;
    return parts;
}

std::vector<std::vector<PlacedLoad>> parts_on(const PlacedLoad& load, std::span<const Polyhedron> pieces) {
    std::vector<std::vector<PlacedLoad>> parts(pieces.size());
    if (!is_point(load) && share_triangle(load, pieces, parts)) return parts;
    for (auto& of_piece : parts) of_piece.clear();
    share_points(load, pieces, parts);
    return parts;
}

} // namespace kaya
