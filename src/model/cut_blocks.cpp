#include "model/cut_blocks.hpp"

#include "model/build.hpp"

#include <Eigen/Geometry>

namespace kaya {

namespace {

/// What a piece takes over from the block that it was cut from.
struct Parent {
    NewBlock options;
    std::uint8_t hidden, fixed;
    double volume, density;
    Vec3 centroid, velocity, rotational_velocity, displacement, load, torque;

    Parent(const Blocks& blocks, Row b)
        : options{blocks.material[b], blocks.constitutive[b], blocks.region[b], blocks.group[b]},
          hidden(blocks.hidden[b]), fixed(blocks.fixed[b]), volume(blocks.volume[b]),
          density(blocks.mass[b] / blocks.volume[b]), centroid(blocks.centroid[b]), velocity(blocks.velocity[b]),
          rotational_velocity(blocks.rotational_velocity[b]), displacement(blocks.displacement[b]),
          load(blocks.load[b]), torque(blocks.torque[b]) {}

    void give(Model& model, Row b, const Polyhedron& piece) const {
        const MassProperties mass = mass_properties(piece);
        auto& blocks = model.blocks;
        blocks.material[b] = options.material;
        blocks.constitutive[b] = options.constitutive;
        blocks.region[b] = options.region;
        blocks.group[b] = options.group;
        blocks.hidden[b] = hidden;
        blocks.fixed[b] = fixed;
        blocks.velocity[b] = velocity + rotational_velocity.cross(mass.centroid - centroid);
        blocks.rotational_velocity[b] = rotational_velocity;
        blocks.angular_momentum[b] = density * (mass.inertia * rotational_velocity);
        blocks.displacement[b] = displacement;
        // Moments of the shares about the old centroid cancel, as that is the mean of the pieces' centroids.
        blocks.load[b] = mass.volume / volume * load;
        blocks.torque[b] = mass.volume / volume * torque;
        give_shape(model, b, piece);
    }
};

} // namespace

void replace_by_pieces(Model& model, const std::vector<Row>& rows, const CutBlocks& cut) {
    for (std::size_t i = 0; i < cut.pieces.size();) {
        const int parent = cut.pieces[i].parent;
        const Row row = rows[static_cast<std::size_t>(parent)];
        const Parent from(model.blocks, row);
        from.give(model, row, cut.pieces[i].polyhedron);
        for (++i; i < cut.pieces.size() && cut.pieces[i].parent == parent; ++i)
            from.give(model, add_block_row(model), cut.pieces[i].polyhedron);
    }
    put_in_block_order(model);
}

} // namespace kaya
