// Meshes of many blocks that have the same triangles on both sides of the faces that two of them share.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/edge_field.hpp"
#include "geometry/mesh.hpp"

#include <memory>
#include <vector>

namespace kaya {

/// A face of a block that has a mesh already.
struct MeshedFace {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< anticlockwise seen from outside of that block
};

/// The triangles of a face follow from the face alone, whichever of the two blocks is looked at. Where a face is there already, or
/// belongs to a block that is cut in cells, its triangles are taken over, and so is the division of its edges.
class MeshPlan {
public:
    /// `blocks` has to stay as long as the plan. Vertices of blocks nearer to each other than a hundred-millionth of the whole are one place.
    MeshPlan(const std::vector<Polyhedron>& blocks, const EdgeField& field, const std::vector<MeshedFace>& there = {});
    ~MeshPlan();
    MeshPlan(const MeshPlan&) = delete;
    MeshPlan& operator=(const MeshPlan&) = delete;

    /// The mesh of one of the blocks, as make_mesh. Throws Diagnostic. May be called by several threads.
    TetMesh mesh(std::size_t block, const ProgressCallback& progress = {}) const;
    /// Bad zones of blocks are made better by changes of faces and edges that blocks share, on all sides of them. A block without tetrahedra has no mesh.
    void mend(std::vector<TetMesh>& meshes, const ProgressCallback& progress = {}) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace kaya
