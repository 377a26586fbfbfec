#include "geometry/mesh/mesh_plan.hpp"

#include "base/diagnostic.hpp"
#include "geometry/mesh/cell_blocks.hpp"
#include "geometry/mesh/face_mesh.hpp"
#include "geometry/mesh/hexahedron.hpp"
#include "geometry/mesh/mesh_mending.hpp"
#include "geometry/mesh/mesh_points.hpp"
#include "geometry/mesh/shared_places.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace kaya {
namespace {

using Triangle = std::array<int, 3>;

/// Cells with no angle below this, in degrees, are better than tetrahedra of any shape: they bend, and their bands of slip are less rough
/// (docs/theory/slopes.md, "Mesh refinement").
constexpr double good_cell_angle = 7;

/// Edges longer than 1.25 of the requested length are divided, since triangles with long and short edges are sharp.
constexpr double long_edge = 0.25;

SharedEdge shared_edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// A face as the numbers of its corners, from the lowest in the direction of its lower neighbour: the same from both sides.
struct Outline {
    std::vector<int> corners;
    bool turned = false;   ///< against the loop that it was made of
    std::size_t begin = 0; ///< index of the first corner in the loop
};

Outline outline_of(const std::vector<int>& loop) {
    Outline outline;
    const std::size_t count = loop.size();
    outline.begin = static_cast<std::size_t>(std::ranges::min_element(loop) - loop.begin());
    outline.turned = loop[(outline.begin + count - 1) % count] < loop[(outline.begin + 1) % count];
    for (std::size_t i = 0; i < count; ++i)
        outline.corners.push_back(loop[(outline.begin + (outline.turned ? count - i : i)) % count]);
    return outline;
}

void turn_over(std::vector<Triangle>& triangles) {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

/// The edges of triangles that belong to one of them only, as a loop; empty when that is not one loop.
std::vector<int> loop_around(const std::vector<Triangle>& triangles) {
    std::map<int, int> next;
    std::map<std::array<int, 2>, bool> there;
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k) there[{t[k], t[(k + 1) % 3]}] = true;
    for (const auto& [edge, yes] : there)
        if (!there.contains({edge[1], edge[0]}) && !next.emplace(edge[0], edge[1]).second) return {};
    std::vector<int> loop;
    if (next.empty()) return loop;
    for (int at = next.begin()->first; loop.size() < next.size();) {
        loop.push_back(at);
        const auto step = next.find(at);
        if (step == next.end()) return {};
        at = step->second;
        if (at == loop.front()) break;
    }
    if (loop.size() != next.size()) loop.clear();
    return loop;
}

/// Whether no cell is much longer than the field wants it. The edges of their block divide cells, and may be far from a fine place inside.
bool follows(const TetMesh& cells, const EdgeField& field) {
    constexpr double longest = 2; // times the field
    return field.even() || std::ranges::all_of(cells.tetrahedra, [&](const std::array<int, 4>& t) {
               std::vector<Vec3> corners;
               double mean = 0;
               for (const int v : t) {
                   for (const Vec3& x : corners) mean += (x - cells.points[v]).norm() / 6;
                   corners.push_back(cells.points[v]);
               }
               return mean <= longest * (field.least_in(box_around(corners)) + 0.5 * field.change() * mean);
           });
}

} // namespace

struct MeshPlan::Parts {
    const std::vector<Polyhedron>& blocks;
    EdgeField field;
    SharedPlaces places;
    std::map<std::vector<int>, FaceMesh> faces;        ///< existing faces, by their outline
    std::map<SharedEdge, std::vector<Vec3>> divisions; ///< of edges that are divided, from the lower end
    std::vector<std::optional<CellBlock>> cells;

    Parts(const std::vector<Polyhedron>& b, const EdgeField& f) : blocks(b), field(f), places(b), cells(b.size()) {}

