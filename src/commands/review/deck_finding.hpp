// What reading a deck finds before any of it runs.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/commands/commands.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace kaya {

using CyclingCommands = lang::CommandList<lang::CycleCommand, lang::Solve, lang::SolveControl>;

/// Code of findings that the run reports as well when it reaches their line.
inline constexpr std::string_view said_by_the_run = "no-effect";

inline Diagnostic finding(std::string message, std::string hint, std::string_view code, Severity severity) {
    Diagnostic d(std::move(message), std::move(hint));
    d.severity = severity;
    d.code = code;
    return d;
}

} // namespace kaya
