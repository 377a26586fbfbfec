#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/overlay/overlay_scratch.hpp"
#include "mechanics/contact/contact_geometry.hpp"
#include "mechanics/shape/surfaces.hpp"
#include "mechanics/ties/ties.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/block_box.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace kaya {

namespace {

/// Faces are parallel within this angle (2 degrees), as for joints.
constexpr double cos_of_flat = 0.9993908270190958;
/// In parts of a block's margin: closer points of two meshes coincide.
constexpr double coincidence = 2e-3;
/// Smaller common areas, in parts of the smaller face, are dropped.
constexpr double least_area = 1e-6;

/// A face in the coordinates of a plane.
struct ProjectedFace {
    Row face;
    std::vector<Row> gridpoints; ///< of each point
    PlaneMesh mesh;
    double area = 0;

    ProjectedFace(const Model& model, Row row, const Vec3& origin, const Vec3& u, const Vec3& v) : face(row) {
        std::map<Row, int> places;
        const Span span = model.faces.triangles[face];
        for (Row t = span.first; t < span.end(); ++t) {
            std::array<int, 3> corners;
            for (int k = 0; k < 3; ++k) {
                const Row g = model.triangles.gridpoints[t][k];
                const auto [found, fresh] = places.try_emplace(g, static_cast<int>(gridpoints.size()));
                corners[k] = found->second;
                if (!fresh) continue;
                gridpoints.push_back(g);
                const Vec3 x = model.gridpoints.position[g] - origin;
                mesh.points.emplace_back(x.dot(u), x.dot(v));
            }
            mesh.triangles.push_back(corners);
            const Vec2 a = mesh.points[corners[1]] - mesh.points[corners[0]],
                       b = mesh.points[corners[2]] - mesh.points[corners[0]];
            area += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
        }
    }
};

/// Zones by the gridpoints of their faces.
class ZonesBelow {
public:
    Row zone(const Model& model, Row block, std::array<Row, 3> triangle) {
        auto& known = of_block_[block];
        if (known.empty()) learn(model, block, known);
        std::ranges::sort(triangle);
        return known.at(triangle);
    }

private:
    using Zones = std::map<std::array<Row, 3>, Row>;
    static void learn(const Model& model, Row block, Zones& known) {
        const Span zones = model.blocks.zones[block];
        for (Row z = zones.first; z < zones.end(); ++z)
            for (int k = 0; k < 4; ++k) {
                const auto& g = model.zones.gridpoints[z];
                std::array<Row, 3> face{g[(k + 1) % 4], g[(k + 2) % 4], g[(k + 3) % 4]};
                std::ranges::sort(face);
                known[face] = z - zones.first; // an inner face gets one of its two zones; it is never asked for
            }
    }
    std::map<Row, Zones> of_block_;
};

/// One side of a tie: the gridpoints of the triangle below a vertex, and their weights.
void attach(const Model& model, const ProjectedFace& face, int vertex, int triangle,
            const std::array<double, 3>& weights, ZonesBelow& below, std::array<Row, 3>& gridpoints,
            std::array<double, 3>& of, Row& zone) {
    const Row block = model.faces.block[face.face], first = model.blocks.gridpoints[block].first;
    std::array<int, 3> corners = face.mesh.triangles[triangle];
    of = weights;
    if (vertex >= 0) {
        while (corners[0] != vertex) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        of = {1, 0, 0};
    }
    for (int k = 0; k < 3; ++k) gridpoints[k] = face.gridpoints[corners[k]];
    zone = below.zone(model, block, gridpoints);
    for (Row& g : gridpoints) g -= first;
}

Vec3 place_of(const Model& model, const ProjectedFace& face, int vertex, int triangle,
              const std::array<double, 3>& weights) {
    const auto& x = model.gridpoints.position;
    if (vertex >= 0) return x[face.gridpoints[vertex]];
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < 3; ++k) place += weights[k] * x[face.gridpoints[face.mesh.triangles[triangle][k]]];
    return place;
}

/// Memory shared by the ties of consecutive pairs of faces.
struct OverlayMemory {
    ZonesBelow below;
    Overlay found;
    OverlayScratch overlay;
};

