// Functions that the Lua of a deck calls and nothing in it defines.
#pragma once

#include "base/diagnostic.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the texts of Lua of a deck, before any of it runs.
class DeckLua {
public:
    /// `place`: of the first line of the text.
    void check(std::string_view text, const Place& place);

    /// Warnings. `names`: what Lua knows without the deck.
    std::vector<Diagnostic> findings(const std::vector<std::string>& names) const;

private:
    std::map<std::string, Place> called_; ///< each name where it is called first
    std::set<std::string> mentioned_;     ///< names in other places, which may define them
    bool open_ = false;                   ///< a text may define names that cannot be read in it
};

} // namespace kaya
