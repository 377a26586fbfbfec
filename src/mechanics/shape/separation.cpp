#include "mechanics/shape/separation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace kaya {

namespace {

/// Axes closer to the separating one than this are not lateral.
constexpr double cos_across = 0.5;

using Arc = SeparationScratch::Arc;

void arcs_of(const Surfaces& surfaces, Row block, double sense, std::vector<Arc>& arcs) {
    arcs.clear();
    for (const auto& e : surfaces.edges(block)) {
        const Vec3 a = sense * surfaces.normal(e.faces[0]), b = sense * surfaces.normal(e.faces[1]);
        arcs.push_back({a, b, b.cross(a), e.ends});
    }
}

/// Edges form a face of the Minkowski difference only where their arcs cross. The second block's normals are reversed.
bool cross(const Arc& one, const Arc& two) {
    const double from = two.from.dot(one.axis), to = two.to.dot(one.axis);
    if (from * to >= 0) return false;
    const double first = one.from.dot(two.axis), last = one.to.dot(two.axis);
    return first * last < 0 && from * last > 0;
}

/// The face of a block that points most along a direction.
void find_opposite(const Model& model, const Surfaces& surfaces, Row block, const Vec3& direction, Separation& s) {
    s.cosine = -2;
    const Lanes3 along = four_times(direction);
    const Span faces = model.blocks.faces[block];
    Row f = faces.first;
    for (const auto& four : surfaces.planes(block)) {
        const Lanes cosines = four.normal.dot(along);
        for (int i = 0; i < lane_count && f < faces.end(); ++i, ++f) {
            if (cosines[i] <= s.cosine + 1e-12) continue;
            s.cosine = cosines[i];
            s.opposite = f;
        }
    }
}

/// The face or the edges that gave a contact its normal.
struct OldAxis {
    Row face = no_row;
    std::array<Row, 2> edge1{no_row, no_row}, edge2{no_row, no_row};

    OldAxis(const Model& model, Row contact) {
        if (contact == no_row) return;
        const auto& contacts = model.contacts;
        const int reference = contacts.reference[contact];
        if (reference == 1) face = contacts.face1[contact];
        if (reference == 2) face = contacts.face2[contact];
        if (reference != 0 || contacts.sub_contacts[contact].count == 0) return;
        const Row s = contacts.sub_contacts[contact].first;
        const auto &one = model.sub_contacts.side1[s].gridpoints, &two = model.sub_contacts.side2[s].gridpoints;
        edge1 = {one[0], one[1]};
        edge2 = {two[0], two[1]};
    }
    bool is(Row f) const { return f == face; }
    bool is(const std::array<Row, 2>& one, const std::array<Row, 2>& two) const { return one == edge1 && two == edge2; }
};

/// Distances of each of two blocks from the planes of the other's faces: first an upper bound from the centroid of the block, then the
/// vertices where that does not decide.
class FaceDistances {
public:
    FaceDistances(const Surfaces& surfaces, Row block1, Row block2, SeparationScratch& scratch)
        : distances_(scratch.distances), found_(scratch.found) {
        const std::size_t size = lane_count * (surfaces.planes(block1).size() + surfaces.planes(block2).size());
        if (size > distances_.size()) {
            distances_.resize(size);
            found_.resize(size);
        }
        std::fill_n(found_.begin(), size, char{0});
    }
    /// The bounds of a block's faces, from index `first` on; returns the face with the highest one.
    std::size_t bound(const Surfaces& surfaces, Row own, const Vec3& centre, std::size_t first) {
        const Lanes3 there = four_times(centre);
        double* next = distances_.data() + first;
        for (const auto& four : surfaces.planes(own)) {
            store(next, four.normal.dot(there) - four.reach);
            next += lane_count;
        }
        double* const begin = distances_.data() + first;
        return first + static_cast<std::size_t>(std::max_element(begin, next) - begin);
    }
    double at_most(std::size_t i) const { return distances_[i]; }
    double find(const Surfaces& surfaces, std::size_t i, Row face, Row other) {
        if (found_[i]) return distances_[i];
        found_[i] = 1;
        return distances_[i] = lowest(surfaces.vertices(other), surfaces.normal(face)) - surfaces.reach(face);
    }

private:
    std::vector<double>& distances_;
    std::vector<char>& found_;
};

/// The search for one pair of blocks.
class SeparationSearch {
public:
    SeparationSearch(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                     const SeparationLimits& limits, SeparationScratch& scratch)
        : model_(model), surfaces_(surfaces), block1_(block1), block2_(block2), limits_(limits), scratch_(scratch),
          old_axis_(model, limits.old), along_(surfaces, block1, block2, scratch),
          of_block1_(lane_count * surfaces.planes(block2).size()) {}
    Separation run() {
        // The lower block (block 2) first: at a tie its face gives the normal.
        try_faces(false);
        if (best_.distance > limits_.enough) return best_;
        // Most neighbours in a pile touch at edges and corners of coplanar faces: no face contact is possible.
        best_.apart_sideways = overhangs(false);
        if (best_.apart_sideways) {
            find_opposite(model_, surfaces_, block1_, best_.normal, best_);
            if (best_.cosine > limits_.flat) return best_;
        }
        try_faces(true);
        if (best_.distance > limits_.enough || best_.normal.isZero(0)) return best_;
        best_.apart_sideways = overhangs(false) || overhangs(true);

        // For two parallel faces no pair of edges separates the blocks much better, unless they overlap so deeply that they are adjacent
        // blocks whose edges meet.
        if (best_.face1 == no_row) find_opposite(model_, surfaces_, block1_, best_.normal, best_);
        else find_opposite(model_, surfaces_, block2_, -best_.normal, best_);
        if (best_.cosine <= limits_.flat || is_deep()) try_edges();
        return best_;
    }

private:
    void try_faces(bool of_first);
    bool overhangs(bool of_first);
    bool is_deep() const {
        return best_.distance < -limits_.stay && !model_.blocks.deformable[block1_] &&
               !model_.blocks.deformable[block2_];
    }
    void try_edges();
    bool try_edge_pair(const Arc& e1, const Arc& e2, const Vec3& d1, const Vec3& towards);

