// Which blocks touch, and when to look again.
// reads: gridpoints.position, blocks.travelled, blocks.margin, contacts.slip_since_update
// writes: contacts, sub_contacts, blocks.travelled, energy.joint_lost, stale
#pragma once

#include "base/per_thread.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/contact_table.hpp"
#include "mechanics/near_pairs.hpp"
#include "mechanics/search_scratch.hpp"
#include "mechanics/surfaces.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Drafts that were found together, and the points that they refer to.
struct FoundContacts {
    std::vector<ContactDraft> drafts;
    std::vector<ContactPoint> points; ///< of one draft after another

    void clear();
    void close(); ///< once all are there: points have moved while there came more
};

/// Keeps between searches what makes the next one faster, and nothing on which its result depends.
class ContactSearch {
public:
    /// Looks at all pairs of blocks that are near each other and of which one has moved since it was looked
    /// at last. `moving`: see replace_contacts.
    ContactChange search(Model& model, JointRegistry& joints, bool moving);

    /// Whether a block has gone so far that it may be about to touch another.
    static bool due(const Model& model);

    /// Makes the geometry of contacts anew that have slid farther than their tolerance.
    ContactChange refresh_slipped(Model& model, JointRegistry& joints);

private:
    NearPairs near_;
    Surfaces surfaces_;
    std::vector<Box> boxes_;
    std::vector<double> beyond_; ///< how far each block may come beyond half its margin, see travel_beyond
    std::vector<char> moved_;
    std::vector<FoundContacts> found_;
    PerThread<SearchScratch> scratch_;
};

} // namespace kaya
