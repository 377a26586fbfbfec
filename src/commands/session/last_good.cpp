#include "commands/session/last_good.hpp"

#include "commands/session/save_session.hpp"
#include "commands/session/session.hpp"
#include "system/memory.hpp"

#include <algorithm>
#include <new>

namespace kaya {

namespace {

/// Copies may take this part of the time (1 in 100).
constexpr int part_of_time = 100;

std::size_t bytes_of(Model& model) {
    std::size_t bytes = 0;
    model.tables([&](const char*, auto& table) {
        table.columns(
            [&](const std::string&, const auto& column, Role) { bytes += column.size() * sizeof(column[0]); });
    });
    return bytes;
}

} // namespace

void LastGood::offer(Session& session, Clock::duration always) {
    if (!taken_ || cost_ <= always || Clock::now() - when_ >= part_of_time * cost_) take(session);
}

void LastGood::take(Session& session) {
    if (no_memory_) return;
    const auto begin = Clock::now();
    try {
        // Without memory for a copy the machine would slow down, or the run would end.
        if (!taken_ && memory_available() < 2 * bytes_of(session.engine.model)) throw std::bad_alloc();
        taken_ = false; // half a copy is none
        session.engine.cycle->bring_up_to_date();
        model_ = session.engine.model;
        extras_ = session_extras(session);
    } catch (const std::bad_alloc&) {
        drop();
        no_memory_ = true;
        return;
    }
    taken_ = leads_here_ = true;
    when_ = Clock::now();
    cost_ = when_ - begin;
}

void LastGood::drop() {
    if (!taken_) return;
    model_ = Model{};
    extras_ = SaveExtras{};
    taken_ = leads_here_ = false;
}

void LastGood::run_on(Session& session, std::int64_t cycle) {
    if (!leads_here_ || session.scripts_act_in_cycles()) return;
    ModelEdit(model_, Change::lists); // derived data of the cycle is not in the copy
    Cycle cycles(model_, session.engine.joints);
    cycles.hooks.table_value = session.engine.cycle->hooks.table_value;
    while (model_.clock.cycle < cycle && !session.is_to_stop()) cycles.advance();
}

void LastGood::write(const std::string& file, const std::string& remark) {
    SaveExtras extras = extras_;
    extras.scripts.push_back({std::string(part_remark), remark});
    save_state(model_, file, extras);
}

} // namespace kaya