    void take_face(const MeshedFace& face);
    bool good_for_cells(std::size_t block) const;
    bool suits(std::size_t block, const TetMesh& cells_of_block) const;
    std::map<SharedEdge, std::vector<double>> divisions_along() const;
    void choose_cells();
    std::vector<std::vector<int>> outlines(std::size_t block) const;
    bool cells_fit(std::size_t block, const TetMesh& mesh) const;
    std::vector<Vec3> between(SharedEdge ends) const;
    FaceMesh face(const std::vector<int>& corners) const;
    BlockSurface surface(std::size_t block) const;
};

/// A face of another mesh: corners, points between them and points inside, in this order; without corners when not all of them are vertices
/// of these blocks.
struct OrderedFace {
    std::vector<int> corners;
    std::vector<std::vector<Vec3>> between; ///< of corner i and the one after it
    FaceMesh mesh;
};

namespace {

OrderedFace in_order(const MeshedFace& face, const SharedPlaces& places) {
    const std::vector<int> loop = loop_around(face.triangles);
    const std::size_t count = loop.size();
    std::vector<int> corner_numbers;
    std::vector<std::size_t> corner_places;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& x = face.points[loop[i]];
        const Vec3 in = x - face.points[loop[(i + count - 1) % count]], out = face.points[loop[(i + 1) % count]] - x;
        constexpr double straight = 1e-6; // radians
        if (in.cross(out).norm() <= straight * in.norm() * out.norm()) continue;
        const int number = places.find(x);
        if (number < 0) return {};
        corner_numbers.push_back(number);
        corner_places.push_back(i);
    }
    if (corner_numbers.size() < 3) return {};
    const Outline outline = outline_of(corner_numbers);
    OrderedFace result{outline.corners, std::vector<std::vector<Vec3>>(outline.corners.size()), {}};
    std::vector<int> number(face.points.size(), -1);
    const auto put = [&](int point) {
        number[point] = static_cast<int>(result.mesh.points.size());
        result.mesh.points.push_back(face.points[point]);
    };
    const std::size_t corners = corner_places.size();
    const auto corner = [&](std::size_t i) {
        return corner_places[(outline.begin + (outline.turned ? corners - i % corners : i)) % corners];
    };
    for (std::size_t i = 0; i < corners; ++i) put(loop[corner(i)]);
    const std::size_t step = outline.turned ? count - 1 : 1;
    for (std::size_t i = 0; i < corners; ++i)
        for (std::size_t at = (corner(i) + step) % count; at != corner(i + 1); at = (at + step) % count) {
            result.between[i].push_back(face.points[loop[at]]);
            put(loop[at]);
        }
    for (const Triangle& t : face.triangles)
        for (const int v : t)
            if (number[v] < 0) put(v);
    for (const Triangle& t : face.triangles)
        result.mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    if (outline.turned) turn_over(result.mesh.triangles);
    return result;
}

std::vector<MeshedFace> faces_of(const TetMesh& mesh, std::size_t count) {
    std::vector<MeshedFace> faces(count);
    std::vector<std::map<int, int>> number(count);
    for (const auto& t : mesh.boundary) {
        MeshedFace& face = faces[t.face];
        Triangle triangle;
        for (int k = 0; k < 3; ++k) {
            const auto [place, fresh] = number[t.face].emplace(t.points[k], static_cast<int>(face.points.size()));
            if (fresh) face.points.push_back(mesh.points[t.points[k]]);
            triangle[k] = place->second;
        }
        face.triangles.push_back(triangle);
    }
    return faces;
}

bool near(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance) {
    return std::ranges::equal(a, b, [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= tolerance; });
}

