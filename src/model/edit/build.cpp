#include "model/edit/build.hpp"

#include "base/diagnostic.hpp"
#include "geometry/mesh/mesh_plan.hpp"
#include "model/edit/bounded.hpp"
#include "model/edit/corner_values.hpp"
#include "model/measure/compatibility.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/links.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <map>

namespace kaya {

namespace {

/// Margin of contact over the size of a block.
constexpr double contact_part = 0.005;

template <class TableType> Row append(TableType& table, std::size_t count) {
    const auto first = static_cast<Row>(table.size());
    table.resize(table.size() + count);
    return first;
}

/// A convex polygon as a fan from its lowest vertex: neighbours that share a face by a cut, and bricks
/// that are zoned later, get the same diagonals.
std::vector<std::array<int, 3>> fan(const Polyhedron& p, const std::vector<int>& loop) {
    const auto lowest = std::min_element(loop.begin(), loop.end(), [&p](int a, int b) {
        return std::lexicographical_compare(p.vertices[a].data(), p.vertices[a].data() + 3, p.vertices[b].data(),
                                            p.vertices[b].data() + 3);
    });
    std::vector<int> turned(lowest, loop.end());
    turned.insert(turned.end(), loop.begin(), lowest);
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t i = 1; i + 1 < turned.size(); ++i) triangles.push_back({turned[0], turned[i], turned[i + 1]});
    return triangles;
}

/// A block with a new shape has other gridpoints: its histories take the nearest ones to their places again.
void forget_rows_of_histories(Model& model, Row block) {
    const BlockId id = model.blocks.id[block];
    for (History& history : model.histories.all)
        if (history.source.slot == id.slot && history.source.generation == id.generation)
            history.source.rows_of_block = 0;
}

} // namespace

void give_zones(Model& model, Row block, const Polyhedron& shape, const TetMesh& mesh) {
    const ModelEdit edit(model, Change::rows);
    auto& blocks = model.blocks;
    blocks.shape[block] = model.next_shape_number++;
    forget_rows_of_histories(model, block);
    const std::int32_t roller = model.gridpoints.roller[blocks.gridpoints[block].first]; // of the vertices till now
    std::optional<CornerValues> corners;
    if (!blocks.deformable[block]) corners.emplace(model, block);
    const double near = blocks.margin[block];
    const Row g0 = append(model.gridpoints, mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        model.gridpoints.block[g0 + i] = block;
        model.gridpoints.position[g0 + i] = model.gridpoints.reference[g0 + i] = mesh.points[i];
        model.gridpoints.velocity[g0 + i] =
            blocks.velocity[block] + blocks.rotational_velocity[block].cross(mesh.points[i] - blocks.centroid[block]);
        model.gridpoints.displacement[g0 + i] = corners ? corners->displacement(mesh.points[i]) : Vec3(Vec3::Zero());
        model.gridpoints.pore_pressure[g0 + i] = corners ? corners->pore_pressure(mesh.points[i], near) : 0;
        model.gridpoints.fixed[g0 + i] = blocks.fixed[block] & (fix_x | fix_y | fix_z);
        model.gridpoints.roller[g0 + i] = roller;
    }
    blocks.gridpoints[block] = {g0, static_cast<Row>(mesh.points.size())};

    const Row t0 = append(model.triangles, mesh.boundary.size());
    Row t = t0;
    const Row f0 = blocks.faces[block].first;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        model.faces.triangles[f0 + f].first = t;
        for (const auto& triangle : mesh.boundary) {
            if (triangle.face != static_cast<int>(f)) continue;
            model.triangles.face[t] = f0 + static_cast<Row>(f);
            for (int k = 0; k < 3; ++k) model.triangles.gridpoints[t][k] = g0 + triangle.points[k];
            ++t;
        }
        model.faces.triangles[f0 + f].count = t - model.faces.triangles[f0 + f].first;
    }
    blocks.triangles[block] = {t0, t - t0};

    const Row z0 = append(model.zones, mesh.tetrahedra.size());
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
        const auto& tet = mesh.tetrahedra[i];
        for (int k = 0; k < 4; ++k) model.zones.gridpoints[z0 + i][k] = g0 + tet[k];
        const Vec3 a = mesh.points[tet[1]] - mesh.points[tet[0]], b = mesh.points[tet[2]] - mesh.points[tet[0]],
                   c = mesh.points[tet[3]] - mesh.points[tet[0]];
        model.zones.volume[z0 + i] = a.dot(b.cross(c)) / 6.0;
        model.zones.stress[z0 + i] = Stress::Zero();
        model.zones.block[z0 + i] = block;
    }
    blocks.zones[block] = {z0, static_cast<Row>(mesh.tetrahedra.size())};
    blocks.cell_zones[block] = mesh.per_cell;
    blocks.deformable[block] = 1;
    blocks.face_triangles[block] = FaceTriangles::fan; // its zones cut its faces
    blocks.face_edge[block] = 0;
}

