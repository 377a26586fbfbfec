// list, print: one row per list.
#include "commands/list/listing.hpp"
#include "commands/session/handlers.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace kaya {

namespace {

using What = lang::List::What;

struct ListRow {
    What what;
    std::string (*text)(Session&, const lang::List&);
};

/// In the order of What, whose last value is the last row.
constexpr ListRow list_rows[] = {
    {What::blocks, list_blocks},
    {What::quality, list_block_quality},
    {What::contacts, list_contacts},
    {What::sub_contacts, list_sub_contacts},
    {What::interfaces, list_interfaces},
    {What::reactions, list_reactions},
    {What::gridpoints, list_gridpoints},
    {What::zones, list_zones},
    {What::faces, list_faces},
    {What::properties, list_properties},
    {What::histories, list_histories},
    {What::extremes, list_extremes},
    {What::time, list_time},
    {What::unbalanced, list_unbalanced},
    {What::damping, list_damping},
    {What::information, list_information},
    {What::time_step, list_time_step},
    {What::timing, list_timing},
    {What::energy, list_energy},
    {What::hash, list_hash},
    {What::joint_models, list_joint_models},
    {What::boundary, list_boundary},
    {What::groups, list_groups},
    {What::excavated, list_excavated},
    {What::states, list_states},
    {What::stresses, list_stresses},
    {What::stability, list_stability},
    {What::structures, list_structures},
    {What::joint_sets, list_joint_sets},
    {What::memory, list_memory},
    {What::version, list_version},
    {What::modes, list_modes},
    {What::settings, list_settings},
    {What::tables, list_tables},
    {What::ranges, list_ranges},
    {What::frequencies, list_frequencies},
    {What::symbols, list_symbols},
};

constexpr bool in_order() {
    for (std::size_t i = 0; i < std::size(list_rows); ++i)
        if (list_rows[i].what != static_cast<What>(i)) return false;
    return true;
}
static_assert(in_order() && list_rows[std::size(list_rows) - 1].what == What::symbols);

} // namespace

void run(Session& session, const lang::List& command) {
    for (const auto& symbol : command.symbols)
        session.program.output.print(fmt::format("{} = {}", symbol, session.symbol_text(symbol)));
    if (command.what)
        session.program.output.print(list_rows[static_cast<std::size_t>(*command.what)].text(session, command));
}

void add_handlers(HandlerTable& table, lang::ListCommands list) { fill(table, list); }

} // namespace kaya