/// Finds the common area of two faces. False: there is none.
bool overlay_faces(const Model& model, const ProjectedFace& face1, const ProjectedFace& face2, const Vec3& normal,
                   double near, OverlayMemory& scratch) {
    Overlay& found = scratch.found;
    const double tolerance = coincidence * near;
    overlay(face1.mesh, face2.mesh, tolerance, 0, found, scratch.overlay);
    std::erase_if(found.points, [&](const OverlayPoint& p) {
        const Vec3 between = place_of(model, face2, p.vertex2, p.triangle2, p.weights2) -
                             place_of(model, face1, p.vertex1, p.triangle1, p.weights1);
        return std::abs(between.dot(normal)) > near;
    });
    double common = 0;
    for (const auto& p : found.points) common += p.area;
    return common > least_area * std::min(face1.area, face2.area);
}

bool coincides(const OverlayPoint& p) { return p.vertex1 >= 0 && p.vertex2 >= 0; }

/// Whether all triangles of both faces that have a part of the common area have their corners in common; the diagonals between these may
/// differ.
bool have_same_corners(const ProjectedFace& face1, const ProjectedFace& face2, const Overlay& found) {
    std::vector<char> common1(face1.mesh.points.size(), 0), common2(face2.mesh.points.size(), 0);
    for (const auto& p : found.points)
        if (coincides(p)) common1[p.vertex1] = common2[p.vertex2] = 1;
    const auto all_in = [](const std::array<int, 3>& corners, const std::vector<char>& common) {
        return std::ranges::all_of(corners, [&](int k) { return common[k] != 0; });
    };
    return std::ranges::all_of(found.points, [&](const OverlayPoint& p) {
        if ((p.vertex1 >= 0) != (p.vertex2 >= 0)) return false;
        return coincides(p) || (all_in(face1.mesh.triangles[p.triangle1], common1) &&
                                all_in(face2.mesh.triangles[p.triangle2], common2));
    });
}

/// Ties two faces over the common area that was found.
void tie_faces(Model& model, Row pair, const ProjectedFace& face1, const ProjectedFace& face2, OverlayMemory& scratch) {
    Overlay& found = scratch.found;
    const bool same = have_same_corners(face1, face2, found);
    if (same) std::erase_if(found.points, [](const OverlayPoint& p) { return !coincides(p); });
    auto& ties = model.ties;
    Row row = static_cast<Row>(ties.size());
    ties.resize(ties.size() + found.points.size());
    for (const auto& p : found.points) {
        ties.pair[row] = pair;
        ties.exact[row] = same;
        ties.face1[row] = face1.face - model.blocks.faces[model.faces.block[face1.face]].first;
        ties.face2[row] = face2.face - model.blocks.faces[model.faces.block[face2.face]].first;
        attach(model, face1, p.vertex1, p.triangle1, p.weights1, scratch.below, ties.gridpoints1[row],
               ties.weights1[row], ties.zone1[row]);
        attach(model, face2, p.vertex2, p.triangle2, p.weights2, scratch.below, ties.gridpoints2[row],
               ties.weights2[row], ties.zone2[row]);
        ties.area[row] = p.area;
        ++row;
    }
    model.tied_pairs.ties[pair].count += static_cast<Row>(found.points.size());
}

/// Ties the parallel faces of two blocks. A pair whose common faces are open gets no row: it has a contact.
void tie_blocks(Model& model, Row block1, Row block2, OverlayMemory& scratch) {
    auto& pairs = model.tied_pairs;
    const auto& blocks = model.blocks;
    const Row pair = static_cast<Row>(pairs.size());
    pairs.resize(pairs.size() + 1);
    pairs.block1[pair] = blocks.id[block1];
    pairs.block2[pair] = blocks.id[block2];
    pairs.shape1[pair] = blocks.shape[block1];
    pairs.shape2[pair] = blocks.shape[block2];
    pairs.ties[pair] = {static_cast<Row>(model.ties.size()), 0};
    const double near = std::min(blocks.margin[block1], blocks.margin[block2]);
    bool open = false;
    const auto reach = [&](Row face, const Vec3& n, double sign) { // of a face along a direction
        double most = -std::numeric_limits<double>::infinity();
        const Span span = model.faces.triangles[face];
        for (Row t = span.first; t < span.end(); ++t)
            for (const Row g : model.triangles.gridpoints[t])
                most = std::max(most, sign * n.dot(model.gridpoints.position[g] - blocks.centroid[block2]));
        return most;
    };
    for (Row f1 = blocks.faces[block1].first; f1 < blocks.faces[block1].end(); ++f1) {
        const Vec3 n = current_normal(model, f1);
        if (n.isZero(0)) continue;
        const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
        for (Row f2 = blocks.faces[block2].first; f2 < blocks.faces[block2].end(); ++f2) {
            if (current_normal(model, f2).dot(n) > -cos_of_flat) continue;
            // The nearest points of the two faces along the normal.
            if (-reach(f2, n, -1) - reach(f1, n, 1) > near || -reach(f1, n, -1) - reach(f2, n, 1) > near) continue;
            const Vec3 origin = blocks.centroid[block2]; // keeps coordinates small
            const ProjectedFace face1(model, f1, origin, u, v), face2(model, f2, origin, u, v);
            if (!overlay_faces(model, face1, face2, n, near, scratch)) continue;
            if (model.faces.open[f1] || model.faces.open[f2]) open = true;
            else tie_faces(model, pair, face1, face2, scratch);
        }
    }
    if (open && pairs.ties[pair].count == 0) pairs.resize(pairs.size() - 1);
}