namespace {

/// Rows of a table in block order, and their new numbers.
struct BlockOrder {
    std::vector<Row> rows;
    Renamed renamed;

    BlockOrder(const Column<Span>& spans, std::size_t size) : renamed(size, no_row) {
        for (const Span& span : spans)
            for (Row row = span.first; row < span.end(); ++row) {
                renamed[static_cast<std::size_t>(row)] = static_cast<Row>(rows.size());
                rows.push_back(row);
            }
    }
};

/// The rows of a block follow those of the block before it.
template <class TableType> void put_in_order(Model& model, TableType& table, Column<Span>& spans) {
    const BlockOrder order(spans, table.size());
    table.gather(order.rows);
    renumber<TableType>(model, order.renamed);
    Row next = 0;
    for (Span& span : spans) {
        span.first = next; // also of a span without rows, which has nothing to follow
        next += span.count;
    }
    table.columns([&](std::string_view, auto& column, auto role) {
        if constexpr (links::names<Blocks, decltype(role)>())
            for (std::size_t b = 0; b < spans.size(); ++b)
                std::fill_n(column.begin() + spans[b].first, spans[b].count, static_cast<Row>(b));
    });
}

} // namespace

void put_in_block_order(Model& model) {
    const ModelEdit edit(model, Change::rows);
    auto& blocks = model.blocks;
    put_in_order(model, model.gridpoints, blocks.gridpoints);
    put_in_order(model, model.faces, blocks.faces);
    put_in_order(model, model.triangles, blocks.triangles);
    put_in_order(model, model.zones, blocks.zones);
}

void give_shape(Model& model, Row block, const Polyhedron& polyhedron) {
    give_shape(model, block, polyhedron, mass_properties(polyhedron));
}

void give_shape(Model& model, Row b, const Polyhedron& polyhedron, const MassProperties& mass) {
    const ModelEdit edit(model, Change::blocks);
    auto& blocks = model.blocks;
    blocks.shape[b] = model.next_shape_number++;
    forget_rows_of_histories(model, b);
    blocks.volume[b] = mass.volume;
    blocks.margin[b] = contact_part * std::cbrt(mass.volume);
    blocks.inertia[b] = mass.inertia;
    blocks.centroid[b] = mass.centroid;
    blocks.orientation[b] = Quaternion(1, 0, 0, 0);

    const Row g0 = append(model.gridpoints, polyhedron.vertices.size());
    for (std::size_t i = 0; i < polyhedron.vertices.size(); ++i) {
        const Vec3 arm = polyhedron.vertices[i] - mass.centroid;
        model.gridpoints.block[g0 + i] = b;
        model.gridpoints.position[g0 + i] = polyhedron.vertices[i];
        model.gridpoints.reference[g0 + i] = arm;
        model.gridpoints.displacement[g0 + i] = blocks.displacement[b];
    }
    blocks.gridpoints[b] = {g0, static_cast<Row>(polyhedron.vertices.size())};

    const Row f0 = append(model.faces, polyhedron.faces.size());
    std::size_t count = 0;
    for (const auto& face : polyhedron.faces) count += face.vertices.size() - 2;
    const Row t0 = append(model.triangles, count);
    Row first = t0;
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f) {
        const Row face = f0 + static_cast<Row>(f);
        const auto triangles = fan(polyhedron, polyhedron.faces[f].vertices);
        model.faces.block[face] = b;
        model.faces.joint_set[face] = polyhedron.faces[f].joint_set;
        model.faces.open[face] = polyhedron.faces[f].open;
        model.faces.normal[face] = face_normal(polyhedron, polyhedron.faces[f]);
        model.faces.triangles[face] = {first, static_cast<Row>(triangles.size())};
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            model.triangles.face[first + t] = face;
            for (int k = 0; k < 3; ++k) model.triangles.gridpoints[first + t][k] = g0 + triangles[t][k];
        }
        first += static_cast<Row>(triangles.size());
    }
    blocks.faces[b] = {f0, static_cast<Row>(polyhedron.faces.size())};
    blocks.triangles[b] = {t0, static_cast<Row>(model.triangles.size()) - t0};
    blocks.zones[b] = {static_cast<Row>(model.zones.size()), 0};
}

