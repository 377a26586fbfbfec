#include "geometry/mesh/neighbourhood.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

namespace kaya {
namespace {

using Tet = ChangeableTets::Tet;

bool has(const TetMesh::BoundaryTriangle& triangle, int point) {
    return std::ranges::find(triangle.points, point) != triangle.points.end();
}

/// The faces that contain each point, ascending.
std::vector<std::vector<int>> faces_of_points(const TetMesh& mesh) {
    std::vector<std::vector<int>> faces(mesh.points.size());
    for (const auto& t : mesh.boundary)
        for (const int p : t.points)
            if (std::ranges::find(faces[p], t.face) == faces[p].end()) faces[p].push_back(t.face);
    for (auto& of_point : faces) std::ranges::sort(of_point);
    return faces;
}

/// Ends of the edge of two faces; nothing when they have none.
std::optional<std::array<int, 2>> common_edge(const std::vector<int>& a, const std::vector<int>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            if (a[i] == b[(j + 1) % b.size()] && a[(i + 1) % a.size()] == b[j])
                return std::array{a[i], a[(i + 1) % a.size()]};
    return std::nullopt;
}

/// The triangles at the edge from a to b, each cut in two.
void divide_triangles(TetMesh& mesh, int a, int b, int middle) {
    for (std::size_t i = 0, count = mesh.boundary.size(); i < count; ++i) {
        if (!has(mesh.boundary[i], a) || !has(mesh.boundary[i], b)) continue;
        auto half = mesh.boundary[i];
        std::ranges::replace(half.points, b, middle);
        std::ranges::replace(mesh.boundary[i].points, a, middle);
        mesh.boundary.push_back(half);
    }
}

/// The two triangles at the edge from a to b, whose other corners are c and d.
void turn_triangles(TetMesh& mesh, int a, int b, int c, int d) {
    TetMesh::BoundaryTriangle *at_c = nullptr, *at_d = nullptr;
    for (auto& t : mesh.boundary) {
        if (!has(t, a) || !has(t, b)) continue;
        if (has(t, c)) at_c = &t;
        if (has(t, d)) at_d = &t;
    }
    if (!at_c || !at_d) return;
    std::ranges::replace(at_c->points, b, d);
    std::ranges::replace(at_d->points, a, c);
}

/// Removes points without tetrahedra. Those of the surface have some.
void leave_out_unused(TetMesh& mesh) {
    std::vector<int> number(mesh.points.size(), -1);
    for (const Tet& t : mesh.tetrahedra)
        for (const int v : t) number[v] = 0;
    if (std::ranges::find(number, -1) == number.end()) return;
    std::size_t count = 0;
    for (std::size_t p = 0; p < number.size(); ++p) {
        if (number[p] < 0) continue;
        number[p] = static_cast<int>(count);
        mesh.points[count++] = mesh.points[p];
    }
    mesh.points.resize(count);
    for (Tet& t : mesh.tetrahedra)
        for (int& v : t) v = number[v];
    for (auto& t : mesh.boundary)
        for (int& v : t.points) v = number[v];
}

} // namespace

Neighbourhood::Neighbourhood(const MeshedBlocks& together, std::vector<TetMesh>& meshes, std::size_t middle)
    : tets({}, {}), together_(together), meshes_(meshes), middle_(middle) {
    const TetMesh& mesh = meshes[middle];
    const std::size_t vertices = together.blocks[middle].vertices.size();
    auto faces = faces_of_points(mesh);
    for (std::size_t p = 0; p < faces.size(); ++p) {
        const Motion motion = p < vertices ? Motion{Freedom::nowhere} : motion_of(faces[p]);
        if (p >= vertices && !faces[p].empty()) places_.emplace(mesh.points[p], static_cast<int>(p));
        tets.add_point(mesh.points[p], std::move(faces[p]), motion);
    }
    for (int f = 0; f < static_cast<int>(together.blocks[middle].faces.size()); ++f)
        if (!together.face_stays(middle, f)) tets.open_faces.push_back(f);
    std::vector<int> same(mesh.points.size());
    std::iota(same.begin(), same.end(), 0);
    take_in(middle, std::move(same));
}

void Neighbourhood::add(std::size_t block) {
    const std::vector<int>&mine = together_.numbers[middle_], &theirs = together_.numbers[block];
    const TetMesh& mesh = meshes_[block];
    std::vector<int> local(mesh.points.size(), -1);
    for (std::size_t v = 0; v < theirs.size(); ++v) {
        const auto found = std::ranges::find(mine, theirs[v]);
        if (found != mine.end()) local[v] = static_cast<int>(found - mine.begin());
    }
    for (const auto& t : mesh.boundary)
        for (const int p : t.points) {
            if (p < static_cast<int>(theirs.size())) continue;
            const auto found = places_.find(mesh.points[p]);
            if (found != places_.end()) local[p] = found->second;
        }
    take_in(block, std::move(local));
}

bool Neighbourhood::divide(int a, int b) {
    std::vector<int> faces = common_faces(tets.points, {a, b});
    const Motion motion = motion_of(faces);
    if (motion.freedom == Freedom::nowhere) return false;
    divide_edge(tets, a, b, std::move(faces), motion);
    return true;
}

void Neighbourhood::give_back() {
    for (std::size_t member = 0; member < members_.size(); ++member) give_back(member);
}

/// For a point that is not a vertex.
Motion Neighbourhood::motion_of(const std::vector<int>& faces) const {
    const Polyhedron& block = together_.blocks[middle_];
    if (faces.empty()) return {};
    if (faces.size() > 2) return {Freedom::nowhere};
    if (faces.size() == 1) {
        if (together_.face_stays(middle_, faces[0])) return {Freedom::nowhere};
        return {Freedom::in_plane, face_normal(block, block.faces[faces[0]])};
    }
    const auto ends = common_edge(block.faces[faces[0]].vertices, block.faces[faces[1]].vertices);
    if (!ends) return {Freedom::nowhere};
    const auto [a, b] = *ends;
    const auto [low, high] = std::minmax(together_.numbers[middle_][a], together_.numbers[middle_][b]);
    if (together_.edge_stays({low, high})) return {Freedom::nowhere};
    return {Freedom::along_line, (block.vertices[b] - block.vertices[a]).normalized()};
}

/// The tetrahedra of a block that have a point of the one in the middle.
void Neighbourhood::take_in(std::size_t block, std::vector<int> local) {
    const TetMesh& mesh = meshes_[block];
    Member member{block, std::move(local), {}, tets.tets.size()};
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
        if (std::ranges::any_of(mesh.tetrahedra[t], [&](int v) { return member.local[v] >= 0; }))
            member.taken.push_back(static_cast<int>(t));
    for (const int t : member.taken) {
        Tet tet = mesh.tetrahedra[t];
        for (int& v : tet) {
            if (member.local[v] < 0) member.local[v] = tets.add_point(mesh.points[v], {}, {Freedom::nowhere});
            v = member.local[v];
        }
        tets.add(tet, static_cast<int>(members_.size()));
    }
    members_.push_back(std::move(member));
    given_ = tets.tets.size();
}

void Neighbourhood::give_back(std::size_t number) {
    const Member& member = members_[number];
    TetMesh& mesh = meshes_[member.block];
    const auto& places = tets.points.points;
    std::vector<int> global(places.size(), -1);
    for (std::size_t p = 0; p < member.local.size(); ++p) {
        const int local = member.local[p];
        if (local < 0) continue;
        global[local] = static_cast<int>(p);
        if (tets.motions[local].freedom != Freedom::nowhere) mesh.points[p] = places[local];
    }
    std::vector<bool> gone(mesh.tetrahedra.size(), false);
    for (std::size_t i = 0; i < member.taken.size(); ++i) gone[member.taken[i]] = !tets.alive[member.first + i];
    std::size_t kept = 0;
    for (std::size_t t = 0; t < gone.size(); ++t)
        if (!gone[t]) mesh.tetrahedra[kept++] = mesh.tetrahedra[t];
    mesh.tetrahedra.resize(kept);
    for (std::size_t t = given_; t < tets.tets.size(); ++t) {
        if (!tets.alive[t] || tets.block[t] != static_cast<int>(number)) continue;
        Tet tet = tets.tets[t];
        for (int& v : tet) {
            if (global[v] < 0) {
                global[v] = static_cast<int>(mesh.points.size());
                mesh.points.push_back(places[v]);
            }
            v = global[v];
        }
        mesh.tetrahedra.push_back(tet);
    }
    for (const auto& change : tets.surface_changes) {
        std::array<int, 4> points{};
        std::ranges::transform(change, points.begin(), [&](int v) { return v < 0 ? -1 : global[v]; });
        const auto [a, b, c, d] = points;
        if (a < 0 || b < 0 || c < 0) continue;
        if (change[3] < 0) divide_triangles(mesh, a, b, c);
        else if (d >= 0) turn_triangles(mesh, a, b, c, d);
    }
    leave_out_unused(mesh);
}

} // namespace kaya
