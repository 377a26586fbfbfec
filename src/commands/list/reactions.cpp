#include "commands/list/reactions.hpp"

#include "mechanics/supports/held_directions.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/held.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/roller.hpp"

#include <map>
#include <numeric>

namespace kaya {
namespace {

/// What holds a body.
struct Hold {
    std::uint8_t fixed = 0;
    Roller roller;

    bool any() const { return (fixed & 7) != 0 || roller.count != 0; }
    /// The force that holds against a sum of forces.
    Vec3 against(const Vec3& force) const {
        Vec3 free = free_part(force, fixed);
        if (roller.count != 0) free += roller_change(roller, free, fixed, Vec3::Zero());
        return free - force;
    }
};

Hold hold_of(const Model& model, std::span<const Row> members) {
    Hold hold{0, members.size() == 1 ? roller_of(model, members.front()) : roller_of_body(model, members)};
    for (const Row b : members) hold.fixed |= model.blocks.fixed[b];
    return hold;
}

Hold hold_of_gridpoint(const Model& model, Row g) {
    return {model.gridpoints.fixed[g], model.rollers[static_cast<std::size_t>(model.gridpoints.roller[g])]};
}

class Sum {
public:
    Sum(const Model& model, const std::function<bool(Row)>& picked) : model_(model), picked_(picked) {}

    /// A rigid block, or joined ones.
    void add_rigid(std::span<const Row> members) {
        const auto& blocks = model_.blocks;
        Vec3 weight = Vec3::Zero(), load = Vec3::Zero();
        for (const Row b : members) {
            weight += blocks.mass[b] * model_.settings.gravity;
            load += blocks.load[b];
        }
        add_body(weight, load);
        if (hold_of(model_, members).any()) add_held(members.front(), reaction_on(model_, members), weight);
    }

    void add_zoned(Row block) {
        const auto& points = model_.gridpoints;
        Vec3 weight = Vec3::Zero(), load = Vec3::Zero(), reaction = Vec3::Zero();
        bool held = false;
        const Span span = model_.blocks.gridpoints[block];
        for (Row g = span.first; g < span.end(); ++g) {
            weight += points.mass[g] * model_.settings.gravity;
            load += points.load[g];
            if (!hold_of_gridpoint(model_, g).any()) continue;
            held = true;
            reaction += reaction_on_gridpoint(model_, g);
        }
        add_body(weight, load);
        if (held) add_held(block, reaction, weight);
    }

    /// Beams and liners: all that holds them is rock.
    void add_structures() {
        for (const double mass : model_.structures.member_nodes.mass)
            add_body(mass * model_.settings.gravity, Vec3::Zero());
    }

    Reactions result() {
        for (auto& [group, reaction] : groups_) result_.groups.push_back(reaction);
        result_.unbalanced = result_.reaction + result_.weight + result_.load;
        return std::move(result_);
    }

private:
    void add_body(const Vec3& weight, const Vec3& load) {
        result_.weight += weight;
        result_.load += load;
    }
    void add_held(Row block, const Vec3& force, const Vec3& weight) {
        result_.reaction += force;
        if (!picked_(block)) return;
        const std::int32_t group = default_group_number(model_, model_.blocks.group[block]);
        Reaction& reaction = groups_[group];
        reaction.group = group;
        ++reaction.held;
        reaction.force += force;
        reaction.weight += weight;
    }

    const Model& model_;
    const std::function<bool(Row)>& picked_;
    std::map<std::int32_t, Reaction> groups_;
    Reactions result_;
};

} // namespace

Vec3 reaction_on(const Model& model, std::span<const Row> members) {
    Vec3 force = Vec3::Zero();
    for (const Row b : members) force += unbalanced_force(model, b);
    return hold_of(model, members).against(force);
}

Vec3 reaction_on_gridpoint(const Model& model, Row g) {
    return hold_of_gridpoint(model, g).against(unbalanced_at_gridpoint(model, g));
}

Reactions reactions_of(const Model& model, const std::function<bool(Row)>& picked) {
    Sum sum(model, picked);
    const JoinedBodies bodies = joined_bodies(model);
    std::vector<char> in_body(model.blocks.size(), 0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        sum.add_rigid(bodies.members(i));
        for (const Row b : bodies.members(i)) in_body[b] = 1;
    }
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) {
        if (model.blocks.deformable[b]) sum.add_zoned(b);
        else if (!in_body[b]) sum.add_rigid({&b, 1});
    }
    sum.add_structures();
    return sum.result();
}

} // namespace kaya
