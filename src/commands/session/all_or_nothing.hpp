// Commands that search for contacts, or change many things one by one, before they know whether they can succeed.
#pragma once

#include "commands/session/session.hpp"
#include "system/memory.hpp"

#include <optional>

namespace kaya {

/// Runs the work of a command; if it throws, the model is restored bit by bit. Costs a copy of the model, so it is not for commands that
/// decks give thousands of times. Inside a cycle the work runs directly: rows do not change there.
template <class Work> void all_or_nothing(Session& session, Work work) {
    if (session.engine.inside_cycle) return work();
    std::optional<Model> before = session.engine.model;
    try {
        work();
    } catch (...) {
        session.engine.model = std::move(*before);
        ModelEdit(session.engine.model, Change::lists); // derived data of the cycle belong to the discarded model
        session.engine.make_cycle();
        throw;
    }
    before.reset();
    constexpr std::size_t large = 10'000; // blocks: then it is worth the time
    if (session.engine.model.blocks.size() > large) give_back_memory();
}

} // namespace kaya
