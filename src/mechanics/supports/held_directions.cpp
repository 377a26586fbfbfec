#include "mechanics/supports/held_directions.hpp"

#include "model/measure/roller.hpp"

namespace kaya {

namespace {

/// Directions that differ by less are equal.
constexpr double parallel = 1e-3;

/// Calls visit(row of a roller) for every gridpoint of the bodies.
template <class Visit> void each_roller(Model& model, const Bodies& bodies, Visit visit) {
    const auto& blocks = model.blocks;
    for (const Row b : bodies.blocks)
        for (Row g = blocks.gridpoints[b].first; g < blocks.gridpoints[b].end(); ++g) visit(model.gridpoints.roller[g]);
    for (const Row g : bodies.gridpoints) visit(model.gridpoints.roller[g]);
    ModelEdit(model, Change::properties);
}

/// Bodies move along their directions from the next step on.
void give_velocities(Model& model, const Bodies& bodies) {
    const auto& blocks = model.blocks;
    auto& points = model.gridpoints;
    const auto give = [&](Row g, std::uint8_t fixed, Vec3& velocity) {
        const Roller& roller = model.rollers[static_cast<std::size_t>(points.roller[g])];
        velocity += roller_change(roller, velocity, fixed, roller.speed);
    };
    for (const Row b : bodies.blocks) {
        const Span span = blocks.gridpoints[b];
        if (!blocks.deformable[b]) give(span.first, blocks.fixed[b], model.blocks.velocity[b]);
        else
            for (Row g = span.first; g < span.end(); ++g) give(g, points.fixed[g], points.velocity[g]);
    }
    for (const Row g : bodies.gridpoints) give(g, points.fixed[g], points.velocity[g]);
}

} // namespace

void add_direction(Roller& roller, Vec3 direction, double speed) {
    if (roller.count == 3) return;
    for (std::int32_t k = 0; k < roller.count; ++k) {
        const Vec3& known = roller.direction[static_cast<std::size_t>(k)];
        const double along = direction.dot(known);
        direction -= along * known;
        speed -= along * roller.speed[k];
    }
    const double length = direction.norm();
    if (length < parallel) return;
    roller.direction[static_cast<std::size_t>(roller.count)] = direction / length;
    roller.speed[roller.count] = speed / length;
    ++roller.count;
}

void add_directions(Roller& roller, const Roller& other) {
    for (std::int32_t k = 0; k < other.count; ++k)
        add_direction(roller, other.direction[static_cast<std::size_t>(k)], other.speed[k]);
}

RollerRows::RollerRows(Model& model) : rollers_(model.rollers) {
    for (std::size_t i = 0; i < rollers_.size(); ++i) rows_.emplace(key(rollers_[i]), static_cast<std::int32_t>(i));
}

std::int32_t RollerRows::row(const Roller& roller) {
    const auto [at, fresh] = rows_.emplace(key(roller), static_cast<std::int32_t>(rollers_.size()));
    if (fresh) rollers_.push_back(roller);
    return at->second;
}

RollerRows::Key RollerRows::key(const Roller& roller) {
    Key numbers{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis)
            numbers[3 * k + static_cast<std::size_t>(axis)] = roller.direction[k][axis];
        numbers[9 + k] = roller.speed[static_cast<Eigen::Index>(k)];
    }
    return numbers;
}

void hold_direction(Model& model, const Bodies& bodies, const Vec3& direction, double speed) {
    RollerRows rows(model);
    each_roller(model, bodies, [&](std::int32_t& row) {
        Roller held;
        add_direction(held, direction.normalized(), speed);
        add_directions(held, model.rollers[static_cast<std::size_t>(row)]);
        row = rows.row(held);
    });
    give_velocities(model, bodies);
}

void free_directions(Model& model, const Bodies& bodies) {
    each_roller(model, bodies, [](std::int32_t& row) { row = 0; });
}

Roller roller_of_body(const Model& model, std::span<const Row> members) {
    Roller held;
    if (model.rollers.size() > 1)
        for (const Row b : members) add_directions(held, roller_of(model, b));
    return held;
}

} // namespace kaya