Row add_block_row(Model& model) {
    auto& blocks = model.blocks;
    const Row b = append(blocks, 1);
    blocks.id[b] = blocks.ids.create(b);
    blocks.number[b] = model.next_block_number++;
    return b;
}

namespace {

/// Throws Diagnostic for a block whose thickness under its widest face is lost in the rounding of its size: nothing of it can be computed.
void refuse_flat(const Polyhedron& shape, double volume) {
    constexpr double least = 1e-12; // of the size; rounding is 1e-16
    double widest = 0, size = 0;
    for (const auto& face : shape.faces) {
        const Vec3 first = shape.vertices[face.vertices.front()];
        Vec3 twice = Vec3::Zero();
        for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k)
            twice += (shape.vertices[face.vertices[k]] - first).cross(shape.vertices[face.vertices[k + 1]] - first);
        widest = std::max(widest, 0.5 * twice.norm());
    }
    for (const Vec3& vertex : shape.vertices) size = std::max(size, (vertex - shape.vertices.front()).norm());
    if (volume >= least * size * widest) return;
    throw Diagnostic(fmt::format("the block is flat: {:.2g} thick and {:.2g} wide", volume / widest, size),
                     "look at its coordinates and their exponents");
}

} // namespace

Row add_block(Model& model, const Polyhedron& polyhedron, const NewBlock& options) {
    const MassProperties mass = mass_properties(polyhedron);
    const bool bounded = std::ranges::all_of(polyhedron.vertices, [](const Vec3& x) { return is_bounded(x); });
    if (!bounded || !std::isfinite(mass.volume))
        throw Diagnostic(fmt::format("a coordinate of the block is beyond {:g}, or not a number", largest_coordinate),
                         "look at the exponents of its coordinates");
    if (!(mass.volume > 0))
        throw Diagnostic(fmt::format("the block has no volume ({})", mass.volume),
                         "look at the order and the place of its vertices");
    refuse_flat(polyhedron, mass.volume);
    auto& blocks = model.blocks;
    const Row b = add_block_row(model);
    blocks.material[b] = options.material;
    blocks.constitutive[b] = options.constitutive;
    blocks.region[b] = options.region;
    blocks.group[b] = options.group;
    blocks.zone_properties[b] = options.zone_properties;
    if (as_3dec(model.settings)) blocks.face_edge[b] = at_corners_only;
    give_shape(model, b, polyhedron, mass);
    return b;
}

Row add_solid(Model& model, const std::vector<Polyhedron>& parts, const NewBlock& options) {
    const Row first = add_block(model, parts.front(), options);
    std::vector<std::pair<Row, Row>> pairs;
    for (std::size_t i = 1; i < parts.size(); ++i) pairs.emplace_back(first, add_block(model, parts[i], options));
    if (!pairs.empty()) join_pairs(model, pairs);
    return first;
}

Polyhedron shape_of(const Model& model, Row block) {
    // The loops of a face are the boundary edges of its triangles, walked once around.
    Polyhedron shape;
    const Span vertices = model.blocks.gridpoints[block];
    std::vector<int> vertex_of(vertices.count, -1);
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f) {
        std::vector<std::array<Row, 2>> edges;
        const Span triangles = model.faces.triangles[f];
        for (Row t = triangles.first; t < triangles.end(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Row a = model.triangles.gridpoints[t][k], c = model.triangles.gridpoints[t][(k + 1) % 3];
                const auto opposite = std::find(edges.begin(), edges.end(), std::array<Row, 2>{c, a});
                if (opposite != edges.end()) edges.erase(opposite);
                else edges.push_back({a, c});
            }
        Polyhedron::Face face;
        face.joint_set = model.faces.joint_set[f];
        face.open = model.faces.open[f] != 0;
        if (edges.empty()) continue;
        const Row start = edges.front()[0];
        Row at = start;
        do {
            int& vertex = vertex_of[at - vertices.first];
            if (vertex < 0) {
                vertex = static_cast<int>(shape.vertices.size());
                shape.vertices.push_back(model.gridpoints.position[at]);
            }
            face.vertices.push_back(vertex);
            const auto next =
                std::find_if(edges.begin(), edges.end(), [at](const auto& edge) { return edge[0] == at; });
            if (next == edges.end()) break;
            at = (*next)[1];
            edges.erase(next);
        } while (at != start);
        shape.faces.push_back(std::move(face));
    }
    return shape;
}

