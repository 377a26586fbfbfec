// Whatever does the runs of a study: this machine, several processes at once, a queue.
#pragma once

#include "study/outcome.hpp"

#include <vector>

namespace kaya {

class Runs {
public:
    virtual ~Runs() = default;
    /// The outcome of each case, in their order; runs that are done already are not done again. Throws Diagnostic when it
    /// was stopped, or nothing can be written; what is done is kept.
    virtual std::vector<Outcome> all(const std::vector<Case>& cases) = 0;
};

} // namespace kaya
