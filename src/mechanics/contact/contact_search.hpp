// Finds the blocks that are in contact and decides when to search again.
// reads: gridpoints.position, blocks.travelled, blocks.margin, contacts.slip_since_update
// writes: contacts, sub_contacts, blocks.travelled, energy.joint_lost, stale
#pragma once

#include "base/per_thread.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/common/near_pairs.hpp"
#include "mechanics/shape/search_scratch.hpp"
#include "mechanics/shape/surfaces.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Drafts found together, with the points that they refer to.
struct FoundContacts {
    std::vector<ContactDraft> drafts;
    std::vector<ContactPoint> points; ///< of one draft after another

    void clear();
    void close(); ///< call once all are found: points move while the list grows
};

/// Keeps data between searches that speeds up the next one; results do not depend on it.
class ContactSearch {
public:
    /// Checks all pairs of near blocks where one has moved since its last check. `moving`: see replace_contacts.
    ContactChange search(Model& model, JointRegistry& joints, bool moving);

    /// Whether a block has moved so far that it may be about to meet another.
    static bool due(const Model& model);

    /// Updates the geometry of contacts that have slid farther than their tolerance.
    ContactChange refresh_slipped(Model& model, JointRegistry& joints);

private:
    NearPairs near_;
    Surfaces surfaces_;
    std::vector<Box> boxes_;
    std::vector<double> beyond_;    ///< how far each block may be beyond half its margin, see travel_beyond
    std::vector<double> strengths_; ///< tensile, by row of joint properties
    std::vector<char> moved_;
    std::vector<FoundContacts> found_;
    PerThread<SearchScratch> scratch_;
};

} // namespace kaya
