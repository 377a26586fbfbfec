// Functions of FISH that go from an object to another, or to what it has by a name.
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
    std::int32_t table = -1;  ///< that the argument is in; -1: it takes no object
    std::size_t relation = 0; ///< index into World::relations()
};

} // namespace kaya::script
