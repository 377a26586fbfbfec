// What contacts carried before their geometry was made anew: that must not make energy.
#pragma once

#include "mechanics/contact_load.hpp"
#include "mechanics/contact_table.hpp"

#include <vector>

namespace kaya {

class LoadBefore {
public:
    /// Of the contact that a draft gives new geometry.
    LoadBefore(const Model& model, Row draft, Row old);

    /// Takes from the contact, which is row `contact` by now, what its new geometry would have made. `moving`: forces that it has other
    /// than before have acted in half of the step. Returns what is lost of the energy in its springs.
    double settle(Model& model, Row contact, bool moving) const;

    Row row; ///< of the draft
    ContactLoad load;

private:
    double work_; ///< of its forces in the step
};

/// Those of contacts that get new geometry.
std::vector<LoadBefore> loads_of(const Model& model, const std::vector<ContactDraft>& drafts);

/// The energy in the springs of contacts that are not kept.
double stored_in_parted(const Model& model, const std::vector<char>& kept);

} // namespace kaya
