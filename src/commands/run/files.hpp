// The command `save`, for other commands.
#pragma once

#include <string>

namespace kaya {

class Session;

/// Runs `save`: with the forces of the next cycle, and under a name with a suffix.
void save_as(Session& session, const std::string& name);

} // namespace kaya
