#include "mechanics/supports/boundary.hpp"

#include "mechanics/common/remedy.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "mechanics/common/masses.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/placed_loads.hpp"
#include "model/measure/cell_faces.hpp"
#include "model/measure/covered_faces.hpp"
#include "model/measure/measure.hpp"
#include "model/edit/ties.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

namespace kaya {

namespace {

using What = BoundaryHistories::What;

std::uint8_t bit_of(int component) { return static_cast<std::uint8_t>(1 << component); }

bool is_rotation(int component) { return component >= 3; }

/// Calls of_block(row) for rigid blocks and of_gridpoint(row) for the others; rotations exist for rigid blocks only.
template <class OfBlock, class OfGridpoint>
void each_body(const Model& model, const Bodies& bodies, int component, OfBlock of_block, OfGridpoint of_gridpoint) {
    for (const Row b : bodies.blocks) {
        if (!model.blocks.deformable[b]) {
            of_block(b);
            continue;
        }
        if (is_rotation(component)) continue;
        const Span span = model.blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g) of_gridpoint(g);
    }
    if (is_rotation(component)) return;
    for (const Row g : bodies.gridpoints) of_gridpoint(g);
}

/// The object on which a boundary history acts.
struct Target {
    BlockId block;
    Row gridpoint;
    int component;
    auto operator<=>(const Target&) const = default;
};

Target of_block(const Model& model, Row b, int component) { return {model.blocks.id[b], no_row, component}; }
Target of_gridpoint(const Model& model, Row g, int component) {
    const Row b = model.gridpoints.block[g];
    return {model.blocks.id[b], g - model.blocks.gridpoints[b].first, component};
}

void add_boundary_history(Model& model, What what, const Target& target, double amplitude, std::int32_t function) {
    auto& histories = model.boundary_histories;
    const std::size_t row = histories.size();
    histories.resize(row + 1);
    histories.block[row] = target.block;
    histories.gridpoint[row] = target.gridpoint;
    histories.what[row] = what;
    histories.component[row] = target.component;
    histories.amplitude[row] = amplitude;
    histories.function[row] = function;
}

} // namespace

void tidy_boundary_histories(Model& model) {
    auto& histories = model.boundary_histories;
    std::vector<Row> kept;
    const std::size_t count = histories.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        if (b == no_row) continue;
        const bool zoned = histories.gridpoint[i] == no_row && model.blocks.deformable[b];
        if (!zoned) {
            kept.push_back(static_cast<Row>(i));
            continue;
        }
        if (histories.what[i] == What::load || is_rotation(histories.component[i])) continue;
        for (Row g = 0; g < model.blocks.gridpoints[b].count; ++g) {
            kept.push_back(static_cast<Row>(histories.size()));
            add_boundary_history(model, What::velocity, {histories.block[i], g, histories.component[i]},
                                 histories.amplitude[i], histories.function[i]);
        }
    }
    if (kept.size() != count || histories.size() != count) histories.gather(kept);
}

namespace {

/// Removes velocity histories of these targets. Sorts `targets`.
void drop_velocity_histories(Model& model, std::vector<Target>& targets) {
    if (model.boundary_histories.empty()) return;
    tidy_boundary_histories(model);
    std::ranges::sort(targets);
    const auto& histories = model.boundary_histories;
    std::vector<Row> kept;
    for (std::size_t i = 0; i < histories.size(); ++i) {
        const Target target{histories.block[i], histories.gridpoint[i], histories.component[i]};
        if (histories.what[i] == What::load || !std::ranges::binary_search(targets, target))
            kept.push_back(static_cast<Row>(i));
    }
    model.boundary_histories.gather(kept);
}

/// Time-dependent loads, summed by target before they become histories.
class LoadSums {
public:
    LoadSums(Model& model, std::int32_t function) : model_(model), function_(function) {}

