// Error messages of Lua in the words of authors of decks.
#pragma once

#include "base/diagnostic.hpp"

#include <string_view>

struct lua_State;

namespace kaya::script {

/// `text` is the message of Lua without its place. Names that the deck can use are looked up for proposals.
Diagnostic in_plain_words(lua_State* L, std::string_view text);

} // namespace kaya::script
