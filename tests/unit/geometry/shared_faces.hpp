// Meshes of many blocks and their shared faces.
#pragma once

#include "cut_rock.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/joint_set.hpp"
#include "geometry/mesh/mesh_plan.hpp"
#include "geometry/polyhedra/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace kaya {

inline std::vector<TetMesh> meshes_of(const MeshPlan& plan, std::size_t count) {
    std::vector<TetMesh> meshes;
    for (std::size_t b = 0; b < count; ++b) meshes.push_back(plan.mesh(b));
    plan.mend(meshes);
    return meshes;
}

/// The faces of a mesh as those of an already meshed block.
inline std::vector<MeshedFace> faces_there(const Polyhedron& block, const TetMesh& mesh) {
    std::vector<MeshedFace> faces(block.faces.size());
    for (auto& face : faces) face.points = mesh.points;
    for (const auto& t : mesh.boundary) faces[t.face].triangles.push_back(t.points);
    return faces;
}

/// One number for all points within a micrometre of each other.
class Places {
public:
    int number(const Vec3& x) {
        const auto cell = [](double v) { return static_cast<long>(std::floor(v * 1024)); };
        for (int i = 0; i < 27; ++i) {
            const auto [first, last] =
                numbers_.equal_range({cell(x.x()) + i % 3 - 1, cell(x.y()) + i / 3 % 3 - 1, cell(x.z()) + i / 9 - 1});
            for (auto it = first; it != last; ++it)
                if ((places_[it->second] - x).norm() < 1e-6) return it->second;
        }
        places_.push_back(x);
        const int number = static_cast<int>(places_.size()) - 1;
        numbers_.emplace(std::array<long, 3>{cell(x.x()), cell(x.y()), cell(x.z())}, number);
        return number;
    }

private:
    std::multimap<std::array<long, 3>, int> numbers_;
    std::vector<Vec3> places_;
};

struct Shared {
    int faces = 0, matching = 0;
};

/// Faces with equal corners, and those of them with equal triangles.
inline Shared shared_faces(const std::vector<Polyhedron>& blocks, const std::vector<TetMesh>& meshes) {
    Places places;
    std::map<std::vector<int>, std::set<std::array<int, 3>>> seen;
    Shared shared;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::vector<std::set<std::array<int, 3>>> triangles(blocks[b].faces.size());
        for (const auto& t : meshes[b].boundary) {
            std::array<int, 3> key{};
            for (std::size_t k = 0; k < 3; ++k) key[k] = places.number(meshes[b].points[t.points[k]]);
            std::ranges::sort(key);
            triangles[t.face].insert(key);
        }
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            std::vector<int> corners;
            for (const int v : blocks[b].faces[f].vertices) corners.push_back(places.number(blocks[b].vertices[v]));
            std::ranges::sort(corners);
            const auto [other, fresh] = seen.emplace(corners, triangles[f]);
            if (fresh) continue;
            ++shared.faces;
            shared.matching += other->second == triangles[f];
        }
    }
    return shared;
}

/// Cut by three sets with random directions, spacings and scatter.
inline std::vector<Polyhedron> rock(std::uint64_t seed) {
    Random random(seed);
    std::vector<Polyhedron> blocks{make_brick({0, 0, 0}, {4, 4, 4})};
    for (int i = 1; i <= 3; ++i) {
        JointSet set;
        set.dip = 90 * random.uniform();
        set.dip_direction = 360 * random.uniform();
        set.dip_deviation = 8 * random.uniform();
        set.spacing = 1.2 + 0.8 * random.uniform();
        set.number = 9;
        set.origin = {4 * random.uniform(), 4 * random.uniform(), 4 * random.uniform()};
        set.id = i;
        set.seed = seed;
        cut_rock(blocks, set);
    }
    return blocks;
}

inline void move(std::vector<Polyhedron>& blocks, const Mat3& turn, const Vec3& way) {
    for (Polyhedron& block : blocks) {
        for (Vec3& x : block.vertices) x = turn * x + way;
        if (turn.determinant() < 0)
            for (auto& face : block.faces) std::ranges::reverse(face.vertices);
    }
}

} // namespace kaya
