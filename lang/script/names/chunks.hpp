// Lua text of the user: chunks of a deck, files, modules.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/state.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaya::script {

struct Chunks {
    std::vector<StoredSource> stored;    ///< FISH functions and Lua chunks in the order of their definition
    std::filesystem::path script_folder; ///< of the present deck: searched by `require`
    std::function<std::vector<std::filesystem::path>()> deck_folders; ///< of the running file and its callers
    int modules = LUA_NOREF; ///< reference to a table in Lua's registry: values of `require`, by name
};

inline Chunks& chunks_of(lua_State* L) { return *owners_of(L).chunks; }

/// Runs a chunk that begins at `place`. It is kept for `save` when it defined something.
void run_chunk(lua_State* L, const std::string& text, const Place& place);
/// Reads and runs a file; `place` is where the deck names it.
void run_chunk_file(lua_State* L, const std::filesystem::path& file, const Place& place);
/// `require`: leaves the module's value on the stack. It is run once.
void push_module(lua_State* L, const std::string& name, const Place& place);

} // namespace kaya::script
