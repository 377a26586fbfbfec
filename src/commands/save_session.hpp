// The whole session as a file: the model, scripts, named ranges and the texts of its decks.
#pragma once

#include "io/save.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace kaya {

class Session;

/// The suffix that `save` adds to a name.
inline constexpr std::string_view save_ending = ".kaya.h5";

/// The name of the file of `save NAME` and `restore NAME`.
std::string save_name(const std::string& name);

/// The part of a save file with a remark in words; `kaya info` shows it.
inline constexpr std::string_view part_remark = remark_item;

/// The parts of a save file beyond the model.
SaveExtras session_extras(Session& session);

/// Digest of scripts and named ranges of the session; 0 when there are none. Their place in the decks does not count.
std::uint64_t script_hash(Session& session);

/// Writes it whole or not at all. Throws Diagnostic (Fault::run).
void save_session(Session& session, const std::string& file);

/// Runs `save`: with the forces of the next cycle, and under a name with a suffix.
void save_as(Session& session, const std::string& name);

} // namespace kaya
