// Closed surfaces from the files of other programs.
#pragma once

#include "geometry/surface.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

struct NamedSurface {
    std::string name; ///< as the file calls it; may be empty
    Surface surface;  ///< one closed surface, not yet checked; faces are "face n" of the file or solid
};

/// Reads all surfaces of a file: .stl (text or binary), .obj, .ply (text or binary), .wrl and .vrml.
/// Throws Diagnostic with file and line when the file cannot be read.
std::vector<NamedSurface> read_surfaces(const std::string& path);

/// The readers after it; `file` is the name for messages.
std::vector<NamedSurface> read_stl(std::string_view bytes, const std::string& file);
std::vector<NamedSurface> read_obj(std::string_view text, const std::string& file);
std::vector<NamedSurface> read_ply(std::string_view bytes, const std::string& file);
std::vector<NamedSurface> read_vrml(std::string_view text, const std::string& file);

} // namespace kaya