/// Whether two faces with equal outlines have the same triangles.
bool same_triangles(const FaceMesh& a, const FaceMesh& b, double tolerance) {
    if (a.points.size() != b.points.size() || a.triangles.size() != b.triangles.size()) return false;
    std::vector<int> in_a;
    for (const Vec3& x : b.points) {
        const auto found = std::ranges::find_if(a.points, [&](const Vec3& y) { return (x - y).norm() <= tolerance; });
        if (found == a.points.end()) return false;
        in_a.push_back(static_cast<int>(found - a.points.begin()));
    }
    const auto sorted = [](std::vector<Triangle> triangles) {
        for (Triangle& t : triangles) std::ranges::sort(t);
        std::ranges::sort(triangles);
        return triangles;
    };
    std::vector<Triangle> renamed;
    for (const Triangle& t : b.triangles) renamed.push_back({in_a[t[0]], in_a[t[1]], in_a[t[2]]});
    return sorted(a.triangles) == sorted(std::move(renamed));
}

} // namespace

void MeshPlan::Parts::take_face(const MeshedFace& face) {
    OrderedFace ordered = in_order(face, places);
    const std::size_t count = ordered.corners.size();
    if (count == 0 || faces.contains(ordered.corners)) return;
    for (std::size_t i = 0; i < count; ++i)
        if (ordered.corners[i] > ordered.corners[(i + 1) % count]) std::ranges::reverse(ordered.between[i]);
    // An edge that two faces divide differently takes the division of the first, and the second face is rejected.
    const auto edge_at = [&](std::size_t i) {
        return shared_edge(ordered.corners[i], ordered.corners[(i + 1) % count]);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto known = divisions.find(edge_at(i));
        if (known != divisions.end() && !near(known->second, ordered.between[i], 4 * places.tolerance())) return;
    }
    for (std::size_t i = 0; i < count; ++i) divisions.emplace(edge_at(i), std::move(ordered.between[i]));
    faces.emplace(std::move(ordered.corners), std::move(ordered.mesh));
}

std::vector<Vec3> MeshPlan::Parts::between(SharedEdge ends) const {
    const auto known = divisions.find(ends);
    if (known != divisions.end()) return known->second;
    const Vec3 &a = places.place(ends[0]), &b = places.place(ends[1]);
    const EdgeParts parts(field, a, b);
    const std::vector<double> division = parts.division(whole_parts(parts.mean() + long_edge));
    std::vector<Vec3> points;
    for (std::size_t i = 1; i + 1 < division.size(); ++i) points.push_back(a + division[i] * (b - a));
    return points;
}

FaceMesh MeshPlan::Parts::face(const std::vector<int>& corners) const {
    const auto known = faces.find(corners);
    if (known != faces.end()) return known->second;
    FaceOutline outline;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const int a = corners[i], b = corners[(i + 1) % count];
        outline.corners.push_back(places.place(a));
        outline.between.push_back(between(shared_edge(a, b)));
        if (a > b) std::ranges::reverse(outline.between.back());
    }
    return mesh_face(outline, field);
}

BlockSurface MeshPlan::Parts::surface(std::size_t block) const {
    const Polyhedron& p = blocks[block];
    BlockSurface surface;
    MeshPoints& points = surface.points;
    for (const Vec3& v : p.vertices) points.add(v, {});
    struct Division {
        int first = -1, count = 0; ///< points of the mesh, from the lower end
    };
    std::map<SharedEdge, Division> edges;
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        const int number = static_cast<int>(f);
        std::vector<int> loop;
        for (const int v : p.faces[f].vertices) {
            points.faces[v].push_back(number);
            loop.push_back(places.numbers()[block][v]);
        }
        const Outline outline = outline_of(loop);
        FaceMesh mesh = face(outline.corners);
        if (outline.turned) turn_over(mesh.triangles);
        const std::size_t count = loop.size();
        std::vector<int> numbers(mesh.points.size(), -1);
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = p.faces[f].vertices[(outline.begin + (outline.turned ? count - i : i)) % count];
        std::size_t at = count;
        for (std::size_t i = 0; i < count; ++i) {
            const int a = outline.corners[i], b = outline.corners[(i + 1) % count];
            auto& division = edges[shared_edge(a, b)];
            if (division.first < 0) {
                division.first = static_cast<int>(points.points.size());
                for (const Vec3& x : between(shared_edge(a, b))) points.add(x, {number}), ++division.count;
            } else {
                for (int k = 0; k < division.count; ++k) points.faces[division.first + k].push_back(number);
            }
            for (int k = 0; k < division.count; ++k)
                numbers[at++] = division.first + (a < b ? k : division.count - 1 - k);
        }
        for (; at < mesh.points.size(); ++at) {
            numbers[at] = static_cast<int>(points.points.size());
            points.add(mesh.points[at], {number});
        }
        for (const Triangle& t : mesh.triangles)
            surface.triangles.push_back({{numbers[t[0]], numbers[t[1]], numbers[t[2]]}, number});
    }
    return surface;
}

