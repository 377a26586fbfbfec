// Where scripts and programs are called inside a cycle.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace kaya {

/// Hooks may read everything and write fields; a structural change waits for the end of the cycle.
struct Hooks {
    std::vector<std::function<void()>> before_cycle, after_forces, after_cycle;
    /// Value of a deck's function or variable, for histories and boundary conditions that use it.
    std::function<double(const std::string&)> script_value;
    /// Value of a numbered table at x, for boundary conditions that use it.
    std::function<double(std::int64_t, double)> table_value;
};

} // namespace kaya
