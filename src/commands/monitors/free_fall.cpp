#include "commands/monitors/free_fall.hpp"

#include "commands/monitors/rest_monitor.hpp"
#include "model/measure/block_box.hpp"
#include "model/measure/held.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace kaya {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Blocks that move as one, seen along gravity.
struct FallingBody {
    std::vector<Row> blocks;
    double nearest = infinity, farthest = -infinity; ///< of its points along gravity
    double pull = 0;                                 ///< mass, and loads over gravity
    Vec3 force = Vec3::Zero();                       ///< of contacts and structures
    bool held = false, sinks = true;

    bool falls() const {
        constexpr double none = 1e-6; // of the weight: rounding of zones
        return !held && sinks && pull > 0 && force.norm() <= none * pull;
    }
};

/// Whether a velocity or a load that the deck prescribes acts along gravity.
bool is_prescribed(const Model& model, Row b, const Vec3& down) {
    const auto along = [&](std::uint8_t fixed) {
        for (int k = 0; k < 3; ++k)
            if ((fixed & (1 << k)) && down[k] != 0) return true;
        return false;
    };
    if (along(model.blocks.fixed[b])) return true;
    const Span span = model.blocks.gridpoints[b];
    for (Row g = span.first; g < span.end(); ++g)
        if (model.gridpoints.roller[g] != 0 || (model.blocks.deformable[b] && along(model.gridpoints.fixed[g])))
            return true;
    const auto& histories = model.boundary_histories;
    return std::ranges::find(histories.block, model.blocks.id[b]) != histories.block.end();
}

std::vector<FallingBody> bodies_of(const Model& model, const Vec3& down, double gravity) {
    const auto& blocks = model.blocks;
    std::vector<FallingBody> bodies;
    std::map<std::int32_t, std::size_t> joined;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Row b = static_cast<Row>(i);
        std::size_t place = bodies.size();
        if (blocks.body[b] != 0) place = joined.try_emplace(blocks.body[b], place).first->second;
        if (place == bodies.size()) bodies.emplace_back();
        FallingBody& body = bodies[place];
        body.blocks.push_back(b);
        const Span span = blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g) {
            const double at = down.dot(model.gridpoints.position[g]);
            body.nearest = std::min(body.nearest, at);
            body.farthest = std::max(body.farthest, at);
        }
        body.pull += blocks.mass[b] * gravity + down.dot(block_load(model, b));
        body.force += block_force(model, b);
        body.sinks = body.sinks && down.dot(block_velocity(model, b)) > 0;
        body.held = body.held || is_prescribed(model, b, down);
    }
    return bodies;
}

/// Sums of the unbalanced forces of blocks.
struct Unbalanced {
    double sum = 0, largest = 0;

    void add(const Vec3& force, std::uint8_t fixed) {
        const double size = free_part(force, fixed).norm();
        sum += size;
        largest = std::max(largest, size);
    }
    void add_block(const Model& model, Row b) {
        const auto& blocks = model.blocks;
        const auto& points = model.gridpoints;
        if (!blocks.deformable[b]) return add(unbalanced_force(model, b), blocks.fixed[b]);
        for (Row p = blocks.gridpoints[b].first; p < blocks.gridpoints[b].end(); ++p)
            add(unbalanced_at_gridpoint(model, p), points.fixed[p]);
    }
};

} // namespace

std::optional<FreeFall> free_fall(const Model& model) {
    const double gravity = model.settings.gravity.norm();
    if (!(gravity > 0)) return std::nullopt;
    const Vec3 down = model.settings.gravity / gravity;
    const std::vector<FallingBody> bodies = bodies_of(model, down, gravity);
    double last = -infinity; // of what does not fall
    for (const FallingBody& body : bodies)
        if (!body.falls()) last = std::max(last, body.farthest);
    FreeFall found;
    Unbalanced rest;
    double acting = 0;
    const std::vector<double> forces = acting_forces(model);
    for (const FallingBody& body : bodies) {
        if (body.falls() && body.nearest > last) {
            found.blocks.insert(found.blocks.end(), body.blocks.begin(), body.blocks.end());
            continue;
        }
        for (const Row b : body.blocks) {
            if (is_held(model, b)) continue;
            acting += forces[b];
            rest.add_block(model, b);
        }
    }
    if (found.blocks.empty()) return std::nullopt;
    found.ratio = acting > 0 ? rest.sum / acting : 0;
    found.force = rest.largest;
    return found;
}

std::vector<Row> blocks_that_left(const Model& model) {
    const auto box_of = [&](Row b) {
        const auto [low, high] = block_box(model, b);
        return Eigen::AlignedBox3d(low, high);
    };
    std::vector<Row> alone;
    Eigen::AlignedBox3d others;
    const double none = 1e-6; // of the weight, or of the inertia of a unit acceleration
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) {
        const double scale = model.blocks.mass[b] * std::max(model.settings.gravity.norm(), 1e-3);
        const bool free = !is_held(model, b) && block_force(model, b).norm() <= none * scale;
        if (free) alone.push_back(b);
        else others.extend(box_of(b));
    }
    if (others.isEmpty()) return {};
    const double far = others.diagonal().norm();
    std::erase_if(alone, [&](Row b) {
        const double distance = others.exteriorDistance(box_of(b));
        // Some are far from the beginning.
        return distance <= far || block_displacement(model, b).norm() < 0.5 * distance;
    });
    return alone;
}

} // namespace kaya
