// Interface for doing the runs of a study: on this machine, in several processes at once, in a queue.
#pragma once

#include "study/outcome.hpp"

#include <vector>

namespace kaya {

class Runs {
public:
    virtual ~Runs() = default;
    /// The outcome of each case, in their order; finished runs are not repeated. Throws Diagnostic when it was stopped, or when files
    /// cannot be written; finished runs are kept.
    virtual std::vector<Outcome> all(const std::vector<Case>& cases) = 0;
};

} // namespace kaya
