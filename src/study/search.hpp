// Questions whose runs depend on earlier results: a critical value, parameters that fit. The runs depend on results only, so that the same
// call continues an interrupted search, on any number of processes.
#pragma once

#include "study/runs.hpp"

#include <string>
#include <vector>

namespace kaya {

struct CriticalAnswer {
    double value = 0;            ///< the middle of both
    double below = 0, above = 0; ///< the result differs between these
    std::vector<Case> cases;     ///< in the order of their runs
    std::vector<Outcome> outcomes;
};
/// Two runs in each step, at the thirds of the remaining interval. Throws Diagnostic when a run fails, or the result is the same at both
/// ends.
CriticalAnswer find_critical(const Study& study, Runs& runs);

struct FitAnswer {
    struct Found {
        std::string parameter;
        double value = 0;
        double deviation = 0; ///< standard deviation; NaN when the observations do not determine it
        bool at_bound = false;
    };
    struct Compared {
        std::string result;
        double measured = 0, found = 0, deviation = 0;
    };
    std::vector<Found> found;
    std::vector<Compared> compared;
    std::vector<std::vector<double>> correlation; ///< of the parameters found
    bool converged = true;                        ///< otherwise the runs that are allowed were not enough
    std::vector<Case> cases;
    std::vector<Outcome> outcomes;
};
/// Least squares within bounds by NLopt; the deviations from derivatives at the end (Gauss and Newton). Throws Diagnostic when the first
/// run fails.
FitAnswer fit_parameters(const Study& study, Runs& runs);

} // namespace kaya
