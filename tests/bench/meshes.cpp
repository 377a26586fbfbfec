// Meshes of random jointed rock: bench_meshes [BLOCKS [SEED]]. Cubes of rock are cut by random joint sets, some are mirrored, rotated and
// moved a million metres, and all blocks are meshed with edges from a fifth of the spacing to twice the spacing. Prints a line for each
// edge and one for all: blocks, zones, processor time, blocks without a mesh; for benign blocks the smallest angle between faces of zones;
// the mean edge over the requested one, for blocks large enough; the number of shared faces with the same triangles on both sides. Benign
// blocks have edges above a fifth of the requested one, angles above 20 degrees and a thickness above 0.3 of it.
#include "tests/unit/geometry/cut_rock.hpp"
#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/joint_set.hpp"
#include "geometry/mesh/mesh_plan.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <set>

using namespace kaya;

namespace {

std::vector<Polyhedron> jointed_cube(Random& random) {
    std::vector<Polyhedron> blocks{make_brick({0, 0, 0}, {4, 4, 4})};
    const int sets = 3 + (random.uniform() < 0.3);
    for (int i = 0; i < sets; ++i) {
        JointSet set;
        set.dip = 90 * random.uniform();
        set.dip_direction = 360 * random.uniform();
        set.dip_deviation = set.dip_direction_deviation = random.uniform() < 0.5 ? 0 : 10 * random.uniform();
        set.spacing = 0.8 + 0.8 * random.uniform();
        set.spacing_deviation = random.uniform() < 0.5 ? 0 : 0.3 * random.uniform();
        set.number = 9;
        set.origin = {4 * random.uniform(), 4 * random.uniform(), 4 * random.uniform()};
        set.id = i + 1;
        set.seed = static_cast<std::uint64_t>(1e9 * random.uniform());
        cut_rock(blocks, set);
    }
    return blocks;
}

/// Leaves some unchanged; others are rotated, mirrored, moved a million metres.
void place(std::vector<Polyhedron>& blocks, Random& random) {
    const int kind = static_cast<int>(4 * random.uniform());
    const Mat3 turn = Eigen::AngleAxisd(6 * random.uniform(),
                                        Vec3(random.symmetric(), random.symmetric(), 1 + random.uniform()).normalized())
                          .toRotationMatrix();
    for (Polyhedron& block : blocks) {
        for (Vec3& x : block.vertices) {
            if (kind == 1) x = turn * x;
            if (kind == 2) x.x() = -x.x();
            if (kind == 3) x += Vec3(1e6, -1e6, 1e6);
        }
        if (kind == 2)
            for (auto& face : block.faces) std::ranges::reverse(face.vertices);
    }
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

double angle_between(const Vec3& a, const Vec3& b) { return degrees(std::atan2(a.cross(b).norm(), a.dot(b))); }

struct Shape {
    double shortest_edge = 1e300, smallest_angle = 180, thickness = 0;
};

/// The shortest edge, the smallest angle at a corner of a face and between two faces.
Shape shape_of(const Polyhedron& p) {
    Shape shape;
    shape.thickness = thickness(p);
    std::map<std::pair<int, int>, Vec3> normals;
    for (const auto& face : p.faces) {
        const Vec3 normal = face_normal(p, face);
        const std::size_t n = face.vertices.size();
        for (std::size_t i = 0; i < n; ++i) {
            const int a = face.vertices[i], b = face.vertices[(i + 1) % n], c = face.vertices[(i + 2) % n];
            const Vec3 ab = p.vertices[b] - p.vertices[a], bc = p.vertices[c] - p.vertices[b];
            shape.shortest_edge = std::min(shape.shortest_edge, ab.norm());
            shape.smallest_angle = std::min(shape.smallest_angle, 180 - angle_between(ab, bc));
            const auto [other, fresh] = normals.emplace(std::minmax(a, b), normal);
            if (!fresh)
                shape.smallest_angle = std::min(shape.smallest_angle, 180 - angle_between(other->second, normal));
        }
    }
    return shape;
}

/// Positions of the corners, rounded to about a tenth of a millimetre, so that both sides of a face compare equal.
class Places {
public:
    int number(const Vec3& x) {
        const std::array<long, 3> key{std::lround(x.x() * 4096 + 0.37), std::lround(x.y() * 4096 + 0.37),
                                      std::lround(x.z() * 4096 + 0.37)};
        for (int i = 0; i < 27; ++i) {
            const auto [first, last] =
                numbers_.equal_range({key[0] + i % 3 - 1, key[1] + i / 3 % 3 - 1, key[2] + i / 9 - 1});
            for (auto it = first; it != last; ++it)
                if ((places_[it->second] - x).norm() < 1e-6) return it->second;
        }
        places_.push_back(x);
        numbers_.emplace(key, static_cast<int>(places_.size()) - 1);
        return static_cast<int>(places_.size()) - 1;
    }

private:
    std::multimap<std::array<long, 3>, int> numbers_;
    std::vector<Vec3> places_;
};

using Triangles = std::set<std::array<int, 3>>;

struct Count {
    std::size_t blocks = 0, zones = 0, failed = 0, shared = 0, matching = 0;
    double seconds = 0, edges = 0;
    std::size_t edge_count = 0;
    std::vector<double> benign; ///< worst angles

    void add(const Count& o) {
        blocks += o.blocks, zones += o.zones, failed += o.failed, shared += o.shared, matching += o.matching;
        seconds += o.seconds, edges += o.edges, edge_count += o.edge_count;
        benign.insert(benign.end(), o.benign.begin(), o.benign.end());
    }
    void print(double edge) {
        std::ranges::sort(benign);
        const auto part = [&](double p) {
            return benign.empty() ? 0 : benign[static_cast<std::size_t>(p * static_cast<double>(benign.size()))];
        };
        fmt::print("{:5} {:6} {:7} {:7.2f} {:6} {:7} {:6.2f} {:6.2f} {:6.2f} {:6.2f} {:9.3f} {:7} {:7}\n", edge, blocks,
                   zones, seconds, failed, benign.size(), part(0), part(0.01), part(0.1), part(0.5),
                   edges / static_cast<double>(std::max<std::size_t>(edge_count, 1)), shared, matching);
        std::fflush(stdout);
    }
};

/// Blocks without a mesh have no tetrahedra.
std::vector<TetMesh> meshes_of(const std::vector<Polyhedron>& blocks, double edge) {
    std::vector<TetMesh> meshes(blocks.size());
    const MeshPlan plan(blocks, edge);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        try {
            meshes[b] = plan.mesh(b);
        } catch (const Diagnostic&) {}
    }
    plan.mend(meshes);
    return meshes;
}

void look_at_faces(const std::vector<Polyhedron>& blocks, const std::vector<TetMesh>& meshes, Count& count) {
    Places places;
    std::map<std::vector<int>, Triangles> seen;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (meshes[b].tetrahedra.empty()) continue;
        std::vector<Triangles> triangles(blocks[b].faces.size());
        for (const auto& t : meshes[b].boundary) {
            std::array<int, 3> key;
            for (std::size_t k = 0; k < 3; ++k)
                key[k] = places.number(meshes[b].points[static_cast<std::size_t>(t.points[k])]);
            std::ranges::sort(key);
            triangles[static_cast<std::size_t>(t.face)].insert(key);
        }
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            std::vector<int> corners;
            for (const int v : blocks[b].faces[f].vertices)
                corners.push_back(places.number(blocks[b].vertices[static_cast<std::size_t>(v)]));
            std::ranges::sort(corners);
            const auto [other, fresh] = seen.emplace(corners, triangles[f]);
            if (fresh) continue;
            ++count.shared;
            count.matching += other->second == triangles[f];
        }
    }
}

