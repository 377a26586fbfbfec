// Whether a script may write files that a later line of the deck reads.
#pragma once

#include "lang/interp/binder.hpp"

#include <string_view>

namespace kaya::lang {

/// Searches for the words with which FISH, Lua and their commands write files.
bool may_write_files(std::string_view script);

/// Of a command that is a script: a function, a chunk of Lua.
bool may_write_files(const BoundCommand& command);

} // namespace kaya::lang
