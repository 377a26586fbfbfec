// Closed surfaces from the files of other programs.
#pragma once

#include "geometry/surface/surface_repair.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

class VtkMesh;

/// The faces of one object as a file lists them, corner by corner.
struct FaceSoup {
    std::string name; ///< as the file calls it; may be empty
    std::vector<std::vector<Vec3>> loops;
};

/// One body of a file.
struct NamedSurface {
    std::string name;
    Surface surface;               ///< closed, not yet checked; faces are "face n" of the object
    std::vector<Surface> cavities; ///< closed surfaces inside it that bound a hollow
};

struct SurfaceFile {
    std::vector<NamedSurface> surfaces;
    RepairCounts repaired; ///< of all surfaces
};

/// Merges equal corners, repairs, and separates parts that share no edge; parts inside others become their cavities.
SurfaceFile surfaces_of(const std::vector<FaceSoup>& soups, const Repair& repair = {});

/// The faces of an object with equal corners merged; faces that shrink to a line are dropped.
Surface welded(const FaceSoup& soup, double near = 0);

/// Readers of the formats; `file` is the name for messages.
std::vector<FaceSoup> read_stl(std::string_view bytes, const std::string& file);
std::vector<FaceSoup> read_obj(std::string_view text, const std::string& file);
std::vector<FaceSoup> read_ply(std::string_view bytes, const std::string& file);
std::vector<FaceSoup> read_vrml(std::string_view text, const std::string& file);
std::vector<FaceSoup> read_dxf(std::string_view text, const std::string& file);
std::vector<FaceSoup> read_gocad(std::string_view text, const std::string& file);
std::vector<FaceSoup> read_compas(std::string_view text, const std::string& file);
std::vector<FaceSoup> read_vtk_surfaces(std::string_view bytes, const std::string& file);

/// The faces among the cells of a mesh, an object for each label.
std::vector<FaceSoup> faces_of(const VtkMesh& mesh);

} // namespace kaya
