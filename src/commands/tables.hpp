// Numbered tables, and what a history of a boundary condition needs of them.
#pragma once

#include "commands/session.hpp"

#include <cstdint>
#include <string>

namespace kaya {

/// Throws Diagnostic when the table is not there, holds no pair, or its x go back.
void check_table(Session& session, std::int64_t number);

/// Throws Diagnostic when there is no FISH variable or function of that name.
void check_symbol(Session& session, const std::string& name);

/// Looks again at the tables and functions of all loads and velocities that change with time, before a run.
void check_time_functions(Session& session);

} // namespace kaya
