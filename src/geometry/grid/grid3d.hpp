// Block assemblies as .3dgrid text: gridpoints, faces or tetrahedra, blocks, joint sets and groups by number.
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/surface/surface.hpp"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

struct Grid3d {
    struct Block {
        int number = 0, region = 0;
        std::vector<int> faces; ///< of a rigid block
        std::vector<int> zones; ///< of a deformable block; either this or faces
        std::string group;
        int material = 0; ///< 0: not given in the file
    };
    struct JointSet {
        int number = 0;
        std::vector<std::array<int, 2>> blocks; ///< pairs that the set separates
    };
    double tolerance = 0; ///< closer gridpoints are merged; 0 when not given in the file
    std::map<int, Vec3> gridpoints;
    std::map<int, std::vector<int>> faces; ///< gridpoint numbers around each face
    std::map<int, std::array<int, 4>> zones;
    std::vector<Block> blocks;
    std::vector<JointSet> joint_sets;
};

/// Reads lines TOL, G, F, Z, B, JS and BGROUP; * begins a comment. Throws Diagnostic with file and line for
/// numbers that are used twice or never defined.
Grid3d read_grid3d(std::string_view text, const std::string& file);

/// Cells of gmsh's .msh, ASCII 2.2 or 4.1, as zones; edges of elements of second order are straight. Each volume of the geometry is a
/// block; its physical group gives group, region and material. Throws Diagnostic with file and line.
Grid3d read_msh(std::string_view text, const std::string& file);

/// Zones of FLAC3D's text grids; connected ones of a group are a block.
Grid3d read_f3grid(std::string_view text, const std::string& file);

/// Cells of Neper's tessellations (.tess) as rigid blocks.
Grid3d read_tess(std::string_view text, const std::string& file);

/// Cells of VTK's files, legacy (.vtk) and XML (.vtu), as zones, polyhedra as rigid blocks. Data of cells give groups, regions and
/// materials. No block when the file holds faces only. Throws Diagnostic with file and line or cell.
Grid3d read_vtk_blocks(std::string_view bytes, const std::string& file);

/// The text of a grid; numbers are written so that they read back bit for bit.
std::string write_grid3d(const Grid3d& grid);

/// The surface of one block, unchecked. Faces shared with another block have the joint set of the two.
Surface surface_of(const Grid3d& grid, const Grid3d::Block& block);

/// The zones of a deformable block as a mesh of the polyhedron that was made of its surface.
TetMesh zones_of(const Grid3d& grid, const Grid3d::Block& block, const Polyhedron& polyhedron);

struct GridShape {
    int number = 0, region = 0;
    std::string group;
    const Polyhedron* shape = nullptr;
    int material = 0;
    const TetMesh* zones = nullptr; ///< of a deformable block
};

enum class Corners { shared, own };

/// A grid of blocks. Equal corners become one gridpoint, of all blocks or of each. Shared faces with the same corners become one face. With
/// shared corners blocks whose faces of one joint set lie against each other are listed under it.
Grid3d grid_of(const std::vector<GridShape>& blocks, Corners corners = Corners::shared);

} // namespace kaya
