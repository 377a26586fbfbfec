#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/contact/contact_search.hpp"

#include "base/parallel.hpp"
#include "base/stop_point.hpp"
#include "mechanics/contact/contact_geometry.hpp"
#include "mechanics/contact/contact_slip.hpp"
#include "mechanics/contact/fine_places.hpp"
#include "mechanics/shape/corner_joints.hpp"
#include "mechanics/contact/open_corner.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/shape/overlap_gap.hpp"
#include "model/edit/bounded.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/block_box.hpp"
#include "model/measure/measure.hpp"
#include "model/edit/ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace kaya {

namespace {

/// Contacts that have slid farther than this part of their size get new geometry together, once in several cycles: updating the tables
/// costs as much for one contact as for many. A contact that has slid far relative to its blocks is updated at once.
constexpr double slide_tolerance = 1e-3;
constexpr std::int64_t slide_interval = 8;
constexpr double far_slide = 2; ///< in parts of the margin
/// Blocks that have moved this part of their margins are checked together, once in several cycles. When a block is checked depends on the
/// block and the cycle only: an unrelated block far away changes no bit of its motion.
constexpr double moved_part = 0.35;
constexpr std::int64_t search_interval = 16;
/// A fast block is checked with the others: its contacts are searched as far ahead as it moves until then, but at most this many margins.
constexpr double farthest_ahead = 20;
constexpr std::size_t grain = 32;

/// The farthest a block can move until the next possible search, one step.
double travel_of_a_step(const Model& model, Row b) {
    double fastest = 0;
    for (Row g = model.blocks.gridpoints[b].first; g < model.blocks.gridpoints[b].end(); ++g)
        fastest = std::max(fastest, gridpoint_velocity(model, g).squaredNorm());
    return std::sqrt(fastest) * model.clock.time_step;
}

/// Whether a block, at its present speed, uses up its half margin before the next check.
bool is_fast(const Model& model, Row b, double shift) {
    return search_interval * shift > (0.5 - moved_part) * model.blocks.margin[b];
}

/// The distance a block may move beyond half its margin before its next check. The parallel faces are those of the last check, so a rolling
/// block does not search ahead.
double travel_ahead(const Model& model, Row b, double shift) {
    constexpr double rolling = 3e-3; // angle
    if (search_interval * model.clock.time_step * model.blocks.rotational_velocity[b].norm() > rolling) return 0;
    return is_fast(model, b, shift) ? std::min(search_interval * shift, farthest_ahead * model.blocks.margin[b]) : 0;
}

/// The farthest a block may be beyond half its margin at its next check: the allowance of the last check plus one step.
double travel_beyond(const Model& model, Row b) {
    return 2 * travel_of_a_step(model, b) - std::min(0.0, model.blocks.travelled[b]);
}

/// The largest distance of two blocks that still get a contact: it must exist before either block arrives.
double reach(const Model& model, const std::vector<double>& beyond, Row b1, Row b2) {
    const auto& margin = model.blocks.margin;
    return 0.5 * (margin[b1] + margin[b2]) + beyond[b1] + beyond[b2];
}

/// The widest gap across which a contact carries force, as a dilated joint does.
double widest_gap(const Model& model, Row contact) {
    const auto& s = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    if (model.contacts.kind[contact] == ContactKind::overlap)
        return model.contacts.depth[contact] > 0 ? std::max(0.0, model.contacts.offset[contact]) : 0;
    double gap = 0;
    for (Row row = span.first; row < span.end(); ++row) {
        if (s.normal_force[row] == 0 || !s.side1[row].attached() || !s.side2[row].attached()) continue;
        gap = std::max(gap, gap_of_sides(model, row));
    }
    return gap;
}

/// The contact of two blocks, given their present one, which is kept across a gap that carries force.
bool update_geometry(const Model& model, const Surfaces& surfaces, Row b1, Row b2, Row contact, FinePlaces fine,
                     double margin, ContactGeometry& geometry, SearchScratch& scratch) {
    // Where faces are still parallel, their distance is not needed.
    const bool found = find_geometry(model, surfaces, b1, b2, contact, fine, margin, geometry, scratch);
    if (contact == no_row || (found && geometry.type == ContactType::face_face)) return found;
    const double gap = widest_gap(model, contact);
    return gap > 0 ? find_geometry(model, surfaces, b1, b2, contact, fine, margin + 2 * gap, geometry, scratch) : found;
}

Box box_of(const Model& model, Row b, double margin) {
    const auto [low, high] = block_box(model, b);
    return {low - Vec3::Constant(margin), high + Vec3::Constant(margin)};
}

/// Two blocks that have each moved half the margin may have met.
bool is_due(const Model& model, std::size_t b) {
    const double margin = model.blocks.margin[b], travelled = model.blocks.travelled[b];
    if (model.clock.cycle % search_interval != 0) return travelled > 0.5 * margin;
    if (travelled > moved_part * margin) return true;
    const Row row = static_cast<Row>(b);
    const double shift = travel_of_a_step(model, row);
    return travel_ahead(model, row, shift) > 0 && travelled + search_interval * shift > 0.5 * margin;
}

bool apart(const Box& a, const Box& b) {
    return (a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any();
}

/// Two blocks that may be in contact, with their present contact.
struct Pair {
    Row block1, block2;
    Row old = no_row;
    bool is_due = true; ///< otherwise the contact stays as it is
};

/// Whether two blocks lie cornerwise: their boxes share no more than `sliver` along two axes, so there is no room for a common area. `part`
/// is the distance by which each box exceeds its block.
bool cornerwise(const Box& a, const Box& b, double part_a, double part_b, double sliver) {
    int narrow = 0;
    for (int k = 0; k < 3; ++k) {
        const double high = std::min(a.high[k] - part_a, b.high[k] - part_b);
        const double low = std::max(a.low[k] + part_a, b.low[k] + part_b);
        narrow += high - low <= sliver;
    }
    return narrow >= 2;
}

/// Pairs to be checked and contacts that stay unchanged; sorted like the contacts and the near pairs.
std::vector<Pair> pairs_of(const Model& model, const std::vector<std::array<int, 2>>& near,
                           const std::vector<Box>& boxes, const std::vector<double>& beyond,
                           const std::vector<char>& moved) {
    const auto& contacts = model.contacts;
    const auto& margin = model.blocks.margin;
    const TiedBlocks tied(model);
    // The common width of moving blocks may grow before the next check.
    const auto adjacent = [&](int a, int b) {
        const double sliver = narrowest_contact(model, a, b) - (beyond[a] + beyond[b]);
        return cornerwise(boxes[a], boxes[b], margin[a] + beyond[a], margin[b] + beyond[b], sliver);
    };
    std::vector<Pair> pairs;
    pairs.reserve(near.size() + contacts.size());
    std::size_t c = 0;
    const auto blocks_of = [&](std::size_t row) {
        return std::array<int, 2>{contacts.block1[row], contacts.block2[row]};
    };
    const auto add = [&](const std::array<int, 2>& pair, Row old) {
        if (joined(model, pair[0], pair[1]) && (!model.blocks.deformable[pair[0]] || tied.contains(pair[0], pair[1])))
            return;
        const bool due = moved[pair[0]] || moved[pair[1]];
        if (due || old != no_row) pairs.push_back({pair[0], pair[1], old, due});
    };
    for (const auto& pair : near) {
        for (; c < contacts.size() && blocks_of(c) < pair; ++c) add(blocks_of(c), static_cast<Row>(c));
        if (c < contacts.size() && blocks_of(c) == pair) {
            add(pair, static_cast<Row>(c));
            ++c;
        } else if (!apart(boxes[pair[0]], boxes[pair[1]]) && !adjacent(pair[0], pair[1])) {
            add(pair, no_row);
        }
    }
    for (; c < contacts.size(); ++c) add(blocks_of(c), static_cast<Row>(c));
    return pairs;
}

/// Points of a future overlap: where the blocks meet when they approach by this part of the margin.
constexpr double contact_depth = 1e-3;

void add_overlap_points(const Model& model, Row b1, Row b2, ContactGeometry& geometry, OverlapScratch& scratch) {
    ClosureOffset offset;
    offset.closure =
        std::max(0.0, geometry.gap) + contact_depth * std::min(model.blocks.margin[b1], model.blocks.margin[b2]);
    const double least = geometry.least_area;
    const OverlapPatch patch = overlap_patch(model, {b1, b2, no_row, no_row, least}, geometry.normal, offset, scratch);
    geometry.position =
        patch.carried > 0 ? patch.centre : 0.5 * (model.blocks.centroid[b1] + model.blocks.centroid[b2]);
    geometry.area = least;
    for (Row k = 0; k < carriers; ++k) {
        ContactPoint& point = geometry.points.add();
        point.position = geometry.position;
        point.gap = geometry.gap;
        point.area = least / carriers;
        point.type = SubContactType::face_face;
        const Row g1 = model.blocks.gridpoints[b1].first, g2 = model.blocks.gridpoints[b2].first;
        point.side1 = {{g1, g1, g1}, {1, 0, 0}};
        point.side2 = {{g2, g2, g2}, {1, 0, 0}};
    }
}

bool any_row_pulls(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    const double* const force = model.sub_contacts.normal_force.data();
    return std::any_of(force + span.first, force + span.end(), [](double f) { return f < 0; });
}

/// An overlap that is closed over most of its area may become a joint, unless it rolls: a joint follows small rotations only.
bool may_close(const Model& model, Row contact) {
    constexpr double part = 0.4;     // a joint about to open carries on half of its area, which is rounded up
    constexpr double rolling = 0.25; // of the depth, during two check intervals
    const auto& contacts = model.contacts;
    if (!(contacts.depth[contact] > 0 && contacts.area[contact] > part * contacts.stiffness_area[contact]))
        return false;
    const auto& spin = model.blocks.rotational_velocity;
    const Vec3 turn =
        2 * slide_interval * model.clock.time_step * (spin[contacts.block2[contact]] - spin[contacts.block1[contact]]);
    return turn.cross(contacts.normal[contact]).norm() * std::sqrt(contacts.area[contact]) <
               rolling * contacts.depth[contact] &&
           !has_open_corner(model, contact);
}

/// Whether every point of the future joint is well closed by the present overlap, and the joint would carry the same force with the same
/// energy.
bool closes_everywhere(const Model& model, const JointRegistry& joints, Row contact, const ContactGeometry& geometry) {
    const auto& contacts = model.contacts;
    const Vec3& origin = model.blocks.centroid[contacts.block1[contact]];
    constexpr double same = 0.02; // faces that interlock at their edges would form a joint of smaller area
    double volume = 0, square = 0;
    const bool curved = contacts.curved[contact] != 0;
    std::vector<PlaceAhead> places;
    for (const ContactPoint& p : geometry.points) {
        const double closure =
            contacts.offset[contact] + contacts.offset_tilt[contact].dot(p.position - origin) - p.gap;
        if (!(closure > least_closure * contacts.depth[contact])) return false;
        volume += p.area * closure;
        square += p.area * closure * closure;
        if (curved) places.push_back({p.area, closure});
    }
    if (curved) {
        const JointModel* joint = joints.find(model.joint_properties[contacts.properties[contact]].model);
        return joint != nullptr && closes_alike(model, *joint, contact, places);
    }
    const double carried = contacts.area[contact] * contacts.depth[contact];
    return std::abs(volume - carried) <= same * carried &&
           std::abs(square - 2 * contacts.energy_length[contact] * carried) <= 2 * same * square;
}

/// Faces that will meet over their whole area.
bool is_parallel(const ContactGeometry& geometry) {
    constexpr double same = 1e-9; // of the size
    const auto [low, high] =
        std::minmax_element(geometry.points.begin(), geometry.points.end(),
                            [](const ContactPoint& a, const ContactPoint& b) { return a.gap < b.gap; });
    return high->gap - low->gap <= same * std::sqrt(geometry.area);
}

/// Whether faces do not touch yet. What will meet there is not known: neighbours of these faces may meet first, or as well.
bool are_apart(const Model& model, Row b1, Row b2, const ContactGeometry& geometry) {
    const double rounding = rounding_of_gap(model, b1, b2);
    return std::all_of(geometry.points.begin(), geometry.points.end(),
                       [&](const ContactPoint& p) { return p.gap > rounding; });
}

/// Whether blocks have rolled onto other faces. The closure of these faces says nothing about the force that there is: a joint that changed
/// its faces would make energy.
bool is_of_other_faces(const Model& model, Row contact, const ContactGeometry& geometry) {
    return geometry.face1 != model.contacts.face1[contact] || geometry.face2 != model.contacts.face2[contact];
}

/// The kind of contact of two rigid blocks. A joint that opens in part, or goes over to other faces, becomes an overlap, an overlap closed
/// everywhere becomes a joint; a joint in tension keeps its kind.
DraftKind kind_of_rigid(const Model& model, const JointRegistry& joints, Row b1, Row b2, Row old, bool moving,
                        ContactGeometry& geometry, OverlapScratch& scratch) {
    const bool in_place = !model.settings.large_strain;
    if (old == no_row) {
        const bool as_joint = geometry.kind == ContactKind::joint && // an overlap has no points yet
                              (in_place || is_parallel(geometry) || stands_on_corners(model, b1, b2) ||
                               (!moving && !are_apart(model, b1, b2, geometry)));
        if (as_joint) return DraftKind::new_geometry;
        if (geometry.kind == ContactKind::joint) geometry.whole_area = geometry.area;
        geometry.kind = ContactKind::overlap;
        geometry.points.clear();
        add_overlap_points(model, b1, b2, geometry, scratch);
        return DraftKind::overlap;
    }
    const bool was_joint = model.contacts.kind[old] == ContactKind::joint;
    if (geometry.kind == ContactKind::overlap)
        return was_joint && !any_row_pulls(model, old) ? DraftKind::overlap : DraftKind::as_it_was;
    if (was_joint) {
        const bool rolls = moving && !in_place && is_of_other_faces(model, old, geometry);
        return rolls && !any_row_pulls(model, old) && !stands_on_corners(model, b1, b2) ? DraftKind::overlap
                                                                                        : DraftKind::new_geometry;
    }
    return may_close(model, old) && closes_everywhere(model, joints, old, geometry) ? DraftKind::new_geometry
                                                                                    : DraftKind::as_it_was;
}

double strength_of(const Model& model, const std::vector<double>& strengths, Row contact) {
    const Row properties = model.contacts.properties[contact];
    return properties == no_row ? 0 : strengths[static_cast<std::size_t>(properties)];
}

/// Drafts of the pairs in contact; their points are in `found`.
std::vector<ContactDraft> find_all(const Model& model, const JointRegistry& joints, const Surfaces& surfaces,
                                   const std::vector<double>& strengths, const std::vector<double>& beyond,
                                   const std::vector<Pair>& pairs, bool moving, std::vector<FoundContacts>& found,
                                   PerThread<SearchScratch>& scratch_of) {
    found.resize(std::max(found.size(), (pairs.size() + grain - 1) / grain)); // existing entries keep their memory
    for (auto& part : found) part.clear();
    for_chunks(pairs.size(), grain, [&](std::size_t first, std::size_t last) {
        stop_point();
        FoundContacts& part = found[first / grain];
        SearchScratch& scratch = scratch_of.local();
        for (std::size_t i = first; i < last; ++i) {
            const auto& [block1, block2, old, due] = pairs[i];
            if (!due) {
                part.drafts.push_back({block1, block2, old, DraftKind::as_it_was, {}, {}});
                continue;
            }
            ContactGeometry geometry{{}, ContactPoints(part.points)};
            const FinePlaces fine =
                old == no_row ? FinePlaces::none : fine_places(model, old, strength_of(model, strengths, old));
            if (!update_geometry(model, surfaces, block1, block2, old, fine, reach(model, beyond, block1, block2),
                                 geometry, scratch)) {
                geometry.points.clear();
                continue;
            }
            const bool rigid = !model.blocks.deformable[block1] && !model.blocks.deformable[block2];
            const DraftKind kind =
                rigid ? kind_of_rigid(model, joints, block1, block2, old, moving, geometry, scratch.overlap)
                      : DraftKind::new_geometry;
            if (kind == DraftKind::as_it_was || (kind == DraftKind::overlap && old != no_row)) geometry.points.clear();
            part.drafts.push_back({block1, block2, old, kind, geometry, {part.points.data(), geometry.points.size()}});
        }
        part.close();
    });
    std::size_t count = 0;
    for (const auto& part : found) count += part.drafts.size();
    std::vector<ContactDraft> drafts;
    drafts.reserve(count);
    for (const auto& part : found) drafts.insert(drafts.end(), part.drafts.begin(), part.drafts.end());
    return drafts;
}

/// The blocks of the checked pairs, each once and in order.
std::vector<Row> blocks_due(const Model& model, const std::vector<Pair>& pairs) {
    std::vector<char> due(model.blocks.size(), 0);
    for (const auto& pair : pairs)
        if (pair.is_due) due[pair.block1] = due[pair.block2] = 1;
    std::vector<Row> blocks;
    for (std::size_t b = 0; b < due.size(); ++b)
        if (due[b]) blocks.push_back(static_cast<Row>(b));
    return blocks;
}

/// Merges the contacts that have not slid with those that have, the pairs, which are in `drafts` or have separated.
std::vector<ContactDraft> with_the_others(const Model& model, std::vector<ContactDraft> drafts,
                                          const std::vector<Pair>& slipped) {
    const auto& contacts = model.contacts;
    std::vector<ContactDraft> all;
    auto next = drafts.begin();
    auto pair = slipped.begin();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Row row = static_cast<Row>(c);
        if (pair == slipped.end() || pair->old != row) {
            all.push_back({contacts.block1[c], contacts.block2[c], row, DraftKind::as_it_was, {}, {}});
            continue;
        }
        ++pair;
        if (next != drafts.end() && next->old == row) all.push_back(std::move(*next++));
    }
    return all;
}

} // namespace