    void add(const Target& target, double& constant, double value) {
        if (function_ == constant_in_time) constant += value;
        else sums_[target] += value;
    }
    void at_gridpoint(Row g, int axis, double value) {
        auto& blocks = model_.blocks;
        const Row b = model_.gridpoints.block[g];
        if (blocks.deformable[b]) {
            add(of_gridpoint(model_, g, axis), model_.gridpoints.load[g][axis], value);
            return;
        }
        at_point(b, model_.gridpoints.position[g], axis, value);
    }
    void at_point(Row b, const Vec3& place, int axis, double value) {
        at_place(b, place, axis, value);
        note_place(b, PlacedLoad::at(place, value * Vec3::Unit(axis)));
    }
    /// The corners of a triangle of a rigid block, with the forces there.
    void at_triangle(Row b, const PlacedLoad& load) {
        for (std::size_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) at_place(b, load.place[k], axis, load.force[k][axis]);
        note_place(b, load);
    }
    /// On a rigid block. The point moves with the block, the direction stays.
    void at_place(Row b, const Vec3& place, int axis, double value) {
        const auto& blocks = model_.blocks;
        const Vec3 arm = quaternion(blocks.orientation[b]).conjugate() * (place - blocks.centroid[b]);
        on_block(b, axis, value);
        for (int k = 0; k < 3; ++k)
            if (arm[k] != 0) on_block(b, BoundaryHistories::motions + 3 * axis + k, value * arm[k]);
    }
    void on_block(Row b, int component, double value) {
        add(of_block(model_, b, component), load_component(model_.blocks, b, component), value);
    }
    void finish() {
        for (const auto& [target, value] : sums_) add_boundary_history(model_, What::load, target, value, function_);
        ModelEdit(model_, Change::properties);
    }

private:
    void note_place(Row b, PlacedLoad load) {
        load.function = function_;
        if (!places_) places_.emplace(model_);
        places_->add(b, load);
    }

    Model& model_;
    std::int32_t function_;
    std::map<Target, double> sums_;
    std::optional<LoadPlaces> places_;
};

} // namespace

namespace {

/// The triangles that other blocks cover by this part at most, and not whole, as far as they are wanted.
template <class Wanted> std::vector<Row> uncovered_triangles(const Model& model, double most, Wanted wanted) {
    const CoveredFaces covered(model, tied_face_pairs(model));
    std::vector<Row> rows;
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t) {
        if (!wanted(t)) continue;
        const double share = covered.share(t);
        if (share < 1 && share <= most) rows.push_back(t);
    }
    return rows;
}

bool is_listed(const std::vector<Row>& sorted, Row row) { return std::ranges::binary_search(sorted, row); }

} // namespace

std::vector<Row> exterior_triangles(const Model& model, const std::vector<Row>& gridpoints, double most_covered) {
    return uncovered_triangles(model, most_covered, [&](Row t) {
        return std::ranges::all_of(model.triangles.gridpoints[t], [&](Row g) { return is_listed(gridpoints, g); });
    });
}

std::vector<Row> exterior_triangles_of_faces(const Model& model, const std::vector<Row>& faces, double most_covered) {
    return uncovered_triangles(model, most_covered, [&](Row t) { return is_listed(faces, model.triangles.face[t]); });
}

std::int32_t time_function_row(Model& model, const TimeFunction& function) {
    auto& all = model.time_functions;
    const auto found = std::ranges::find(all, function);
    const auto row = static_cast<std::int32_t>(found - all.begin());
    if (found == all.end()) all.push_back(function);
    return row;
}

void prescribe_velocity(Model& model, const Bodies& bodies, int component, double value, std::int32_t function) {
    auto& blocks = model.blocks;
    auto& points = model.gridpoints;
    // A time-dependent load gets its value in the next step.
    const bool constant = function == constant_in_time;
    std::vector<Target> targets;
    each_body(
        model, bodies, component,
        [&](Row b) {
            blocks.fixed[b] |= bit_of(component);
            targets.push_back(of_block(model, b, component));
            if (!constant) return;
            if (is_rotation(component)) blocks.rotational_velocity[b][component - 3] = value;
            else blocks.velocity[b][component] = value;
        },
        [&](Row g) {
            points.fixed[g] |= bit_of(component);
            targets.push_back(of_gridpoint(model, g, component));
            if (constant) points.velocity[g][component] = value;
        });
    ModelEdit(model, Change::properties);
    drop_velocity_histories(model, targets);
    if (constant) return;
    for (const Target& target : targets) add_boundary_history(model, What::velocity, target, value, function);
}

void release_velocity(Model& model, const Bodies& bodies, int component) {
    const auto mask = static_cast<std::uint8_t>(~bit_of(component));
    std::vector<Target> targets;
    each_body(
        model, bodies, component,
        [&](Row b) {
            model.blocks.fixed[b] &= mask;
            targets.push_back(of_block(model, b, component));
        },
        [&](Row g) {
            model.gridpoints.fixed[g] &= mask;
            targets.push_back(of_gridpoint(model, g, component));
        });
    drop_velocity_histories(model, targets);
    ModelEdit(model, Change::properties);
}

void replace_by_reaction(Model& model, const Bodies& bodies, int axis) {
    auto& blocks = model.blocks;
    auto& points = model.gridpoints;
    const double gravity = model.settings.gravity[axis];
    // A held component gets a load that balances all other forces.
    each_body(
        model, bodies, axis,
        [&](Row b) {
            if (!(blocks.fixed[b] & bit_of(axis))) return;
            forget_places(model, b, {axis});
            blocks.load[b][axis] = -(blocks.force[b][axis] + blocks.mass[b] * gravity);
        },
        [&](Row g) {
            if (points.fixed[g] & bit_of(axis))
                points.load[g][axis] = -(points.force[g][axis] + points.mass[g] * gravity);
        });
    release_velocity(model, bodies, axis);
}

