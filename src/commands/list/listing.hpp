// Tables that `list` shows, each made by one function.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"

#include <string>

namespace kaya {

/// Output of `list blocks`, ... A long table ends after `longest_table` rows with a note.
inline constexpr std::size_t longest_table = 100;

std::string list_blocks(Session&, const lang::List&);
std::string list_excavated(Session&, const lang::List&);
std::string list_block_quality(Session&, const lang::List&);
std::string list_gridpoints(Session&, const lang::List&);
std::string list_zones(Session&, const lang::List&);
std::string list_stability(Session&, const lang::List&);
std::string list_structures(Session&, const lang::List&);
std::string list_faces(Session&, const lang::List&);
std::string list_stresses(Session&, const lang::List&);
std::string list_contacts(Session&, const lang::List&);
std::string list_sub_contacts(Session&, const lang::List&);
std::string list_interfaces(Session&, const lang::List&);
std::string list_reactions(Session&, const lang::List&);

std::string list_states(Session&, const lang::List&);
std::string list_joint_sets(Session&, const lang::List&);

std::string list_properties(Session&, const lang::List&);
std::string list_joint_models(Session&, const lang::List&);
std::string list_histories(Session&, const lang::List&);
std::string list_time(Session&, const lang::List&);
std::string list_unbalanced(Session&, const lang::List&);
std::string list_damping(Session&, const lang::List&);
std::string list_information(Session&, const lang::List&);
std::string list_time_step(Session&, const lang::List&);
std::string list_extremes(Session&, const lang::List&);
std::string list_energy(Session&, const lang::List&);
std::string list_timing(Session&, const lang::List&);
std::string list_hash(Session&, const lang::List&);
std::string list_ranges(Session&, const lang::List&);
std::string list_tables(Session&, const lang::List&);
std::string list_symbols(Session&, const lang::List&);
std::string list_groups(Session&, const lang::List&);
std::string list_settings(Session&, const lang::List&);
std::string list_memory(Session&, const lang::List&);
std::string list_version(Session&, const lang::List&);
std::string list_modes(Session&, const lang::List&);
std::string list_frequencies(Session&, const lang::List&);
std::string list_boundary(Session&, const lang::List&);

} // namespace kaya