void look_at_shapes(const std::vector<Polyhedron>& blocks, const std::vector<TetMesh>& meshes, double edge,
                    Count& count) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        ++count.blocks;
        if (meshes[b].tetrahedra.empty()) {
            ++count.failed;
            continue;
        }
        const TetMesh& m = meshes[b];
        count.zones += m.tetrahedra.size();
        const Shape shape = shape_of(blocks[b]);
        if (shape.shortest_edge > 0.2 * edge && shape.smallest_angle > 20 && shape.thickness > 0.3 * edge)
            count.benign.push_back(dihedral_angles(m).smallest);
        if (m.per_cell != 0 || shape.shortest_edge < edge) continue;
        std::set<std::pair<int, int>> edges;
        for (const auto& t : m.tetrahedra)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j) edges.insert(std::minmax(t[i], t[j]));
        for (const auto& [a, c] : edges) count.edges += (m.points[a] - m.points[c]).norm() / edge;
        count.edge_count += edges.size();
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::size_t wanted = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 10000;
    const std::uint64_t seed = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
    constexpr std::array edges{0.2, 0.35, 0.6, 1.0, 2.0};
    Count all;
    fmt::print(
        " edge blocks   zones seconds failed  benign  worst    1 %   10 %   half mean edge  shared matching; least angles, edge 0: all\n");
    for (std::size_t e = 0; e < edges.size(); ++e) {
        Random random(seed, e);
        Count count;
        // Fine meshes are many zones in few blocks.
        const std::size_t share = wanted * (e == 0 ? 1 : e == 1 ? 3 : e == 2 ? 6 : 5) / 20;
        while (count.blocks < share) {
            std::vector<Polyhedron> blocks = jointed_cube(random);
            place(blocks, random);
            const std::clock_t start = std::clock();
            const auto meshes = meshes_of(blocks, edges[e]);
            count.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            look_at_shapes(blocks, meshes, edges[e], count);
            look_at_faces(blocks, meshes, count);
        }
        count.print(edges[e]);
        all.add(count);
    }
    all.print(0);
    return all.failed == 0 && all.matching == all.shared ? 0 : 1;
}