void FoundContacts::clear() {
    drafts.clear();
    points.clear();
}

void FoundContacts::close() {
    const ContactPoint* next = points.data();
    for (auto& draft : drafts) {
        draft.points = {next, draft.points.size()};
        next += draft.points.size();
    }
}

bool ContactSearch::due(const Model& model) {
    for (std::size_t b = 0; b < model.blocks.size(); ++b)
        if (is_due(model, b)) return true;
    return false;
}

ContactChange ContactSearch::search(Model& model, JointRegistry& joints, bool moving) {
    std::optional<StopListener> nobody;
    if (moving) nobody.emplace([] {}); // within a cycle, interruption waits for the end of the cycle
    auto& blocks = model.blocks;
    beyond_.resize(blocks.size());
    boxes_.resize(blocks.size());
    moved_.resize(blocks.size());
    for_chunks(blocks.size(), 8 * grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Row row = static_cast<Row>(b);
            moved_[b] = !moving || is_due(model, b);
            if (moved_[b]) blocks.travelled[b] = moving ? -travel_ahead(model, row, travel_of_a_step(model, row)) : 0;
            beyond_[b] = travel_beyond(model, row);
            boxes_[b] = box_of(model, row, blocks.margin[b] + beyond_[b]);
        }
    });
    if (!std::ranges::all_of(boxes_, [](const Box& box) { return is_bounded(box.low) && is_bounded(box.high); }))
        throw diverged(model);
    const std::vector<Pair> pairs = pairs_of(model, near_.of(boxes_), boxes_, beyond_, moved_);
    stop_point();
    surfaces_.update(model, blocks_due(model, pairs));
    strengths_ = tensile_strengths(model, joints);
    return replace_contacts(model, joints,
                            find_all(model, joints, surfaces_, strengths_, beyond_, pairs, moving, found_, scratch_),
                            moving, scratch_.local().overlap);
}

