// A model with its strength divided by a factor.
#pragma once

#include "model/tables/model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// A model whose strengths are divided by a factor.
struct ReducedModel {
    Model model;
    std::vector<std::vector<double>> whole = {}; ///< values of its property sets before they were divided
    double factor = 1;
    /// Of a model in motion: the sub-contacts that slip.
    std::optional<std::vector<Row>> slipping = {};
};

} // namespace kaya
