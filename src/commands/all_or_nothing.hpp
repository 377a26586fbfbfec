// Commands that look for contacts, or change many things one by one, before they know whether they can be done.
#pragma once

#include "base/memory.hpp"
#include "commands/session.hpp"

#include <optional>

namespace kaya {

/// Does the work of a command; when it is refused the model is as it was, bit by bit. Costs a copy of the model, so it is not
/// for what decks do thousands of times. Inside of a cycle the work is done as it is: rows do not change there.
template <class Work> void all_or_nothing(Session& session, Work work) {
    if (session.inside_cycle) return work();
    std::optional<Model> before = session.model;
    try {
        work();
    } catch (...) {
        session.model = std::move(*before);
        ModelEdit(session.model, Change::lists); // what the cycle has derived is of the model that is gone
        session.make_cycle();
        throw;
    }
    before.reset();
    constexpr std::size_t large = 10'000; // blocks: then it is worth the time
    if (session.model.blocks.size() > large) give_back_memory();
}

} // namespace kaya
