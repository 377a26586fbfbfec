#include "commands/session/bodies.hpp"

#include "commands/session/handlers.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace kaya {

Bodies pick_bodies(Session& session, const lang::RangePhrase& range) {
    const auto& model = session.engine.model;
    Bodies bodies;
    for (const Row b : select(model, ObjectKind::block, session.test_of(ObjectKind::block, range)))
        if (!model.blocks.deformable[b]) bodies.blocks.push_back(b);
    const auto points = select(model, ObjectKind::gridpoint, session.test_of(ObjectKind::gridpoint, range));
    for (const Row g : points)
        if (model.blocks.deformable[model.gridpoints.block[g]]) bodies.gridpoints.push_back(g);
    if (!bodies.empty()) return bodies;
    if (points.empty()) session.pick(ObjectKind::gridpoint, range); // says why
    else
        session.warn(
            Diagnostic(fmt::format("the range holds {} vertices of rigid blocks but no centroid of one", points.size()),
                       "rigid blocks move as a whole and are picked by their centroid: the command has no "
                       "effect")
                .at(range.place));
    return bodies;
}

void check_rotation(const Model& model, const Bodies& bodies, const std::array<std::optional<double>, 6>& velocity,
                    const Place& place) {
    const std::span along = std::span(velocity).first<3>(), about = std::span(velocity).last<3>();
    const auto given = [](const std::optional<double>& value) { return value.has_value(); };
    const auto moves = [](const std::optional<double>& value) { return value.value_or(0) != 0; };
    if (std::ranges::none_of(about, given)) return;
    if (std::ranges::none_of(velocity, moves) && std::ranges::all_of(along, given)) return;
    const auto is_rigid = [&](Row block) { return !model.blocks.deformable[block]; };
    if (bodies.empty() || std::ranges::any_of(bodies.blocks, is_rigid)) return;
    throw Diagnostic("all that is in range has zones, and gridpoints of zones have no rotation",
                     "give them velocities (xvel, yvel, zvel), or leave the blocks without zones")
        .at(place);
}

} // namespace kaya
