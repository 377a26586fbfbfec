// Bounds of the highest frequency of the model, body by body: docs/theory/time-step.md.
#pragma once

#include "mechanics/adjacency.hpp"
#include "mechanics/contact_stiffness.hpp"
#include "mechanics/dashpots.hpp"
#include "mechanics/step_matrix.hpp"
#include "model/model.hpp"

#include <array>
#include <limits>
#include <vector>

namespace kaya {

/// What limits the time step of one body.
struct Resistance {
    double elastic = 0; ///< bound of the largest eigenvalue of stiffness over mass, 1/time^2
    double viscous = 0; ///< the same of the dashpots, 1/time

    /// The largest stable step by equation (6) of docs/theory/time-step.md; infinite when nothing resists.
    double stable_step() const;
    /// What the mass must be multiplied with to make `step` the largest stable one, which grows with both parts.
    double needed_for(double step) const { return 0.25 * step * (step * elastic + 2 * viscous); }
    bool acts() const { return elastic > 0 || viscous > 0; }
    void add(const Resistance& other) {
        elastic += other.elastic;
        viscous += other.viscous;
    }
    Resistance over(double mass) const { return {elastic / mass, viscous / mass}; }
};

struct ElasticConstants;

/// The body that limits the time step.
struct StepLimit {
    double stable = std::numeric_limits<double>::infinity(); ///< the largest stable step
    bool of_block = false;
    Row row = no_row;         ///< gridpoint or rigid block, the first one of joined blocks
    double part_of_zones = 0; ///< in its stiffness

    bool exists() const { return row != no_row; }
};

/// Masses that a bound goes by.
enum class Masses { real, inertial };

/// Resistances of each body by equation (9) of docs/theory/time-step.md, times its mass: 0 for what cannot move. They hold
/// whatever the inertial masses are.
struct BodyStiffness {
    std::vector<Resistance> of_gridpoint,
        of_block; ///< gridpoints of deformable blocks, rigid blocks; by row; joined blocks share that
                  ///< of their body by mass
};

/// What the joints hold the bodies with. Everything in it is derived from the model; it is kept for its memory.
class StepBounds {
public:
    /// Takes places, tangent stiffnesses and areas of the sub-contacts from the model, and which bodies are held.
    /// Bounds are then those of all bodies.
    void update(const Model& model, const Adjacency& adjacency);

    /// Bounds that a change of the marked contacts may have made smaller: by equation (9) those of the bodies on them, by
    /// equation (4) those of their neighbours too.
    enum class Of { bodies, bodies_and_neighbours };

    /// The same for these bodies: the bounds of others are what they were. Of bodies alone limit() is by equation (9).
    void update_at(const Model& model, const Adjacency& adjacency, const std::vector<char>& contacts, Of of);

    /// Since the last update only inertial masses may have changed. Where density is scaled it is the smaller one of
    /// the bounds by equations (4) and (9).
    StepLimit limit(const Model& model, const Adjacency& adjacency, Masses masses = Masses::inertial);

    /// Of the bodies of the last update, with the dashpots that belong to the inertial masses; of others 0.
    const BodyStiffness& stiffness(const Model& model, const Adjacency& adjacency);

    /// About the largest eigenvalue of the stiffness matrix over masses, dashpots being 2/step times stiff: 1/time^2. The
    /// bound may be far above it where many joints pull a body in different directions; costs as much as many cycles.
    double estimate(const Model& model, const Adjacency& adjacency, double step);

    /// Stiffness to go by instead of that which the columns have, by sub-contact; none: the columns.
    const std::vector<Springs>* foreseen = nullptr;
    /// Lame's constants by block; estimate() needs them where there are zones.
    const std::vector<ElasticConstants>* of_zones = nullptr;

private:
    /// A rigid body's matrices, each contact's part multiplied with what its side bears.
    struct Matrices {
        SpringMatrix elastic, viscous;
    };
    class Operator;
    enum class Shares { none, by_resistance, halves };

    void compute(const Model& model, const Adjacency& adjacency);
    void find_frames(const Model& model, const Adjacency& adjacency, Masses masses);
    void find_matrices(const Model& model);
    void find_resistances(const Model& model, const Adjacency& adjacency, Masses masses);
    Springs springs(const Model& model, Row sub_contact, const NormalAreaFactor& factor) const;
    SpringSums sums_of(const Model& model, Row contact) const;
    /// How many times its own part of a spring, and of the dashpot beside it, a body is charged with:
    /// (a - b)^2 <= p a^2 + q b^2 with 1/p + 1/q = 1.
    struct Share {
        double elastic, viscous;
    };
    Share share(const Model& model, Row contact, Row sub_contact, int side, Shares shares) const;
    bool moves(const Model& model, Row contact, Row sub_contact, int side) const;
    double mobility(const Model& model, Row block, const Attachment& attachment) const;
    double mobility_of_node(const Model& model, Row node) const;
    void add_contact(const Model& model, const BodyFrame& frame, const ContactEntry& entry, Shares shares,
                     Matrices& matrices) const;
    Resistance of_block(const Model& model, const Adjacency& adjacency, Row row, Shares shares) const;
    Resistance of_gridpoint(const Model& model, const Adjacency& adjacency, Row row, Shares shares) const;
    StepLimit smallest(const Model& model, const Adjacency& adjacency, Shares shares) const;

    bool damped_ = false;
    bool alone_ = false;              ///< bounds do not ask for those of neighbours
    std::vector<char> asked_;         ///< by block: bounds are of these
    std::vector<char> near_;          ///< by block: asked, or in contact with one that is
    std::vector<Row> body_;           ///< by block: of joined rigid blocks the row in Adjacency::bodies, else no_row
    std::vector<BodyFrame> frames_;   ///< by block; of joined ones at the first
    std::vector<Row> lead_;           ///< by block: itself or the first of those that it is joined to
    std::vector<std::uint8_t> fixed_; ///< by block; of joined ones at the first, for all
    std::vector<std::array<SpringMatrix, 2>> matrices_; ///< by contact between rigid blocks, on each of the two
    std::vector<SpringSums> sums_;                      ///< the same contacts' springs, where dashpots ask for them
    std::vector<Beta> beta_;                            ///< by contact
    std::vector<Resistance> resistance_;       ///< by block: about its largest eigenvalue without its neighbours
    std::vector<double> root_of_gridpoint_;    ///< 1 over the root of the mass, 0 for what cannot move
    std::vector<double> zone_part_;            ///< by gridpoint
    std::vector<Resistance> point_resistance_; ///< by gridpoint
    BodyStiffness stiffness_;
};

} // namespace kaya
