// Lua text of the user: chunks of a deck, files, modules.
#pragma once

#include "base/diagnostic.hpp"

#include <filesystem>
#include <string>

namespace kaya::script {

struct Machine;

/// Runs a chunk that begins at `place`. It is kept for `save` when it defined something.
void run_chunk(Machine& machine, const std::string& text, const Place& place);
/// Reads and runs a file; `place` is where the deck names it.
void run_chunk_file(Machine& machine, const std::filesystem::path& file, const Place& place);
/// `require`: leaves the module's value on the stack. It is run once.
void push_module(Machine& machine, const std::string& name, const Place& place);

} // namespace kaya::script
