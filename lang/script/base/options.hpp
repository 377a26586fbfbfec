// Permissions of scripts, and the moments at which they run.
#pragma once

#include "system/gate.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace kaya::script {

struct Options {
    bool trusted = false;       ///< true: os.execute, io.popen, files anywhere, debug, load libraries
    std::shared_ptr<Gate> gate; ///< decides which files may be opened; without it only those of the working folder
    std::uint64_t seed = 1;     ///< of urand, grand and Lua's math.random
    std::size_t memory = 0;     ///< bytes that all scripts together may use; 0: unlimited
    std::vector<std::filesystem::path> module_folders; ///< searched by `require` after the deck's folder
};

/// Where a script may run: in a cycle, or before and after a `solve`. A FISH whilestepping function runs at after_cycle.
enum class Moment { before_cycle, after_forces, after_cycle, solve_start, solve_complete };

} // namespace kaya::script