ContactChange ContactSearch::refresh_slipped(Model& model, JointRegistry& joints) {
    auto& contacts = model.contacts;
    const auto& margin = model.blocks.margin;
    const bool all_together = model.clock.cycle % slide_interval == 0, in_place = !model.settings.large_strain;
    if (in_place && !all_together) return ContactChange::none;
    if (strengths_.size() != model.joint_properties.size()) strengths_ = tensile_strengths(model, joints);
    const auto has_slipped = [&](std::size_t c) {
        if (contacts.kind[c] == ContactKind::overlap)
            return all_together && !in_place && may_close(model, static_cast<Row>(c));
        if (in_place || contacts.slip_since_update[c] * contacts.slip_since_update[c] <=
                            slide_tolerance * slide_tolerance * contacts.area[c]) {
            const double strength = all_together ? strength_of(model, strengths_, static_cast<Row>(c)) : 0;
            return strength > 0 && must_be_finer(model, static_cast<Row>(c), strength);
        }
        return all_together || contacts.slip_since_update[c] >
                                   far_slide * std::min(margin[contacts.block1[c]], margin[contacts.block2[c]]);
    };
    // Back-and-forth motion does not count as slip.
    for_chunks(contacts.size(), 8 * grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c)
            if (contacts.kind[c] == ContactKind::joint && has_slipped(c))
                contacts.slip_since_update[c] = slip_of(model, static_cast<Row>(c));
    });
    std::vector<Pair> pairs;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (has_slipped(c)) pairs.push_back({contacts.block1[c], contacts.block2[c], static_cast<Row>(c)});
    if (pairs.empty()) return ContactChange::none;
    const StopListener nobody([] {});
    const std::vector<Row> wanted = blocks_due(model, pairs);
    beyond_.resize(model.blocks.size());
    for (const Row b : wanted) beyond_[b] = travel_beyond(model, b);
    surfaces_.update(model, wanted);
    std::vector<ContactDraft> drafts =
        find_all(model, joints, surfaces_, strengths_, beyond_, pairs, true, found_, scratch_);
    OverlapScratch& scratch = scratch_.local().overlap;
    if (drafts.size() == pairs.size() && refresh_contacts(model, joints, drafts, scratch))
        return ContactChange::refreshed;
    return replace_contacts(model, joints, with_the_others(model, std::move(drafts), pairs), true, scratch);
}

} // namespace kaya
