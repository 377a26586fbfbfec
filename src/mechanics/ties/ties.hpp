// Ties between joined blocks with zones, at work: docs/theory/ties.md.
// reads: gridpoints.velocity, gridpoints.position, gridpoints.mass, zones.stress, ties.gridpoints
// writes: ties.force, ties.dashpot, gridpoints.velocity, gridpoints.force, gridpoints.zone_frequency
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "model/tables/model.hpp"

#include <array>
#include <span>
#include <vector>

namespace kaya {

/// Updates the ties for the present bodies and meshes: invalid ones are removed, and bodies without ties get them where faces of their
/// blocks are in contact. Where all corners of the two meshes coincide, gridpoints are tied exactly; elsewhere springs at the corners of
/// the common refinement hold the faces, initially with the forces of the stresses in the zones behind them.
void make_ties(Model& model);

/// Gives springs between zones that are both in the list (ascending rows) the forces of the stresses there.
void set_tie_tractions(Model& model, const std::vector<Row>& zones);

/// Data derived from the ties: rows, sums and stiffnesses.
class TieLists {
public:
    TieLists() = default;
    /// `elastic` has one entry per block.
    TieLists(const Model& model, const std::vector<ElasticConstants>& elastic);

    /// Gridpoints that move as one, as groups; members in ascending order.
    std::size_t groups() const { return start_.size() - 1; }
    std::span<const Row> members(std::size_t group) const {
        return {members_.data() + start_[group], start_[group + 1] - start_[group]};
    }
    bool in_group(Row gridpoint) const { return !grouped_.empty() && grouped_[gridpoint]; }
    /// The constraints of a group: the rollers of all its members.
    const Roller& roller(std::size_t group) const { return rollers_[group]; }

    /// A spring: rows of the gridpoints of its two triangles, its stiffness, force/length, and the means that hold it, with their weights.
    struct Spring {
        Row tie;
        std::array<Attachment, 2> side;
        double stiffness;
        std::array<Row, 3> mean;
        std::array<double, 3> part;
    };
    const std::vector<Spring>& springs() const { return springs_; }

    /// A spring of a mean of relative displacements: at a gridpoint of the side of two faces that has more of them.
    struct Member {
        Row spring;
        double part; ///< the parts of a mean sum to 1
    };
    const Lists<Member>& means() const { return means_; }

    /// The part of a spring's force on the second block that acts on a gridpoint.
    struct Share {
        Row tie;
        double weight;
    };
    bool any_shares() const { return !shares_.entries.empty(); }
    std::span<const Share> shares(Row gridpoint) const {
        if (shares_.entries.empty()) return {};
        return {shares_.begin(gridpoint), shares_.end(gridpoint)};
    }

private:
    void find_groups(const Model& model);
    void find_springs(const Model& model, const std::vector<ElasticConstants>& elastic);
    void find_means(std::size_t first, std::vector<double>& areas);

    std::vector<std::size_t> start_{0};
    std::vector<Row> members_;
    std::vector<char> grouped_; ///< by gridpoint; empty when there are none
    std::vector<Roller> rollers_;
    std::vector<Spring> springs_;
    Lists<Member> means_;
    Lists<Share> shares_;
};

/// Adds the springs at a gridpoint, as a bound of their part of the squared frequency with the true mass, to Gridpoints::zone_frequency.
void add_tie_frequencies(Model& model, const TieLists& ties);

/// Relative displacements in a step, of springs and their means; the memory is reused.
struct TieScratch {
    std::vector<Vec3> shift, mean;
};

/// Reads gridpoint motion; writes the forces of the springs.
ZoneSums run_ties(Model& model, const TieLists& ties, TieScratch& scratch);

/// Members of a group with a prescribed member get its velocity, as apply_velocity_histories does for that member.
HistorySums follow_prescribed(Model& model, const TieLists& ties);

/// Distributes the forces of a group to its members: by mass where it is free, so that all have equal accelerations; in held directions
/// the held members carry all. Sums over the group are unchanged.
void share_forces(Model& model, std::span<const Row> members);

} // namespace kaya