    const Model& model_;
    const Surfaces& surfaces_;
    Row block1_, block2_;
    const SeparationLimits& limits_;
    SeparationScratch& scratch_;
    OldAxis old_axis_;
    FaceDistances along_; ///< the faces' normals, block 2 first
    std::size_t of_block1_;
    Separation best_;
    double best_score_ = best_.distance; ///< distance, and more for the axis that was the best before
};

void SeparationSearch::try_faces(bool of_first) {
    const Row own = of_first ? block1_ : block2_, other = of_first ? block2_ : block1_;
    const Span faces = model_.blocks.faces[own];
    const std::size_t start = of_first ? of_block1_ : 0;
    // No vertex need be checked where another face is farther away.
    const std::size_t likely = along_.bound(surfaces_, own, surfaces_.middle(other), start);
    const double least =
        along_.find(surfaces_, likely, faces.first + static_cast<Row>(likely - start), other) - limits_.tie;
    std::size_t i = start;
    for (Row f = faces.first; f < faces.end(); ++f, ++i) {
        const double bonus = old_axis_.is(f) ? limits_.stay : 0, at_most = along_.at_most(i);
        if (at_most <= limits_.enough && (at_most + bonus <= best_score_ || at_most + bonus < least)) continue;
        const double distance = along_.find(surfaces_, i, f, other);
        if (distance > limits_.enough || distance + bonus > best_score_ + (best_.normal.isZero(0) ? 0 : limits_.tie)) {
            best_score_ = distance + bonus;
            best_.distance = distance;
            best_.normal = of_first ? surfaces_.normal(f) : Vec3(-surfaces_.normal(f));
            best_.face1 = of_first ? f : no_row;
            best_.face2 = of_first ? no_row : f;
        }
        if (best_.distance > limits_.enough) return;
    }
}

/// Whether the other block ends at a side of this one.
bool SeparationSearch::overhangs(bool of_first) {
    std::size_t i = of_first ? of_block1_ : 0;
    const Span faces = model_.blocks.faces[of_first ? block1_ : block2_];
    for (Row f = faces.first; f < faces.end(); ++f, ++i)
        if (-along_.at_most(i) <= limits_.sliver && std::abs(surfaces_.normal(f).dot(best_.normal)) < cos_across &&
            -along_.find(surfaces_, i, f, of_first ? block2_ : block1_) <= limits_.sliver)
            return true;
    return false;
}

void SeparationSearch::try_edges() {
    const Vec3 towards = surfaces_.middle(block2_) - surfaces_.middle(block1_);
    auto &arcs1 = scratch_.arcs1, &arcs2 = scratch_.arcs2;
    arcs_of(surfaces_, block1_, 1, arcs1);
    arcs_of(surfaces_, block2_, -1, arcs2);
    const auto& x = model_.gridpoints.position;
    for (const auto& e1 : arcs1) {
        const Vec3 d1 = x[e1.ends[1]] - x[e1.ends[0]];
        for (const auto& e2 : arcs2)
            if (cross(e1, e2) && try_edge_pair(e1, e2, d1, towards)) return;
    }
}

/// Returns whether the blocks are too far apart to matter. `d1` is along the edge of block 1.
bool SeparationSearch::try_edge_pair(const Arc& e1, const Arc& e2, const Vec3& d1, const Vec3& towards) {
    const auto& x = model_.gridpoints.position;
    const Vec3 d2 = x[e2.ends[1]] - x[e2.ends[0]];
    Vec3 axis = d1.cross(d2);
    const double length = axis.norm();
    if (length <= 1e-6 * d1.norm() * d2.norm()) return false;
    axis /= length;
    if (axis.dot(towards) < 0) axis = -axis;
    const double high1 = -lowest(surfaces_.vertices(block1_), -axis);
    if (axis.dot(x[e1.ends[0]]) < high1 - limits_.tie) return false; // not an outermost edge
    const double low2 = lowest(surfaces_.vertices(block2_), axis);
    if (axis.dot(x[e2.ends[0]]) > low2 + limits_.tie) return false;
    const double distance = low2 - high1, score = distance + (old_axis_.is(e1.ends, e2.ends) ? limits_.stay : 0);
    double margin = best_.edge1[0] == no_row ? limits_.clear : limits_.tie;
    if (best_.edge1[0] == no_row && best_.cosine > limits_.flat) { // only across the faces, and see is_deep
        constexpr double across = 0.5;
        if (std::abs(axis.dot(best_.normal)) > across) return false;
        margin = limits_.stay;
    }
    if (!(distance > limits_.enough || score > best_score_ + margin)) return false;
    best_score_ = score;
    best_.distance = distance;
    best_.normal = axis;
    best_.face1 = best_.face2 = no_row;
    best_.edge1 = e1.ends;
    best_.edge2 = e2.ends;
    return best_.distance > limits_.enough;
}

} // namespace

Separation find_separation(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                           const SeparationLimits& limits, SeparationScratch& scratch) {
    return SeparationSearch(model, surfaces, block1, block2, limits, scratch).run();
}

} // namespace kaya