/// Pairs of near joined blocks where one has no ties yet.
std::vector<std::array<Row, 2>> pairs_to_tie(const Model& model) {
    const auto& blocks = model.blocks;
    std::vector<Row> rows;
    std::vector<Box> boxes;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.body[b] == 0 || !blocks.deformable[b]) continue;
        rows.push_back(static_cast<Row>(b));
        const auto [low, high] = block_box(model, rows.back());
        const Vec3 around = Vec3::Constant(blocks.margin[b]);
        boxes.push_back({low - around, high + around});
    }
    std::vector<std::array<Row, 2>> pairs;
    const TiedBlocks tied(model);
    for (const auto& [i, j] : overlapping_boxes(boxes)) {
        const Row a = rows[i], b = rows[j];
        const bool wanted = blocks.tied_shape[a] != blocks.shape[a] || blocks.tied_shape[b] != blocks.shape[b];
        if (wanted && joined(model, a, b) && !tied.contains(a, b)) pairs.push_back({a, b});
    }
    return pairs;
}

/// The force on the second block that follows from the stresses of the two zones at a tie.
Vec3 force_of_stresses(const Model& model, Row tie, const std::array<Row, 2>& blocks) {
    const auto& ties = model.ties;
    const auto& x = model.gridpoints.position;
    const Row first = model.blocks.gridpoints[blocks[0]].first;
    const auto& g = ties.gridpoints1[tie];
    const Vec3 n = (x[first + g[1]] - x[first + g[0]]).cross(x[first + g[2]] - x[first + g[0]]).normalized();
    const Stress mean = 0.5 * (model.zones.stress[model.blocks.zones[blocks[0]].first + ties.zone1[tie]] +
                               model.zones.stress[model.blocks.zones[blocks[1]].first + ties.zone2[tie]]);
    return -ties.area[tie] * (matrix_of(mean) * n);
}

} // namespace

void make_ties(Model& model) {
    drop_void_ties(model);
    auto& blocks = model.blocks;
    const auto untied = [&](std::size_t b) {
        return blocks.body[b] != 0 && blocks.deformable[b] && blocks.tied_shape[b] != blocks.shape[b];
    };
    bool any = false;
    for (std::size_t b = 0; b < blocks.size() && !any; ++b) any = untied(b);
    if (!any) return;
    OverlayMemory scratch;
    const auto first = static_cast<Row>(model.tied_pairs.size());
    for (const auto& [a, b] : pairs_to_tie(model)) tie_blocks(model, a, b, scratch);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (untied(b)) blocks.tied_shape[b] = blocks.shape[b];
    for (Row p = first; p < static_cast<Row>(model.tied_pairs.size()); ++p) {
        std::array<Row, 2> rows;
        if (!blocks_of_pair(model, p, rows)) continue;
        const Span span = model.tied_pairs.ties[p];
        for (Row t = span.first; t < span.end(); ++t)
            if (!model.ties.exact[t]) model.ties.force[t] = force_of_stresses(model, t, rows);
    }
}

void set_tie_tractions(Model& model, const std::vector<Row>& zones) {
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> rows;
        if (!blocks_of_pair(model, static_cast<Row>(p), rows)) continue;
        const Span span = model.tied_pairs.ties[p];
        const auto listed = [&](int side, Row zone) {
            return std::ranges::binary_search(zones, model.blocks.zones[rows[side]].first + zone);
        };
        for (Row t = span.first; t < span.end(); ++t)
            if (!model.ties.exact[t] && listed(0, model.ties.zone1[t]) && listed(1, model.ties.zone2[t]))
                model.ties.force[t] = force_of_stresses(model, t, rows);
    }
}

} // namespace kaya
