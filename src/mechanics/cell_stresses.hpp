// Stresses that the six zones of each cell of a group have in common. Cycles that follow each other keep them here and not six times;
// the zones get them when somebody looks.
#pragma once

#include "mechanics/tetrahedra.hpp"

#include <vector>

namespace kaya {

class CellStresses {
public:
    /// As long as nobody looks at the stresses of zones between two cycles.
    bool wanted = false;

    /// Room for the groups of the tiles; where it is not there yet none of them is here.
    void make_room(const ZoneTiles& tiles);

    bool has(Row group) const { return here_[static_cast<std::size_t>(group)] != 0; }
    const SixEights& of(Row group) const { return stress_[static_cast<std::size_t>(group)]; }
    void keep(Row group, const SixEights& stress) {
        stress_[static_cast<std::size_t>(group)] = stress;
        here_[static_cast<std::size_t>(group)] = 1;
    }

    /// Writes to the zones what is here, and forgets it.
    void give_back(Model& model, const ZoneTiles& tiles);

private:
    std::vector<SixEights> stress_; ///< by group
    std::vector<char> here_;
};

} // namespace kaya
