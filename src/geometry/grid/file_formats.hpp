// The formats of files with blocks, zones and surfaces, by the suffixes of their names.
#pragma once

#include "geometry/grid/grid3d.hpp"
#include "geometry/read/surface_files.hpp"

namespace kaya {

struct FileFormat {
    using ReadBlocks = Grid3d (*)(std::string_view bytes, const std::string& file);
    using ReadSurfaces = std::vector<FaceSoup> (*)(std::string_view bytes, const std::string& file);

    std::string_view suffix;
    ReadBlocks blocks =
        nullptr; ///< with faces or zones; no block when the file holds surfaces; null: such files hold none
    ReadSurfaces surfaces = nullptr; ///< null: such files hold none
    std::string (*write)(const Grid3d&) = nullptr;
    /// What the format keeps of the grid that is written.
    enum class Holds {
        grid,    ///< corners and faces that blocks share, and joint sets
        zones,   ///< cells: of rigid blocks too
        surfaces ///< of blocks, those with zones included
    } holds = Holds::surfaces;
};

/// Null for other suffixes.
const FileFormat* file_format(const std::string& path);

/// The suffixes of all formats that are read or written, and of those with surfaces.
std::string suffixes_read();
std::string suffixes_written();
std::string surface_suffixes_read();
std::string surface_suffixes_written();

/// Blocks with faces or zones; or, when there are none, the objects of a surface file.
struct FileContents {
    Grid3d grid;
    std::vector<FaceSoup> soups;
};
/// What a file holds. Throws Diagnostic with file and line when it cannot be read.
FileContents read_contents(const std::string& path);

/// The objects of a surface file. Throws Diagnostic with file and line when the file cannot be read or holds no faces.
std::vector<FaceSoup> read_soups(const std::string& path);

/// Writers of grids whose blocks share no corners. Coordinates are written so that they read back bit for bit.
std::string write_stl(const Grid3d& grid);
std::string write_obj(const Grid3d& grid);
std::string write_ply(const Grid3d& grid);
std::string write_compas(const Grid3d& grid);
std::string write_f3grid(const Grid3d& grid);
std::string write_msh(const Grid3d& grid);
std::string write_vtu(const Grid3d& grid);

/// A name in quotes, as the readers take it.
std::string quoted_name(std::string name);

} // namespace kaya