namespace {

/// Removes the contacts of deleted blocks, with their sub-contacts.
void drop_contacts_of_none(Model& model) {
    auto& contacts = model.contacts;
    auto& sub_contacts = model.sub_contacts;
    std::vector<Row> kept_contacts, kept_sub_contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Span span = contacts.sub_contacts[c];
        if (contacts.block1[c] == no_row || contacts.block2[c] == no_row) {
            contacts.ids.destroy(contacts.id[c]);
            for (Row s = span.first; s < span.end(); ++s) sub_contacts.ids.destroy(sub_contacts.id[s]);
            continue;
        }
        contacts.sub_contacts[c].first = static_cast<Row>(kept_sub_contacts.size());
        for (Row s = span.first; s < span.end(); ++s) {
            sub_contacts.contact[s] = static_cast<Row>(kept_contacts.size());
            kept_sub_contacts.push_back(s);
        }
        kept_contacts.push_back(static_cast<Row>(c));
    }
    contacts.gather(kept_contacts);
    sub_contacts.gather(kept_sub_contacts);
    for (std::size_t c = 0; c < contacts.size(); ++c) contacts.ids.move(contacts.id[c], static_cast<Row>(c));
    for (std::size_t s = 0; s < sub_contacts.size(); ++s)
        sub_contacts.ids.move(sub_contacts.id[s], static_cast<Row>(s));
}

} // namespace

void delete_blocks(Model& model, const std::vector<Row>& rows) {
    const ModelEdit edit(model, Change::rows);
    auto& blocks = model.blocks;
    std::vector<bool> gone(blocks.size(), false);
    for (const Row row : rows) gone[row] = true;
    const JoinedBodies bodies = joined_bodies(model);
    std::vector<std::vector<Row>> left_of_bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        std::vector<Row> left;
        for (const Row row : bodies.members(i))
            if (!gone[row]) left.push_back(row);
        if (left.size() < bodies.members(i).size() && !left.empty()) left_of_bodies.push_back(std::move(left));
    }
    for (const auto& left : left_of_bodies) {
        unjoin(model, left);
        join_pairs(model, adjacent_pairs(model, left));
    }
    std::vector<Row> kept;
    Renamed renamed(blocks.size(), no_row);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (gone[b]) {
            blocks.ids.destroy(blocks.id[b]);
            continue;
        }
        renamed[b] = static_cast<Row>(kept.size());
        kept.push_back(static_cast<Row>(b));
    }
    blocks.gather(kept);
    for (std::size_t b = 0; b < blocks.size(); ++b) blocks.ids.move(blocks.id[b], static_cast<Row>(b));
    renumber<Blocks>(model, renamed);
    put_in_block_order(model);
    drop_contacts_of_none(model);
    if (blocks.empty()) model.clock.last_step = model.clock.global_viscosity = 0; // those of bodies that are gone
}

namespace {

constexpr double most_zones = 5e7; ///< more would not fit in the memory of any machine of today

/// Blocks that are to get zones, and their shapes.
struct ToMesh {
    std::vector<Row> rows;
    std::vector<Polyhedron> shapes;

    ToMesh(const Model& model, const std::vector<Row>& all) {
        for (const Row block : all) {
            if (model.blocks.deformable[block]) continue;
            rows.push_back(block);
            shapes.push_back(shape_of(model, block));
        }
    }
};

/// Gives the blocks the zones that mesh(number in the list) makes and finish(all) makes better; first all meshes, then the model.
template <class Mesh, class Finish> std::size_t fill_with_zones(Model& model, const ToMesh& blocks, const Mesh& mesh,
                                                                const Finish& finish,
                                                                const ProgressCallback& progress) {
    std::vector<TetMesh> meshes;
    for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
        report_progress(progress, i, blocks.rows.size());
        meshes.push_back(mesh(i, [&](double done) { report_progress(progress, i, blocks.rows.size(), done); }));
    }
    finish(meshes, [&](double) { report_progress(progress, 1, 1); });
    for (std::size_t i = 0; i < meshes.size(); ++i) give_zones(model, blocks.rows[i], blocks.shapes[i], meshes[i]);
    if (!meshes.empty()) put_in_block_order(model);
    return meshes.size();
}

