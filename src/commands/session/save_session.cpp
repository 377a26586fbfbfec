#include "commands/session/save_session.hpp"

#include "base/hash.hpp"
#include "commands/session/joint_files.hpp"
#include "commands/session/save_parts.hpp"
#include "commands/ranges/saved_ranges.hpp"
#include "commands/session/session.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

SaveExtras session_extras(Session& session) {
    SaveExtras extras;
    extras.program_version = program_version();
    extras.title = session.deck.title;
    extras.scripts.push_back({std::string(part_scripts), script::to_bytes(session.engine.scripts->state())});
    extras.scripts.push_back({std::string(part_ranges), ranges_text(session.deck.ranges)});
    keep_units(extras, session.deck.units);
    if (const auto files = joint_files(session); !files.empty())
        extras.scripts.push_back({std::string(part_joints), joint_files_text(files)});
    if (!session.deck.surface_sets.empty())
        extras.scripts.push_back({std::string(part_surfaces), surfaces_text(session.deck.surface_sets)});
    for (const auto& source : session.deck.sources)
        extras.decks.push_back({source->name, fmt::format("{}\n", fmt::join(source->lines, "\n"))});
    return extras;
}

std::uint64_t script_hash(Session& session) {
    script::ScriptState state = session.engine.scripts->state();
    if (state.fish_globals.empty() && state.lua_globals.empty() && state.extras.empty() && state.sources.empty() &&
        state.hooks.empty() && state.tables.empty() && session.deck.ranges.empty() && session.deck.surface_sets.empty())
        return 0;
    for (auto& source : state.sources) {
        source.name.clear();
        source.line = 1;
    }
    Hash hash;
    hash.add(script::to_bytes(state));
    hash.add(ranges_text(session.deck.ranges));
    if (!session.deck.surface_sets.empty()) hash.add(surfaces_text(session.deck.surface_sets));
    return hash.value();
}

void save_session(Session& session, const std::string& file) {
    session.engine.cycle->bring_up_to_date();
    save_state(session.engine.model, session.program.output_file(file), session_extras(session));
}

} // namespace kaya
