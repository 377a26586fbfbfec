// Numbered tables, and tables for histories of boundary conditions.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"

#include <cstdint>
#include <string>

namespace kaya {

/// The number of a table. Throws Diagnostic for a name that no table has.
std::int64_t table_number(Session& session, const lang::TableValue& value);

/// Throws Diagnostic when the table does not exist, is empty, or its x decrease.
void check_table(Session& session, std::int64_t number);

/// Throws Diagnostic when no FISH variable or function has that name.
void check_symbol(Session& session, const std::string& name);

/// Warns once of a FISH function that never sets its name: what takes its value takes 0.
void warn_of_no_value(Session& session, const std::string& function, const Place& place);

/// Checks the tables and functions of all time-dependent loads and velocities again, before a run.
void check_time_functions(Session& session);

} // namespace kaya
