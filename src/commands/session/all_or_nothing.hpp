// Commands that search for contacts, or change many things one by one, before they know whether they can succeed.
#pragma once

#include "commands/session/session.hpp"
#include "system/memory.hpp"

#include <optional>

namespace kaya {

/// Runs the work of a command; if it throws, the model is restored bit by bit. Costs a copy of the model, so it is not for commands that
/// decks give thousands of times. Inside a cycle the work runs directly: rows do not change there.
template <class Work> void all_or_nothing(Session& session, Work work) {
    if (session.inside_cycle) return work();
    std::optional<Model> before = session.model;
    try {
        work();
    } catch (...) {
        session.model = std::move(*before);
        ModelEdit(session.model, Change::lists); // derived data of the cycle belong to the discarded model
        session.make_cycle();
        throw;
    }
    before.reset();
    constexpr std::size_t large = 10'000; // blocks: then it is worth the time
    if (session.model.blocks.size() > large) give_back_memory();
}

} // namespace kaya