/// Whether the cells fit existing faces.
bool MeshPlan::Parts::cells_fit(std::size_t block, const TetMesh& mesh) const {
    const double tolerance = 4 * places.tolerance();
    for (const MeshedFace& face : faces_of(mesh, blocks[block].faces.size())) {
        OrderedFace ordered = in_order(face, places);
        const std::size_t count = ordered.corners.size();
        for (std::size_t i = 0; i < count; ++i) {
            const int a = ordered.corners[i], b = ordered.corners[(i + 1) % count];
            if (a > b) std::ranges::reverse(ordered.between[i]);
            const auto known = divisions.find(shared_edge(a, b));
            if (known != divisions.end() && !near(known->second, ordered.between[i], tolerance)) return false;
        }
        const auto there = faces.find(ordered.corners);
        if (there != faces.end() && !same_triangles(there->second, ordered.mesh, tolerance)) return false;
    }
    return true;
}

/// Cells are for six-faced blocks.
bool MeshPlan::Parts::good_for_cells(std::size_t block) const {
    const Polyhedron& p = blocks[block];
    const auto corner = hexahedron_corners(p);
    if (!corner) return false;
    GridPlaces places_of_grid;
    for (int axis = 0; axis < 3; ++axis) {
        EdgeParts parts;
        for (int c = 0; c < 8; ++c)
            if (!(c & (1 << axis)))
                parts.add({field, p.vertices[(*corner)[c]], p.vertices[(*corner)[c | 1 << axis]]}, false);
        places_of_grid[axis] = parts.division(whole_parts(parts.mean()));
    }
    return suits(block, grid_mesh(p, *corner, places_of_grid));
}

/// Whether cells are as good for the block as its tetrahedra would be.
bool MeshPlan::Parts::suits(std::size_t block, const TetMesh& cells_of_block) const {
    if (!follows(cells_of_block, field)) return false;
    const double angle = worst_angle(cells_of_block);
    if (angle >= good_cell_angle) return true;
    try {
        return worst_angle(fill_surface(blocks[block], surface(block), field)) <= angle;
    } catch (const Diagnostic&) { return true; }
}

/// Positions of the points of divided edges on a unit length, with its ends.
std::map<SharedEdge, std::vector<double>> MeshPlan::Parts::divisions_along() const {
    std::map<SharedEdge, std::vector<double>> along;
    for (const auto& [ends, points] : divisions) {
        const Vec3& a = places.place(ends[0]);
        const double length = (places.place(ends[1]) - a).norm();
        std::vector<double>& division = along[ends];
        const std::size_t parts = points.size() + 1;
        for (std::size_t i = 0; i <= parts; ++i) {
            // Even parts are equal to those of neighbours to the last bit.
            const double even = static_cast<double>(i) / static_cast<double>(parts);
            const double place = i == 0 ? 0 : i == parts ? 1 : (points[i - 1] - a).norm() / length;
            division.push_back(std::abs(place - even) * length <= 4 * places.tolerance() ? even : place);
        }
    }
    return along;
}

