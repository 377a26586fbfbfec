// Faces collected by all readers of surface files, and the surfaces made from them. Private to geometry.
#pragma once

#include "geometry/surface_files.hpp"

namespace kaya {

/// Faces as a file lists them, by number of vertex or corner by corner.
struct FaceSoup {
    std::string name;
    std::vector<std::vector<Vec3>> loops;
};

/// Merges equal corners, drops faces that shrink to a line, and separates unconnected parts.
void add_surfaces(const FaceSoup& soup, std::vector<NamedSurface>& surfaces);

/// Refuses a file without any face.
void need_surfaces(const std::vector<NamedSurface>& surfaces, const std::string& file);

} // namespace kaya
