// Kinds of objects of a model, for the engine and for the languages; src/model/kinds/kinds.hpp has a row for each of them.
#pragma once

#include <cstdint>

namespace kaya {

enum class ObjectKind : std::int32_t {
    // Kinds that scripts see. The numbers must not change: save files hold handles of objects.
    block,
    gridpoint,
    zone,
    face,
    contact,
    sub_contact,
    corner, ///< of the triangles of a face
    cable_node,
    structure_node, ///< of beams and liners
    beam_element,
    liner_element,
    // Others.
    triangle,
    global,   ///< the whole model
    function, ///< no object: a function of the deck, which a history records
    none
};

/// Kinds before this one, from block on, are visible to scripts.
inline constexpr ObjectKind end_of_script_kinds = ObjectKind::triangle;

} // namespace kaya
