#include "model/edit/cut_blocks.hpp"

#include "model/edit/build.hpp"
#include "model/edit/corner_values.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/links.hpp"
#include "model/measure/measure.hpp"
#include "model/edit/share_loads.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace kaya {

namespace {

/// Planes that differ by less, as an angle and as a part of the block's size, are one.
constexpr double same_plane = 1e-9;

/// The block before it was cut, and the data that pieces inherit.
struct Parent {
    Blocks whole;            ///< one row; its load_arms in global axes, the axes of the pieces
    std::int32_t roller = 0; ///< of a rigid block that is held along a direction
    CornerValues corners;
    double volume, density;
    Mat3 turn; ///< from the block's own axes to global ones
    struct Side {
        Vec3 normal, place;
        std::int32_t group;
    };
    std::vector<Side> sides; ///< faces with their own group

    Parent(Model& model, Row b)
        : corners(model, b), volume(model.blocks.volume[b]), density(model.blocks.mass[b] / volume),
          turn(turn_of(model.blocks, b)) {
        whole.append(model.blocks, {b});
        whole.load_arms[0] = turn * whole.load_arms[0];
        if (!model.blocks.deformable[b]) roller = model.gridpoints.roller[model.blocks.gridpoints[b].first];
        for (Row f = model.blocks.faces[b].first; f < model.blocks.faces[b].end(); ++f)
            if (model.faces.group[f] != 0)
                sides.push_back(
                    {face_area_vector(model, f).normalized(), face_centroid(model, f), model.faces.group[f]});
    }

    void give(Model& model, Row b, const Polyhedron& piece) {
        const MassProperties mass = mass_properties(piece);
        auto& blocks = model.blocks;
        links::take_over(blocks, b, whole, 0, 1, {Role::setting, Role::condition, Role::displacement, Role::load});
        const Vec3& rotation = whole.rotational_velocity[0];
        blocks.velocity[b] = whole.velocity[0] + rotation.cross(mass.centroid - whole.centroid[0]);
        blocks.rotational_velocity[b] = rotation;
        blocks.angular_momentum[b] = density * (mass.inertia * rotation);
        blocks.mass[b] = blocks.inertial_mass[b] = density * mass.volume;
        // Of loads without a place. Moments of the shares about the old centroid cancel, as that is the mean of the pieces' centroids.
        links::scale(blocks, b, mass.volume / volume, Role::load);
        give_shape(model, b, piece);
        blocks.displacement[b] = corners.displacement(blocks.centroid[b]);
        const double near = same_plane * std::cbrt(volume);
        for (Row g = blocks.gridpoints[b].first; g < blocks.gridpoints[b].end(); ++g) {
            const Vec3 place = model.gridpoints.position[g];
            model.gridpoints.roller[g] = roller;
            model.gridpoints.displacement[g] = corners.displacement(place);
            model.gridpoints.pore_pressure[g] = corners.pore_pressure(place, near);
        }
        for (Row f = blocks.faces[b].first; !sides.empty() && f < blocks.faces[b].end(); ++f) {
            const Vec3 normal = face_area_vector(model, f).normalized(), place = face_centroid(model, f);
            for (const Side& side : sides)
                if (normal.dot(side.normal) > 0 && normal.cross(side.normal).norm() < same_plane &&
                    std::abs(side.normal.dot(place - side.place)) < same_plane * std::cbrt(volume))
                    model.faces.group[f] = side.group;
        }
    }
};

/// Joins the pieces of bodies again, all but those of one block.
void rejoin(Model& model, const std::vector<std::vector<Row>>& bodies, const std::vector<Row>& cut_from) {
    for (const auto& rows : bodies) {
        auto pairs = adjacent_pairs(model, rows);
        std::erase_if(pairs, [&](const auto& pair) { return cut_from[pair.first] == cut_from[pair.second]; });
        join_pairs(model, pairs);
    }
}

} // namespace

std::vector<Row> replace_by_pieces(Model& model, const std::vector<Row>& rows, const CutBlocks& cut) {
    // Bodies with a cut block are separated; their members, and later the pieces, may be joined again.
    std::vector<std::vector<Row>> bodies;
    std::vector<int> body_of(model.blocks.size(), -1);
    {
        const JoinedBodies joined = joined_bodies(model);
        std::vector<bool> cut_row(model.blocks.size(), false);
        for (const int parent : cut.parents) cut_row[rows[static_cast<std::size_t>(parent)]] = true;
        for (std::size_t i = 0; i < joined.size(); ++i) {
            const auto members = joined.members(i);
            if (std::none_of(members.begin(), members.end(), [&](Row row) { return cut_row[row]; })) continue;
            for (const Row row : members) body_of[row] = static_cast<int>(bodies.size());
            bodies.emplace_back(members.begin(), members.end());
        }
        for (const auto& members : bodies) unjoin(model, members);
    }
    std::vector<Row> row_of_piece;
    std::vector<Row> cut_from(model.blocks.size());
    std::iota(cut_from.begin(), cut_from.end(), 0);
    for (std::size_t i = 0; i < cut.pieces.size();) {
        const int parent = cut.pieces[i].parent;
        const Row row = rows[static_cast<std::size_t>(parent)];
        Parent from(model, row);
        const SharedLoads loads(model, row, from.whole, from.turn);
        std::vector<Polyhedron> shapes{cut.pieces[i].polyhedron};
        from.give(model, row, cut.pieces[i].polyhedron);
        std::vector<Row> pieces{row};
        for (++i; i < cut.pieces.size() && cut.pieces[i].parent == parent; ++i) {
            const Row piece = add_block_row(model);
            pieces.push_back(piece);
            from.give(model, piece, cut.pieces[i].polyhedron);
            shapes.push_back(cut.pieces[i].polyhedron);
            cut_from.push_back(row);
            if (body_of[row] >= 0) bodies[static_cast<std::size_t>(body_of[row])].push_back(piece);
        }
        loads.give(model, pieces, shapes);
        row_of_piece.insert(row_of_piece.end(), pieces.begin(), pieces.end());
    }
    put_in_block_order(model);
    rejoin(model, bodies, cut_from);
    return row_of_piece;
}

} // namespace kaya
