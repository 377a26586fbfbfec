// Forecast of the stiffness of joints in the next step: docs/theory/time-step.md.
#pragma once

#include "base/per_thread.hpp"
#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/contact_stiffness.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "model/tables/model.hpp"

#include <map>
#include <vector>

namespace kaya {

/// Runs joint models on copies of sub-contacts, and moves rigid blocks ahead; nothing in the model changes.
class StiffnessForecast {
public:
    /// Takes the batches, and marks those whose joint model is curved. Of property sets it caches its results until they are discarded.
    void take(const Model& model, std::vector<Batch>& batches);
    void forget() { varies_.clear(); }

    /// Whether any joint model in use has a stiffness that depends on its closure.
    bool needed() const { return !varying_.empty(); }

    /// What may stiffen: joint models with the closure, or the overlaps of rigid blocks with their area as well.
    enum class Of { laws, laws_and_overlaps };

    /// Finds the stiffnesses at the end of a step of that length from the motion and forces of now. True when those
    /// of any contact grow so much that they count: these contacts are marked.
    bool update(const Model& model, const Adjacency& adjacency, double step, Of of = Of::laws);

    const std::vector<Springs>& springs() const {
        return springs_;
    }                                                         ///< by sub-contact; as they are where nothing grows
    const std::vector<char>& marks() const { return marks_; } ///< by contact

private:
    struct Motion {
        Vec3 centre, velocity, spin;
    };

    void find_motions(const Model& model, const Adjacency& adjacency, double step);
    Vec3 velocity_of_side(const Model& model, Row block, const Attachment& side, const Vec3& place, double step) const;
    bool check(const Model& model, const Batch& batch, Row contact, double step);
    double closing_of(const Model& model, Row contact, double time) const;
    /// The most that a point of one block may move towards the other: blocks that are apart may have a normal that no longer separates them.
    double farthest_motion(const Model& model, Row contact, double time) const;
    double closing_within(const Model& model, Row contact,
                          double time) const; ///< the most, in the middle or at the end
    double growth_of_overlap(const Model& model, Row contact, double step, OverlapScratch& scratch) const;

    std::map<Row, bool> varies_; ///< by row of Model::joint_properties
    std::vector<Batch> varying_;
    std::vector<char> in_varying_; ///< by contact
    std::vector<Motion> motions_;  ///< by block: of rigid ones in the middle of the next step
    std::vector<Springs> springs_;
    std::vector<char> marks_;
    std::vector<double> growth_; ///< by contact: factor by which an overlap stiffens
    PerThread<OverlapScratch> scratch_;
};

} // namespace kaya
