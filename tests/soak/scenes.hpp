// Small models that cases begin with, and files that their lines may name.
#pragma once

#include "trial.hpp"
#include "values.hpp"

namespace kaya::soak {

/// Lines that run without a warning and leave a model, with named ranges, tables, functions and histories.
std::string scene(Chance& c);
/// A few cycles, with what a model needs for them.
std::string cycles(Chance& c);

struct Sample {
    std::string name, bytes;
};
/// A file that is right of each format that the program reads: closed surfaces, grids, grounds, tables, a joint model in Lua.
const std::vector<Sample>& samples();

} // namespace kaya::soak
