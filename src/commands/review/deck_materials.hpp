// Numbers of materials in a deck: which get properties and are given to nothing.
#pragma once

#include "lang/interp/bare_names.hpp"

#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in any order, before any of it runs.
class DeckMaterials {
public:
    void check(const lang::BoundCommand& command);
    /// A text of FISH or Lua: if it mentions materials, it may set any of them.
    void check_script(std::string_view text);
    void anything_may_be_given() { open_ = true; }

    /// A warning for each material number that no object can have.
    std::vector<Diagnostic> findings() const;

private:
    struct Given {
        std::int64_t number;
        bool joint;
        Place place;
    };
    std::vector<Given> given_;
    std::set<std::int64_t> blocks_{1},
        joints_{1}; ///< numbers that something has; 1 is that of all which is given no other
    bool open_ = false;
};

} // namespace kaya
