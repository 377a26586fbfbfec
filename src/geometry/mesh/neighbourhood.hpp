// A block of tetrahedra and the adjacent zones of other blocks, as one mesh that can be changed. Private to geometry.
#pragma once

#include "base/vector.hpp"
#include "geometry/mesh/edge_classes.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/tet_exchanges.hpp"

#include <array>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

namespace kaya {

/// Blocks whose meshes share their triangles.
struct MeshedBlocks {
    const std::vector<Polyhedron>& blocks;
    const std::vector<std::vector<int>>& numbers; ///< of their vertices
    std::function<bool(std::size_t block, int face)> face_stays;
    std::function<bool(SharedEdge)> edge_stays;
};

class Neighbourhood {
public:
    Neighbourhood(const MeshedBlocks& together, std::vector<TetMesh>& meshes, std::size_t middle);

    void add(std::size_t block);
    /// A new point in the middle of an edge of the block in the middle; false where none may be.
    bool divide(int a, int b);
    /// Writes the meshes.
    void give_back();

    ChangeableTets tets; ///< those of the block in the middle are of block 0

private:
    struct Member {
        std::size_t block;
        std::vector<int> local; ///< numbers of the mesh's points here, -1 for those that are not
        std::vector<int> taken; ///< its tetrahedra, in the order in which they are here
        std::size_t first;      ///< of them here
    };
    struct ByPlace {
        bool operator()(const Vec3& a, const Vec3& b) const {
            return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
        }
    };

    Motion motion_of(const std::vector<int>& faces) const;
    void take_in(std::size_t block, std::vector<int> local);
    void give_back(std::size_t member);

    const MeshedBlocks& together_;
    std::vector<TetMesh>& meshes_;
    std::size_t middle_;
    std::vector<Member> members_;
    std::size_t given_ = 0;               ///< tetrahedra before any change
    std::map<Vec3, int, ByPlace> places_; ///< of points on the surface between the vertices
};

} // namespace kaya