void initialize_velocity(Model& model, const Bodies& bodies, int component, double value) {
    auto& blocks = model.blocks;
    if (is_rotation(component) && model.stale.properties()) compute_masses(model);
    if (is_rotation(component))
        for (const Row b : bodies.blocks)
            if (blocks.body[b] != 0)
                throw Advised(
                    fmt::format("block {} is joined to others and cannot rotate separately", blocks.number[b]),
                    Advice::rotate_before_joining);
    each_body(
        model, bodies, component,
        [&](Row b) {
            if (blocks.fixed[b] & bit_of(component)) return;
            if (!is_rotation(component)) {
                blocks.velocity[b][component] = value;
                return;
            }
            blocks.rotational_velocity[b][component - 3] = value;
            blocks.angular_momentum[b] = inertia_now(model, b) * blocks.rotational_velocity[b];
        },
        [&](Row g) {
            if ((model.gridpoints.fixed[g] & bit_of(component)) == 0) model.gridpoints.velocity[g][component] = value;
        });
}

void initialize_displacement(Model& model, const Bodies& bodies, int axis, double value) {
    auto& points = model.gridpoints;
    each_body(
        model, bodies, axis,
        [&](Row b) {
            model.blocks.displacement[b][axis] = value;
            const Span span = model.blocks.gridpoints[b];
            for (Row g = span.first; g < span.end(); ++g) points.displacement[g][axis] = value;
        },
        [&](Row g) { points.displacement[g][axis] = value; });
}

void add_load(Model& model, const std::vector<Row>& gridpoints, int axis, double value, std::int32_t function) {
    LoadSums sums(model, function);
    for (const Row g : gridpoints) sums.at_gridpoint(g, axis, value);
    sums.finish();
}

void add_block_load(Model& model, const std::vector<Row>& rows, int component, double value, std::int32_t function) {
    LoadSums sums(model, function);
    for (const Row b : rows) sums.on_block(b, component, value);
    sums.finish();
}

void add_load_at(Model& model, Row block, const Vec3& place, const Vec3& force, std::int32_t function) {
    LoadSums sums(model, function);
    for (int axis = 0; axis < 3; ++axis)
        if (force[axis] != 0) sums.at_point(block, place, axis, force[axis]);
    sums.finish();
}

Stress StressField::at(const Vec3& place) const {
    Stress s = at_origin;
    for (int k = 0; k < 3; ++k) s += place[k] * gradient[k];
    return s;
}

namespace {

using Corners = std::vector<Vec3>;

Corners corners_of(const Model& model, const TriangleCorners& triangle) {
    Corners corners;
    for (const Row g : triangle) corners.push_back(model.gridpoints.position[g]);
    return corners;
}
Corners corners_of(const Model& model, Row triangle) { return corners_of(model, model.triangles.gridpoints[triangle]); }

/// Forces of the stress at the corners of a triangle. The traction varies linearly: consistent loads are (2 t_k + t_l + t_m) / 12 of the
/// area each.
std::array<Vec3, 3> corner_loads(const StressField& stress, const Corners& x, const Vec3& area) {
    std::array<Vec3, 3> force, load;
    for (std::size_t k = 0; k < 3; ++k) force[k] = matrix_of(stress.at(x[k])) * area;
    for (std::size_t k = 0; k < 3; ++k) load[k] = (2 * force[k] + force[(k + 1) % 3] + force[(k + 2) % 3]) / 12.0;
    return load;
}

Row block_of_triangle(const Model& model, Row triangle) { return model.faces.block[model.triangles.face[triangle]]; }

/// Calls part(triangle, corners of a part of it) for all parts of the given triangles that another block of the same rigid body covers:
/// they lie inside the body, where no contact shows it.
template <class Part> void inside_bodies(const Model& model, const std::vector<Row>& triangles, Part part) {
    const auto& blocks = model.blocks;
    std::set<std::int32_t> bodies;
    std::vector<char> loaded(model.triangles.size(), 0);
    for (const Row t : triangles) {
        const Row b = block_of_triangle(model, t);
        if (blocks.deformable[b] || blocks.body[b] == 0) continue;
        bodies.insert(blocks.body[b]);
        loaded[t] = 1;
    }
    if (bodies.empty()) return;
    const double opposite = -std::cos(std::numbers::pi / 180);
    std::vector<Row> rows;
    std::vector<Corners> corners;
    std::vector<Vec3> normals;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < model.triangles.size(); ++i) {
        const Row t = static_cast<Row>(i), b = block_of_triangle(model, t);
        if (blocks.deformable[b] || !bodies.contains(blocks.body[b])) continue;
        rows.push_back(t);
        const Corners& x = corners.emplace_back(corners_of(model, t));
        normals.push_back(area_vector(x).normalized());
        const Vec3 margin = Vec3::Constant(blocks.margin[b]);
        boxes.push_back({x[0].cwiseMin(x[1]).cwiseMin(x[2]) - margin, x[0].cwiseMax(x[1]).cwiseMax(x[2]) + margin});
    }
    const auto lies_on = [&](int i, int j) {
        if (!loaded[rows[i]]) return;
        const double near = std::min(blocks.margin[block_of_triangle(model, rows[i])],
                                     blocks.margin[block_of_triangle(model, rows[j])]);
        for (const Vec3& x : corners[j])
            if (std::abs(normals[i].dot(x - corners[i][0])) > near) return;
        const Corners common = common_part(corners[j], corners[i], normals[i]);
        // The other side has the opposite orientation.
        for (std::size_t k = 1; k + 1 < common.size(); ++k) part(rows[i], Corners{common[0], common[k + 1], common[k]});
    };
    for (const auto& [i, j] : overlapping_boxes(boxes)) {
        const Row a = block_of_triangle(model, rows[i]), b = block_of_triangle(model, rows[j]);
        if (a == b || blocks.body[a] != blocks.body[b] || normals[i].dot(normals[j]) > opposite) continue;
        lies_on(i, j);
        lies_on(j, i);
    }
}

} // namespace

