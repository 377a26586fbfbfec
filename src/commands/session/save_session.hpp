// The whole session as a file: the model, scripts, named ranges and the texts of its decks.
#pragma once

#include "commands/review/save_name.hpp"
#include "io/save.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace kaya {

class Session;

/// The part of a save file with a remark in words; `kaya info` shows it.
inline constexpr std::string_view part_remark = remark_item;

/// The parts of a save file beyond the model.
SaveExtras session_extras(Session& session);

/// Digest of scripts and named ranges of the session; 0 when there are none. Their place in the decks does not count.
std::uint64_t script_hash(Session& session);

/// Writes it whole or not at all. Throws Diagnostic (Fault::run).
void save_session(Session& session, const std::string& file);

} // namespace kaya
