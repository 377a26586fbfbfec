// The blocks of a file of another program, read and checked, before any of them is in the model.
#pragma once

#include "base/diagnostic.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/surface/surface_repair.hpp"
#include "geometry/surface/surface_simplify.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

struct IncomingBlock {
    Solid solid;
    std::optional<TetMesh> mesh;
    std::string group;
    std::int32_t region = 0, material = 0; ///< 0: not given in the file
    int number = 0;                        ///< of a block with faces or zones, in the file
};

/// How bodies became simpler.
struct Reductions {
    SimplifyCounts triangles, convex_parts;
};

struct IncomingFile {
    std::vector<IncomingBlock> blocks;
    std::vector<Diagnostic> refused; ///< of bodies that are wrong; each names the body and its place
    RepairCounts repaired;
    Reductions reductions;
};

/// How the coordinates of the file become those of the model, and what is repaired and simplified on the way.
struct IncomingOptions {
    double scale = 1;
    char up = 'z'; ///< the axis of the file that points up: x, y or z
    Repair repair;
    Simplification simplification; ///< of surfaces
    std::int64_t convex = 0;       ///< greatest number of convex parts of a body, 0: as many as it has
};

double volume_of(const Solid& solid);

/// Throws Diagnostic when the file as a whole cannot be read.
IncomingFile read_blocks(const std::string& path, const IncomingOptions& options);

} // namespace kaya