double add_stress(Model& model, const std::vector<Row>& gridpoints, const StressField& stress, std::int32_t function) {
    return add_stress_on(model, exterior_triangles(model, gridpoints), stress, function);
}

double add_stress_on(Model& model, const std::vector<Row>& triangles, const StressField& stress,
                     std::int32_t function) {
    LoadSums sums(model, function);
    const CellFaces faces(model, tied_faces(model));
    const CoveredFaces covered(model, tied_face_pairs(model));
    double whole = 0, inside = 0;
    const auto take_off = [&](Row t, const Corners& x) {
        const Vec3 area = area_vector(x);
        inside += area.norm();
        const auto load = corner_loads(stress, x, area);
        if (const Row b = block_of_triangle(model, t); !model.blocks.deformable[b]) {
            sums.at_triangle(b, {{x[0], x[1], x[2]}, {-load[0], -load[1], -load[2]}});
            return;
        }
        const Corners corners = corners_of(model, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 weights = weights_in_triangle({corners[0], corners[1], corners[2]}, x[k]);
            for (int j = 0; j < 3; ++j)
                for (int axis = 0; axis < 3; ++axis)
                    sums.at_gridpoint(model.triangles.gridpoints[t][j], axis, -weights[j] * load[k][axis]);
        }
    };
    for (const Row t : triangles) {
        const Corners x = corners_of(model, t);
        const Vec3 area = area_vector(x);
        whole += area.norm();
        const auto parts = covered.parts(t);
        for (const auto& part : parts) take_off(t, {part.begin(), part.end()});
        if (const Row b = block_of_triangle(model, t); !model.blocks.deformable[b]) {
            sums.at_triangle(b, {{x[0], x[1], x[2]}, corner_loads(stress, x, area)});
            continue;
        }
        const Row partner = faces.partner(t);
        const bool both = parts.empty() && is_listed(triangles, partner) && covered.parts(partner).empty();
        faces.for_parts(t, both, [&](const SurfacePart& part) {
            const Corners of_part = corners_of(model, part.corners);
            const auto load = corner_loads(stress, of_part, part.share * area_vector(of_part));
            for (std::size_t k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis) sums.at_gridpoint(part.corners[k], axis, load[k][axis]);
        });
    }
    inside_bodies(model, triangles, take_off);
    sums.finish();
    return whole - inside > 1e-9 * whole ? whole - inside : 0;
}

void fix_blocks(Model& model, const std::vector<Row>& rows, std::uint8_t which) {
    for (int component = 0; component < components; ++component)
        if (which & bit_of(component)) prescribe_velocity(model, {rows, {}}, component, 0);
    for (const Row b : rows)
        if (model.blocks.fixed[b] == fix_all && model.blocks.rotational_velocity[b].isZero(0))
            model.blocks.angular_momentum[b] = Vec3::Zero();
}

void free_blocks(Model& model, const std::vector<Row>& rows, std::uint8_t which) {
    for (int component = 0; component < components; ++component)
        if (which & bit_of(component)) release_velocity(model, {rows, {}}, component);
}

} // namespace kaya
