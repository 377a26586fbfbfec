// Stresses that the six zones of each cell of a group have in common. Consecutive cycles keep them here once instead of six times; they are
// written back to the zones when they are read.
#pragma once

#include "mechanics/zones/tetrahedra.hpp"

#include <vector>

namespace kaya {

class CellStresses {
public:
    /// True while zone stresses are not read between two cycles.
    bool wanted = false;

    /// Allocates memory for the groups of the tiles; newly allocated groups hold no stress.
    void make_room(const ZoneTiles& tiles);

    bool has(Row group) const { return here_[static_cast<std::size_t>(group)] != 0; }
    const SixEights& of(Row group) const { return stress_[static_cast<std::size_t>(group)]; }
    void keep(Row group, const SixEights& stress) {
        stress_[static_cast<std::size_t>(group)] = stress;
        here_[static_cast<std::size_t>(group)] = 1;
    }

    /// Writes the stresses back to the zones and clears them.
    void give_back(Model& model, const ZoneTiles& tiles);

private:
    std::vector<SixEights> stress_; ///< by group
    std::vector<char> here_;
};

} // namespace kaya
