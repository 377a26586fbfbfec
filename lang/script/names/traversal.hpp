// Functions of FISH that lead from an object to another, or to a named value of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace kaya::script {

enum class Walk { relation, property, joint, extra };

/// One such function: c_next, cx_prop, j_model, b_extra.
struct Traversal {
    std::string name;
    Walk walk = Walk::relation;
    std::int32_t table = -1;  ///< table of the argument; -1: it takes no object
    std::size_t relation = 0; ///< index into World::relations()
};

} // namespace kaya::script
