#include "commands/make/overlaps.hpp"

#include "commands/session/session.hpp"

#include <fmt/format.h>
#include <string>

namespace kaya {

void warn_of_overlaps(Session& session, Row first, const Place& place) {
    static const std::string once = "two blocks in one place";
    if (session.program.said_once.contains(once)) return;
    const Model& model = session.engine.model;
    for (Row row = first; row < static_cast<Row>(model.blocks.size()); ++row) {
        if (session.is_to_stop()) return; // the blocks are made: the run stops after this command
        const Row other = session.engine.occupied.overlapped_by(model, row);
        if (other == no_row) continue;
        session.program.said_once.insert(once);
        return session.warn(
            Diagnostic(fmt::format("block {} is in the place of block {}", model.blocks.number[row],
                                   model.blocks.number[other]),
                       "the overlap carries no force; reported once, `list blocks quality` shows all such pairs")
                .at(place));
    }
}

} // namespace kaya
