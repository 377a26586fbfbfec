// Texts of commands that are valid and cannot be meant: the check of a deck and the run report them in the same words.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/commands/commands.hpp"

#include <any>
#include <string>
#include <vector>

namespace kaya {

Diagnostic implausible(std::string message, std::string hint);

/// Planes that dip by less than 0 or more than 90 degrees, directions beyond a full turn, angles that look like radians.
std::vector<Diagnostic> doubts_of(const lang::JointSetCommand& command);
/// Stresses in the ground that pull in all directions.
std::vector<Diagnostic> doubts_of(const lang::InSitu& command);
/// Damping that removes all force from moving bodies.
std::vector<Diagnostic> doubts_of(const lang::Damp& command);
/// A limit that is met before the first cycle.
std::vector<Diagnostic> doubts_of(const lang::Solve& command);
/// A history for a spreadsheet's own format.
std::vector<Diagnostic> doubts_of(const lang::HistoryWrite& command);
/// An angle of friction that looks like radians.
Diagnostic radian_doubt(const lang::Property::Item& item);
bool may_be_radians(const lang::Property::Item& item);

/// Those of a command whose kind is known when it is read; friction by its classic words.
std::vector<Diagnostic> text_doubts(const std::any& command);

} // namespace kaya
