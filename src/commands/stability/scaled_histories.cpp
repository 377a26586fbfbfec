#include "commands/stability/scaled_histories.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>

namespace kaya {

bool is_variable(const TimeFunction& function, const std::string& variable) {
    return function.kind == TimeFunction::Kind::script && function.script == variable;
}

ScaledHistories scaled_histories(const Model& model, const std::string& variable) {
    const auto& histories = model.boundary_histories;
    std::vector<Row> loads, velocities;
    for (std::size_t i = 0; i < histories.size(); ++i) {
        if (model.blocks.ids.row(histories.block[i]) == no_row) continue;
        const TimeFunction& function = model.time_functions[static_cast<std::size_t>(histories.function[i])];
        if (!is_variable(function, variable)) continue;
        const bool velocity = histories.what[i] == BoundaryHistories::What::velocity;
        (velocity ? velocities : loads).push_back(static_cast<Row>(i));
    }
    if (loads.empty() && velocities.empty())
        throw Diagnostic(
            fmt::format("'@{}' scales no load and no velocity", variable),
            fmt::format("give one first, e.g. apply xload 1000 hist @{0}, or apply xvel 1 hist @{0}", variable));
    if (!loads.empty() && !velocities.empty())
        throw Diagnostic(fmt::format("'@{}' scales loads and velocities at once", variable),
                         "a load is pushed and a boundary is driven: use two variables");
    return velocities.empty() ? ScaledHistories{false, std::move(loads)} : ScaledHistories{true, std::move(velocities)};
}

} // namespace kaya
