#include "commands/last_good.hpp"

#include "base/memory.hpp"
#include "commands/save_session.hpp"
#include "commands/session.hpp"

#include <algorithm>
#include <new>

namespace kaya {

namespace {

/// Of the time that copies may take.
constexpr int part_of_time = 100;

std::size_t bytes_of(Model& model) {
    std::size_t bytes = 0;
    model.tables([&](const char*, auto& table) {
        table.columns(
            [&](const std::string&, const auto& column, Role) { bytes += column.size() * sizeof(column[0]); });
    });
    return bytes;
}

/// Whether scripts of the deck act inside of cycles: they may print, write files or keep what no copy knows.
bool scripts_act(const Session& session) {
    using enum script::Moment;
    for (const auto moment : {before_cycle, after_forces, after_cycle})
        if (session.scripts->has_hooks(moment)) return true;
    const Model& model = session.model;
    return std::ranges::any_of(model.time_functions,
                               [](const TimeFunction& f) { return f.kind == TimeFunction::Kind::script; }) ||
           std::ranges::any_of(model.histories.all,
                               [](const History& h) { return h.source.kind == HistorySource::Kind::function; });
}

} // namespace

void LastGood::offer(Session& session) {
    if (!taken_ || Clock::now() - when_ >= part_of_time * cost_) take(session);
}

void LastGood::take(Session& session) {
    if (no_memory_) return;
    const auto begin = Clock::now();
    try {
        // A copy that there is not room for besides the model would make the machine slow, or end the run.
        if (!taken_ && memory_available() < 2 * bytes_of(session.model)) throw std::bad_alloc();
        taken_ = false; // half a copy is none
        model_ = session.model;
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
    if (!leads_here_ || scripts_act(session)) return;
    ModelEdit(model_, Change::lists); // what a cycle derives from the tables is not in the copy
    Cycle cycles(model_, session.joints);
    cycles.hooks.table_value = session.cycle->hooks.table_value;
    while (model_.clock.cycle < cycle && !session.is_to_stop()) cycles.advance();
}

void LastGood::write(const std::string& file, const std::string& remark) {
    SaveExtras extras = extras_;
    extras.scripts.push_back({std::string(part_remark), remark});
    save_state(model_, file, extras);
}

} // namespace kaya
