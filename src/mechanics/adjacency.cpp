#include "mechanics/adjacency.hpp"

namespace kaya {

Adjacency make_adjacency(const Model& model) {
    Adjacency adjacency;
    const auto& subs = model.sub_contacts;
    const auto& blocks = model.blocks;
    const auto sides = [&](Row s) {
        const Row contact = subs.contact[s];
        return std::array{std::pair{model.contacts.block1[contact], &subs.side1[s]},
                          std::pair{model.contacts.block2[contact], &subs.side2[s]}};
    };
    adjacency.of_gridpoint = sorted_lists<SideEntry>(model.gridpoints.size(), [&](auto add) {
        for (Row s = 0; s < static_cast<Row>(subs.size()); ++s)
            for (std::int32_t side = 0; side < 2; ++side) {
                const auto [block, attachment] = sides(s)[side];
                if (!blocks.deformable[block]) continue;
                for (int k = 0; k < 3; ++k)
                    if (attachment->weights[k] != 0)
                        add(attachment->gridpoints[k], SideEntry{s, side, attachment->weights[k]});
            }
    });
    adjacency.of_block = sorted_lists<ContactEntry>(blocks.size(), [&](auto add) {
        for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c)
            for (std::int32_t side = 0; side < 2; ++side) {
                const Row block = side == 0 ? model.contacts.block1[c] : model.contacts.block2[c];
                if (!blocks.deformable[block]) add(block, ContactEntry{c, side});
            }
    });
    adjacency.bodies = joined_bodies(model);
    return adjacency;
}

} // namespace kaya
