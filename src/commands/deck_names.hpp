// Names of FISH in a deck: which of those that its commands use are never made.
#pragma once

#include "lang/interp/binder.hpp"

#include <set>
#include <string>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in any order. A name that commands use with @ must be mentioned by a function,
/// set by a command, or be built in; otherwise the run would stop there.
class DeckNames {
public:
    /// `inside`: the command stands in a FISH function, and its names may be local ones.
    void look_at(const lang::BoundCommand& command, bool inside);
    /// Files that are not known before the run may make any name.
    void anything_may_be_made() { open_ = true; }

    struct Missing {
        std::string name;
        Place place;
        std::string meant; ///< a name that is made and nearly the same, or empty
    };
    /// In the order in which they were used, once for each line.
    std::vector<Missing> missing() const;

private:
    void use_words(const lang::BoundCommand& command);

    std::set<std::string> made_;
    std::vector<std::pair<std::string, Place>> used_;
    bool open_ = false;
};

} // namespace kaya