/// The faces of zoned blocks that can be shared with the other blocks.
std::vector<MeshedFace> meshed_faces(const Model& model, const ToMesh& blocks) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Polyhedron& shape : blocks.shapes)
        for (const Vec3& v : shape.vertices) {
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
    const Vec3 slack = Vec3::Constant(1e-6 * (high - low).norm());
    const auto near = [&](const Vec3& x) {
        return (x - low + slack).minCoeff() >= 0 && (high + slack - x).minCoeff() >= 0;
    };
    std::vector<MeshedFace> faces;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks.deformable[b]) continue;
        for (Row f = model.blocks.faces[b].first; f < model.blocks.faces[b].end(); ++f) {
            MeshedFace face;
            std::map<Row, int> numbers;
            const Span triangles = model.faces.triangles[f];
            if (triangles.count == 0 ||
                !near(model.gridpoints.position[model.triangles.gridpoints[triangles.first][0]]))
                continue;
            for (Row t = triangles.first; t < triangles.end(); ++t) {
                std::array<int, 3> triangle;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Row g = model.triangles.gridpoints[t][k];
                    const auto [place, fresh] = numbers.emplace(g, static_cast<int>(face.points.size()));
                    if (fresh) face.points.push_back(model.gridpoints.position[g]);
                    triangle[k] = place->second;
                }
                face.triangles.push_back(triangle);
            }
            faces.push_back(std::move(face));
        }
    }
    return faces;
}

} // namespace

std::size_t generate_zones(Model& model, const std::vector<Row>& rows, const EdgeField& field,
                           const ProgressCallback& progress) {
    field.check();
    const ToMesh blocks(model, rows);
    double count = 0;
    for (const Polyhedron& shape : blocks.shapes) count += 6 * std::max(1.0, field.cubes_in(shape));
    if (!(count <= most_zones))
        throw Diagnostic(fmt::format("an edge of {} would make more than {:.0e} zones", field.least(), most_zones),
                         "give a longer edge or a smaller range");
    if (blocks.rows.empty()) return 0;
    const MeshPlan plan(blocks.shapes, field, meshed_faces(model, blocks));
    return fill_with_zones(
        model, blocks,
        [&](std::size_t i, const ProgressCallback& of_block) {
            try {
                return plan.mesh(i, of_block);
            } catch (Diagnostic& problem) {
                throw problem.add(fmt::format("in block {}", model.blocks.number[blocks.rows[i]]));
            }
        },
        [&](std::vector<TetMesh>& meshes, const ProgressCallback& of_all) { plan.mend(meshes, of_all); }, progress);
}

std::size_t generate_zones(Model& model, const std::vector<Row>& rows, const std::array<int, 3>& parts,
                           const std::array<double, 3>& ratio, const ProgressCallback& progress) {
    const ToMesh blocks(model, rows);
    if (6.0 * parts[0] * parts[1] * parts[2] * static_cast<double>(blocks.rows.size()) > most_zones)
        throw Diagnostic(fmt::format("{} x {} x {} cells would make more than {:.0e} zones", parts[0], parts[1],
                                     parts[2], most_zones),
                         "give fewer cells or a smaller range");
    return fill_with_zones(
        model, blocks,
        [&](std::size_t i, const ProgressCallback&) {
            auto mesh = hexahedron_mesh(blocks.shapes[i], parts, ratio);
            if (!mesh)
                throw Diagnostic(
                    fmt::format(
                        "block {} cannot be cut in cells: that needs six faces of four corners, not too oblique",
                        model.blocks.number[blocks.rows[i]]),
                    "leave it out of the range, or use `generate edge`");
            return std::move(*mesh);
        },
        [](std::vector<TetMesh>&, const ProgressCallback&) {}, progress);
}

} // namespace kaya
