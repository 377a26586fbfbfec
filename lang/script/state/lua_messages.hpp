// Error messages of Lua in the words of authors of decks.
#pragma once

#include "base/diagnostic.hpp"

#include <string>
#include <string_view>
#include <vector>

struct lua_State;

namespace kaya::script {

/// `text` is the message of Lua without its place. Names that the deck can use are looked up for proposals.
Diagnostic in_plain_words(lua_State* L, std::string_view text);

/// Names that a chunk of Lua can use without defining them, sorted.
std::vector<std::string> global_names(lua_State* L);

} // namespace kaya::script
