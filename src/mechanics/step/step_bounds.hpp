// Bounds of the highest frequency of the model, body by body: docs/theory/time-step.md.
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/contact/contact_stiffness.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/step/step_matrix.hpp"
#include "model/tables/model.hpp"

#include <array>
#include <limits>
#include <vector>

namespace kaya {

/// Quantities that limit the time step of one body.
struct Resistance {
    double elastic = 0; ///< bound of the largest eigenvalue of stiffness over mass, 1/time^2
    double viscous = 0; ///< the same of the dashpots, 1/time

    /// The largest stable step by equation (6) of docs/theory/time-step.md; infinite when nothing resists.
    double stable_step() const;
    /// Factor of the mass that makes `step` the largest stable one; it increases with both parts.
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

/// Masses that a bound uses.
enum class Masses { real, inertial };

/// Resistances of each body by equation (9) of docs/theory/time-step.md, times its mass: 0 for immobile bodies. Independent of the inertial
/// masses.
struct BodyStiffness {
    std::vector<Resistance> of_gridpoint,
        of_block; ///< gridpoints of deformable blocks, rigid blocks; by row; joined blocks share that
                  ///< of their body by mass
};

/// Stiffness of the joints on the bodies. Derived from the model; kept to reuse its memory.
class StepBounds {
public:
    /// Bounds that a change of the marked contacts may have reduced: by equation (9) those of the bodies on them, by equation (4) those of
    /// their neighbours too.
    enum class Of { bodies, bodies_and_neighbours };

    /// Reads positions, tangent stiffnesses and areas of the sub-contacts from the model, and which bodies are held. Bounds then cover all
    /// bodies.
    void update(const Model& model, const Adjacency& adjacency, Of of = Of::bodies_and_neighbours);

    /// The same for these bodies; the bounds of others are unchanged. For single bodies limit() uses equation (9).
    void update_at(const Model& model, const Adjacency& adjacency, const std::vector<char>& contacts, Of of);

    /// Since the last update only inertial masses may have changed. With density scaling, the smaller of the bounds by equations (4) and
    /// (9). It may be smaller where all bodies allow a step of `enough`, but not smaller than that.
    StepLimit limit(const Model& model, const Adjacency& adjacency, Masses masses = Masses::inertial,
                    double enough = std::numeric_limits<double>::infinity());

    /// Stiffness of the bodies of the last update, with the dashpots for the inertial masses; 0 for others. It may be larger where rigid
    /// bodies still allow a step of `enough`.
    const BodyStiffness& stiffness(const Model& model, const Adjacency& adjacency,
                                   double enough = std::numeric_limits<double>::infinity());

    /// Estimate of the largest eigenvalue of the stiffness matrix over masses, with dashpots 2/step times as stiff: 1/time^2. The bound may
    /// be far above it where many joints act on a body in different directions. Costs as much as many cycles.
    double estimate(const Model& model, const Adjacency& adjacency, double step);

    /// Stiffness to use instead of the columns, by sub-contact; null: the columns.
    const std::vector<Springs>* foreseen = nullptr;
    /// Lame's constants by block; estimate() needs them where there are zones.
    const std::vector<ElasticConstants>* of_zones = nullptr;

private:
    /// Matrices of a rigid body, each contact's part multiplied by the share of its side.
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
    SpringsOfEight springs(const Model& model, Row first, const RowsOfEight& group,
                           const NormalAreaFactor& factor) const;
    SpringSums sums_of(const Model& model, Row contact) const;
    /// Multiples of its own part of a spring, and of the parallel dashpot, that a body bears: (a - b)^2 <= p a^2 + q b^2 with 1/p + 1/q =
    /// 1.
    struct Share {
        double elastic, viscous;
    };
    Share share(const Model& model, Row contact, Row sub_contact, int side, Shares shares) const;
    bool moves(const Model& model, Row contact, Row sub_contact, int side) const;
    double mobility(const Model& model, Row block, const Attachment& attachment) const;
    double mobility_of_node(const Model& model, Row node) const;
    void add_contact(const Model& model, const BodyFrame& frame, const ContactEntry& entry, Shares shares,
                     Matrices& matrices) const;
    Resistance with_neighbours(const Model& model, const Adjacency& adjacency, Row row) const;
    /// A coarser bound where it allows a step of `enough`: for bodies that do not limit the step.
    Resistance of_block(const Model& model, const Adjacency& adjacency, Row row, Shares shares,
                        double enough = std::numeric_limits<double>::infinity()) const;
    Resistance of_gridpoint(const Model& model, const Adjacency& adjacency, Row row, Shares shares) const;
    StepLimit smallest(const Model& model, const Adjacency& adjacency, Shares shares, double enough) const;

    bool damped_ = false;
    bool alone_ = false;              ///< bounds need none of the neighbours
    std::vector<char> asked_;         ///< by block: bounds are of these
    std::vector<char> near_;          ///< by block: asked, or in contact with one that is
    std::vector<Row> body_;           ///< by block: of joined rigid blocks the row in Adjacency::bodies, else no_row
    std::vector<BodyFrame> frames_;   ///< by block; of joined ones at the first
    std::vector<Row> lead_;           ///< by block: itself or the first of those that it is joined to
    std::vector<std::uint8_t> fixed_; ///< by block; of joined ones at the first, for all
    std::vector<std::array<SpringMatrix, 2>> matrices_; ///< by contact between rigid blocks, on each of the two
    std::vector<SpringSums> sums_; ///< the same contacts' springs, where bounds are alone or dashpots ask for them
    std::vector<Beta> beta_;       ///< by contact
    std::vector<Resistance> resistance_;       ///< by block: about its largest eigenvalue without its neighbours
    std::vector<double> root_of_gridpoint_;    ///< 1 over the root of the mass, 0 for what cannot move
    std::vector<double> zone_part_;            ///< by gridpoint
    std::vector<Resistance> point_resistance_; ///< by gridpoint
    BodyStiffness stiffness_;
};

} // namespace kaya
