// The whole session as a file: the model, scripts, named ranges and the texts of its decks.
#pragma once

#include "io/save.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace kaya {

class Session;

/// What `save` adds to a name without an ending.
inline constexpr std::string_view save_ending = ".kaya.h5";

/// The part of a save file, besides those of the session, that says in words what it is; `kaya info` shows it.
inline constexpr std::string_view part_remark = remark_item;

/// What stands besides the model.
SaveExtras session_extras(Session& session);

/// Digest of what scripts and named ranges of the session hold; 0 when there are none. Where in which deck they stand does not count.
std::uint64_t script_hash(Session& session);

/// Writes it whole or not at all. Throws Diagnostic (Fault::run).
void save_session(Session& session, const std::string& file);

/// What `save` does: with forces as the next cycle will have them, and under a name with an ending.
void save_as(Session& session, const std::string& name);

} // namespace kaya
