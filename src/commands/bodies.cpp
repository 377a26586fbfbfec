#include "commands/bodies.hpp"

#include "commands/handlers.hpp"

#include <fmt/format.h>

namespace kaya {

Bodies pick_bodies(Session& session, const lang::RangePhrase& range) {
    const auto& model = session.model;
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

} // namespace kaya
