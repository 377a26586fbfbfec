// Small initial models of cases, and files that their lines may name.
#pragma once

#include "trial.hpp"
#include "values.hpp"

namespace kaya::soak {

/// Lines that run without a warning and create a model, with named ranges, tables, functions and histories.
std::string scene(Chance& c);
/// A few cycles, with the settings that a model needs for them.
std::string cycles(Chance& c);

struct Sample {
    std::string name, bytes;
};
/// A valid file of each format that the program reads: closed surfaces, grids, grounds, tables, a joint model in Lua.
const std::vector<Sample>& samples();

} // namespace kaya::soak
