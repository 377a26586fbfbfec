// Cells in VTK's files: tetrahedra, pyramids, wedges, hexahedra and voxels as zones, those of higher order by their corners; polyhedra as
// rigid blocks.
#include "base/stop_point.hpp"
#include "geometry/grid/cell_zones.hpp"
#include "geometry/grid/vtk_contents.hpp"
#include "geometry/read/vtk_mesh.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <variant>

namespace kaya {
namespace {

constexpr int left_out = 0, voxel = 11, polyhedron = 42;

/// A type of cells with the number of its nodes, the corners first; 0: as many as its order needs.
struct CellType {
    int type;
    CellKind kind;
    std::size_t nodes;
};
constexpr std::array cell_types{
    CellType{10, CellKind::tetrahedron, 4}, CellType{24, CellKind::tetrahedron, 10},
    CellType{71, CellKind::tetrahedron, 0}, CellType{78, CellKind::tetrahedron, 0},
    CellType{11, CellKind::hexahedron, 8},  CellType{12, CellKind::hexahedron, 8},
    CellType{25, CellKind::hexahedron, 20}, CellType{29, CellKind::hexahedron, 27},
    CellType{33, CellKind::hexahedron, 24}, CellType{72, CellKind::hexahedron, 0},
    CellType{79, CellKind::hexahedron, 0},  CellType{13, CellKind::wedge, 6},
    CellType{26, CellKind::wedge, 15},      CellType{31, CellKind::wedge, 12},
    CellType{32, CellKind::wedge, 18},      CellType{73, CellKind::wedge, 0},
    CellType{80, CellKind::wedge, 0},       CellType{14, CellKind::pyramid, 5},
    CellType{27, CellKind::pyramid, 13},    CellType{37, CellKind::pyramid, 19},
    CellType{74, CellKind::pyramid, 0},     CellType{81, CellKind::pyramid, 0},
};

/// Types that fill space and are not read: prisms of five and six sides, sets of points, cells of other interpolations.
bool is_other_solid(int type) {
    constexpr std::array others{15, 16, 41, 55, 56, 64, 65, 66, 67};
    return std::ranges::find(others, type) != others.end();
}

class VtkBlocks {
public:
    explicit VtkBlocks(const VtkMesh& mesh) : mesh_(mesh), labels_(mesh_.labels()) {}

    Grid3d grid() {
        for (std::size_t k = 0; k < mesh_.points.size(); ++k)
            grid_.gridpoints.emplace_hint(grid_.gridpoints.end(), static_cast<int>(k) + 1, mesh_.points[k]);
        StopPoints stops;
        bool any_face = false;
        for (std::size_t cell = 0; cell < mesh_.types.size(); ++cell) {
            stops.pass();
            const int type = mesh_.types[cell];
            const auto known = std::ranges::find(cell_types, type, &CellType::type);
            if (known != cell_types.end()) zones(cell, *known);
            else if (type == polyhedron) block(cell);
            else if (is_other_solid(type))
                mesh_.fail_at_cell(cell, fmt::format("it is of type {}, which is not read", type),
                                   "tetrahedra, pyramids, wedges, hexahedra, voxels and polyhedra are read");
            else any_face = any_face || (type != left_out && mesh_.corners(cell).size() > 2);
        }
        for (auto& [first_cell, found] : found_) {
            if (const auto* set = std::get_if<ZoneSet>(&found)) make_blocks(grid_, *set);
            else {
                grid_.blocks.push_back(std::move(std::get<Grid3d::Block>(found)));
                grid_.blocks.back().number = static_cast<int>(grid_.blocks.size());
            }
        }
        if (grid_.blocks.empty() && !any_face)
            mesh_.fail(0, "there is no cell and no face in it", "save the cells, or the surface, of the mesh");
        return std::move(grid_);
    }

private:
    void zones(std::size_t cell, const CellType& type) {
        std::vector<int> corners;
        for (const int corner : mesh_.corners(cell)) corners.push_back(corner + 1);
        const std::size_t needed = corners_of(type.kind);
        if (type.nodes > 0 ? corners.size() != type.nodes : corners.size() < needed)
            mesh_.fail_at_cell(
                cell, fmt::format("a {} of type {} has {} nodes", name_of(type.kind), type.type, corners.size()));
        corners.resize(needed);   // edges are straight
        if (type.type == voxel) { // along the axes, not around
            std::swap(corners[2], corners[3]);
            std::swap(corners[6], corners[7]);
        }
        const VtkLabel& label = labels_[cell];
        const auto [first_cell, is_new] = first_cell_of_.try_emplace(label, cell);
        if (is_new) found_[cell] = ZoneSet{label.group, label.region, label.material, {}};
        auto& set = std::get<ZoneSet>(found_[first_cell->second]);
        add_cell(grid_, set, fail_, type.kind, static_cast<long long>(cell), corners);
    }

    void block(std::size_t cell) {
        const auto faces = mesh_.faces.find(cell);
        if (faces == mesh_.faces.end()) mesh_.fail_at_cell(cell, "a polyhedron has no faces");
        Grid3d::Block result;
        for (const auto& loop : faces->second) {
            const int next = static_cast<int>(grid_.faces.size()) + 1;
            auto& face = grid_.faces[next];
            for (const int corner : loop) face.push_back(corner + 1);
            result.faces.push_back(next);
        }
        const VtkLabel& label = labels_[cell];
        result.region = label.region;
        result.group = label.group;
        result.material = label.material;
        found_[cell] = std::move(result);
    }

    const VtkMesh& mesh_;
    std::vector<VtkLabel> labels_;
    Grid3d grid_;
    std::map<std::size_t, std::variant<ZoneSet, Grid3d::Block>> found_; ///< by their first cell
    std::map<VtkLabel, std::size_t> first_cell_of_;                     ///< of zones
    FailHere fail_ = [this](const std::string& message, const std::string& hint) { mesh_.fail(0, message, hint); };
};

} // namespace

Grid3d blocks_of(const VtkMesh& mesh) { return VtkBlocks(mesh).grid(); }

Grid3d read_vtk_blocks(std::string_view bytes, const std::string& file) {
    return blocks_of(read_vtk_mesh(bytes, file));
}

} // namespace kaya
