// Bounds of the highest frequency of the model, body by body: docs/theory/time-step.md.
#pragma once

#include "mechanics/adjacency.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <vector>

namespace kaya {

/// The larger tangent stiffness of a sub-contact, force/length.
inline double tangent_stiffness(const SubContacts& subs, Row s) {
    return std::max(subs.normal_stiffness[s], subs.shear_stiffness[s]) * subs.area[s];
}

/// The body that limits the time step.
struct StepLimit {
    double frequency_squared = 0; ///< upper bound of the highest, (rad/time)^2
    bool of_block = false;
    Row row = no_row; ///< gridpoint or rigid block
};

/// Masses that a bound of the frequency goes by; unit: 1 for all.
enum class Masses { real, inertial, unit };

/// Stiffness of each body by equation (8) of docs/theory/time-step.md: force/length, 0 for what cannot move. The
/// frequency of a model stays below the root of the largest ratio of stiffness to inertial mass.
struct BodyStiffness {
    std::vector<double> of_gridpoint, of_block; ///< gridpoints of deformable blocks, rigid blocks; by row; joined blocks share that
                                                ///< of their body by mass
};

/// What the joints hold the bodies with. Everything in it is derived from the model; it is kept for its memory.
class StepBounds {
public:
    /// Takes places, tangent stiffnesses and areas of the sub-contacts from the model, and which bodies are held.
    /// Bounds are then those of all bodies.
    void update(const Model& model, const Adjacency& adjacency);

    /// The same for the bodies on the marked contacts only: what has changed for others far away says nothing about
    /// these. Not while density is scaled.
    void update_at(const Model& model, const Adjacency& adjacency, const std::vector<char>& contacts);

    /// Since the last update only inertial masses may have changed. Where density is scaled it is the smaller one of
    /// the bounds by equations (4) and (8).
    StepLimit limit(const Model& model, const Adjacency& adjacency, Masses masses = Masses::inertial);

    /// As of the last update.
    const BodyStiffness& stiffness() const { return stiffness_; }

private:
    /// Sums over the sub-contacts of a contact between rigid blocks, k being stiffnesses and a the sizes of equation (7).
    struct ContactSums {
        double own1 = 0, cross = 0, own2 = 0; ///< of k a1 a1, k a1 a2, k a2 a2
    };

    void look(const Model& model, const Adjacency& adjacency);
    void weigh(const Model& model, const Adjacency& adjacency, Masses masses);
    double size(const Model& model, Row block, Row sub_contact) const;
    double side(const Model& model, Row block, const Attachment& attachment, Row sub_contact) const;
    void add_contact(const Model& model, Row contact);
    double row_of_gridpoint(const Adjacency& adjacency, Row row) const;
    double row_of_block(const Model& model, const Adjacency& adjacency, Row row) const;
    double row_of_body(const Model& model, const Adjacency& adjacency, std::size_t body) const;
    void find_stiffness(const Model& model, const Adjacency& adjacency);

    std::vector<char> asked_;           ///< by block: bounds are of these
    std::vector<char> near_;            ///< by block: asked, or in contact with one that is
    // By block; of a joined block: those of the whole body.
    std::vector<Vec3> centroid_;
    std::vector<double> gyration2_;     ///< least moment of inertia over mass
    std::vector<double> body_mass_;     ///< of joined blocks
    std::vector<char> held_;
    std::vector<double> root_of_block_; ///< one over the root of the mass, 0 for what cannot move
    std::vector<double> root_of_gridpoint_;
    std::vector<ContactSums> sums_;     ///< by contact; of contacts between rigid blocks
    std::vector<double> coupling_;      ///< by sub-contact; of contacts of deformable blocks
    BodyStiffness stiffness_;
};

} // namespace kaya
