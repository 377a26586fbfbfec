// Faces that lie on faces of other blocks.
#pragma once

#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// By face: whether a contact of faces lies on it. Such a contact may have one face only, where the other block has none opposite.
inline std::vector<char> faces_in_contact(const Model& model) {
    std::vector<char> covered(model.faces.size(), 0);
    const auto& contacts = model.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        for (const Row face : {contacts.face1[c], contacts.face2[c]})
            if (contacts.type[c] == ContactType::face_face && face != no_row)
                covered[static_cast<std::size_t>(face)] = 1;
    return covered;
}

} // namespace kaya