void MeshPlan::Parts::choose_cells() {
    std::vector<std::vector<int>> numbers(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (good_for_cells(b)) numbers[b] = places.numbers()[b];
    cells = cell_blocks(blocks, numbers, divisions_along(), field);
    const bool any_there = !divisions.empty();
    std::set<std::vector<int>> of_others; // faces of blocks that are not cut in cells
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (cells[b]) { // continued from other blocks
            const TetMesh grid = grid_mesh(blocks[b], cells[b]->corner, cells[b]->places);
            if (!suits(b, grid) || (any_there && !cells_fit(b, grid))) cells[b].reset();
        }
        if (cells[b]) continue;
        for (const auto& outline : outlines(b)) of_others.insert(outline);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!cells[b]) continue;
        const auto mine = outlines(b);
        if (std::ranges::none_of(mine, [&](const auto& outline) { return of_others.contains(outline); })) continue;
        const auto meshed = faces_of(grid_mesh(blocks[b], cells[b]->corner, cells[b]->places), mine.size());
        for (std::size_t f = 0; f < mine.size(); ++f)
            if (of_others.contains(mine[f])) take_face(meshed[f]);
    }
}

std::vector<std::vector<int>> MeshPlan::Parts::outlines(std::size_t block) const {
    std::vector<std::vector<int>> result;
    for (const auto& face : blocks[block].faces) {
        std::vector<int> loop;
        for (const int v : face.vertices) loop.push_back(places.numbers()[block][v]);
        result.push_back(outline_of(loop).corners);
    }
    return result;
}

MeshPlan::MeshPlan(const std::vector<Polyhedron>& blocks, const EdgeField& field, const std::vector<MeshedFace>& there)
    : parts_(std::make_unique<Parts>(blocks, field)) {
    for (const Polyhedron& block : blocks) check_mesh_size(block, field);
    for (const MeshedFace& face : there) parts_->take_face(face);
    parts_->choose_cells();
}

MeshPlan::~MeshPlan() = default;

TetMesh MeshPlan::mesh(std::size_t block, const ProgressCallback& progress) const {
    const Polyhedron& p = parts_->blocks[block];
    if (const auto& cells = parts_->cells[block]) return grid_mesh(p, cells->corner, cells->places);
    return fill_surface(p, parts_->surface(block), parts_->field, progress);
}

void MeshPlan::mend(std::vector<TetMesh>& meshes, const ProgressCallback& progress) const {
    const auto& numbers = parts_->places.numbers();
    // The divisions of cells and of existing meshes are kept.
    std::set<SharedEdge> staying;
    for (std::size_t b = 0; b < meshes.size(); ++b) {
        if (!meshes[b].tetrahedra.empty() && meshes[b].per_cell == 0) continue;
        for (const auto& corners : parts_->outlines(b))
            for (std::size_t i = 0; i < corners.size(); ++i)
                staying.insert(shared_edge(corners[i], corners[(i + 1) % corners.size()]));
    }
    const MeshedBlocks together{
        parts_->blocks, numbers,
        [&](std::size_t block, int face) {
            std::vector<int> loop;
            for (const int v : parts_->blocks[block].faces[face].vertices) loop.push_back(numbers[block][v]);
            return parts_->faces.contains(outline_of(loop).corners);
        },
        [&](SharedEdge edge) { return staying.contains(edge) || parts_->divisions.contains(edge); }};
    mend_meshes(together, meshes, progress);
}

TetMesh make_mesh(const Polyhedron& polyhedron, double edge, const ProgressCallback& progress) {
    const std::vector<Polyhedron> blocks{polyhedron};
    const MeshPlan plan(blocks, EdgeField(edge));
    std::vector<TetMesh> meshes{plan.mesh(0, progress)};
    plan.mend(meshes, progress);
    return std::move(meshes.front());
}

} // namespace kaya
