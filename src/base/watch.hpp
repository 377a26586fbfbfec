// How long work is looked at from outside while it goes on.
#pragma once

#include <cstddef>
#include <functional>

namespace kaya {

/// Called between the parts of long work with the fraction that is done; it may throw to stop the work, which must
/// change nothing before its end. An empty one: nobody looks.
using Watch = std::function<void(double done)>;

/// Of part `part` of `parts` the fraction `done` is done.
inline void look(const Watch& watch, std::size_t part, std::size_t parts, double done = 0) {
    if (watch) watch((static_cast<double>(part) + done) / static_cast<double>(parts));
}

} // namespace kaya
