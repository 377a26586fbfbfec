// The runs of a study: the values of its parameters in each.
#pragma once

#include "study/study.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// One run. It has the same number and values each time that the study is called.
struct Case {
    std::size_t number = 1;                                 ///< from 1 on
    std::vector<std::pair<std::string, StudyValue>> values; ///< by parameter
    double weight = 1;                                      ///< of a point estimate; 1 otherwise
};

/// Grid: all combinations, the first parameter slowest. Latin hypercube: Iman and Conover (1982) for correlated parameters; random and
/// Sobol: a Gaussian copula; point estimate: Rosenblueth (1975), two points of each parameter. The same seed gives the same cases on
/// any machine. Throws Diagnostic: too many runs, correlations that cannot be.
std::vector<Case> cases_of(const Study& study);

} // namespace kaya
