// Meshes of many blocks with the same triangles on both sides of shared faces.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/mesh/edge_field.hpp"
#include "geometry/mesh/mesh.hpp"

#include <memory>
#include <vector>

namespace kaya {

/// A face of a block that has a mesh already.
struct MeshedFace {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< anticlockwise seen from outside of that block
};

/// The triangles of a face depend on the face alone, not on the block. Triangles of an existing face, or of a block divided into cells, are
/// reused, and so is the division of its edges.
class MeshPlan {
public:
    /// `blocks` must outlive the plan. Vertices of blocks closer than a hundred-millionth of the whole are merged.
    MeshPlan(const std::vector<Polyhedron>& blocks, const EdgeField& field, const std::vector<MeshedFace>& there = {});
    ~MeshPlan();
    MeshPlan(const MeshPlan&) = delete;
    MeshPlan& operator=(const MeshPlan&) = delete;

    /// The mesh of one of the blocks, as make_mesh. Throws Diagnostic. May be called by several threads.
    TetMesh mesh(std::size_t block, const ProgressCallback& progress = {}) const;
    /// Improves bad zones by changes of shared faces and edges, on all sides of them. A block without tetrahedra has no mesh.
    void mend(std::vector<TetMesh>& meshes, const ProgressCallback& progress = {}) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace kaya
