#include "mechanics/contact_search.hpp"

#include "base/parallel.hpp"
#include "geometry/box_pairs.hpp"
#include "mechanics/contact_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace kaya {

namespace {

/// Sliding farther than this fraction of the contact's size makes its geometry anew.
constexpr double slide_tolerance = 1e-3;
/// A block that has gone this part of its margin is looked at again with those that triggered the search.
constexpr double moved_part = 0.25;
constexpr std::size_t grain = 32;

/// How far a block can come in the time until the next search at the soonest, which is a step.
double way_of_a_step(const Model& model, Row b) {
    double fastest = 0;
    for (Row g = model.blocks.gridpoints[b].first; g < model.blocks.gridpoints[b].end(); ++g)
        fastest = std::max(fastest, model.gridpoints.velocity[g].squaredNorm());
    return std::sqrt(fastest) * model.clock.time_step;
}

/// How far apart two blocks may be and still touch: a fast block's contact must be there before it
/// arrives. A joint that has dilated carries force across a gap: its contact is kept.
double reach(const Model& model, const std::vector<double>& way, Row b1, Row b2, Row contact) {
    const auto& margin = model.blocks.margin;
    double gap = 0;
    if (contact != no_row) {
        const auto& s = model.sub_contacts;
        const Span span = model.contacts.sub_contacts[contact];
        for (Row row = span.first; row < span.end(); ++row) {
            if (s.normal_force[row] == 0) continue;
            const Vec3 between = attached_position(model, s.side2[row]) - attached_position(model, s.side1[row]);
            gap = std::max(gap, between.dot(model.contacts.normal[contact]));
        }
    }
    return std::min(margin[b1], margin[b2]) + 2 * (way[b1] + way[b2]) + 2 * gap;
}

std::vector<double> ways(const Model& model) {
    std::vector<double> way(model.blocks.size());
    for_chunks(way.size(), 8 * grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) way[b] = way_of_a_step(model, static_cast<Row>(b));
    });
    return way;
}

Box box_of(const Model& model, Row b, double margin) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (Row g = model.blocks.gridpoints[b].first; g < model.blocks.gridpoints[b].end(); ++g) {
        low = low.cwiseMin(model.gridpoints.position[g]);
        high = high.cwiseMax(model.gridpoints.position[g]);
    }
    return {low - Vec3::Constant(margin), high + Vec3::Constant(margin)};
}

/// A pair of blocks and the contact that they have, if any.
struct Candidate {
    std::array<Row, 2> pair;
    Row old;
};

/// Pairs whose boxes meet, and those that have a contact already; both lists are sorted.
std::vector<Candidate> candidates(const Model& model, const std::vector<std::array<int, 2>>& near) {
    const auto& contacts = model.contacts;
    std::vector<Candidate> known;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        known.push_back({{contacts.block1[c], contacts.block2[c]}, static_cast<Row>(c)});
    std::sort(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.pair < b.pair; });
    std::vector<Candidate> all;
    auto k = known.begin();
    for (const auto& pair : near) {
        for (; k != known.end() && k->pair < pair; ++k) all.push_back(*k);
        if (k != known.end() && k->pair == pair) all.push_back(*k++);
        else all.push_back({pair, no_row});
    }
    all.insert(all.end(), k, known.end());
    return all;
}

} // namespace

bool contacts_are_due(const Model& model) {
    const auto& blocks = model.blocks;
    // Two blocks that have each gone half the margin may have met.
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (2 * blocks.travelled[b] > blocks.margin[b]) return true;
    return false;
}

void search_contacts(Model& model, JointRegistry& joints, bool moving) {
    auto& blocks = model.blocks;
    const auto way = ways(model);
    std::vector<Box> boxes(blocks.size());
    std::vector<char> moved(blocks.size());
    for_chunks(blocks.size(), 8 * grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            boxes[b] = box_of(model, static_cast<Row>(b), blocks.margin[b] + 2 * way[b]);
            moved[b] = !moving || blocks.travelled[b] > moved_part * blocks.margin[b];
            if (moved[b]) blocks.travelled[b] = 0;
        }
    });
    const auto all = candidates(model, overlapping_boxes(boxes));
    const Surfaces surfaces(model);

    std::vector<std::optional<TouchGeometry>> touches(all.size());
    for_chunks(all.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto [b1, b2] = all[i].pair;
            if (moved[b1] || moved[b2])
                touches[i] = find_touch(model, surfaces, b1, b2, reach(model, way, b1, b2, all[i].old));
        }
    });
    std::vector<ContactDraft> drafts;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto [b1, b2] = all[i].pair;
        if (moved[b1] || moved[b2]) {
            if (touches[i]) drafts.push_back({b1, b2, all[i].old, std::move(touches[i])});
        } else if (all[i].old != no_row) {
            drafts.push_back({b1, b2, all[i].old, std::nullopt});
        }
    }
    replace_contacts(model, joints, std::move(drafts), moving);
}

bool refresh_slid_contacts(Model& model, JointRegistry& joints) {
    auto& contacts = model.contacts;
    const auto slid = [&](std::size_t c) {
        return contacts.slid[c] > slide_tolerance * std::sqrt(contacts.area[c]);
    };
    std::size_t first_slid = 0;
    while (first_slid < contacts.size() && !slid(first_slid)) ++first_slid;
    if (first_slid == contacts.size()) return false;

    const Surfaces surfaces(model);
    const auto way = ways(model);
    std::vector<ContactDraft> drafts(contacts.size());
    std::vector<char> parted(contacts.size(), 0);
    for_chunks(contacts.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            const Row row = static_cast<Row>(c);
            drafts[c] = {contacts.block1[c], contacts.block2[c], row, std::nullopt};
            if (!slid(c)) continue;
            const double margin = reach(model, way, drafts[c].block1, drafts[c].block2, row);
            drafts[c].geometry = find_touch(model, surfaces, drafts[c].block1, drafts[c].block2, margin);
            parted[c] = !drafts[c].geometry;
        }
    });
    std::size_t kept = 0;
    for (std::size_t c = 0; c < drafts.size(); ++c)
        if (!parted[c]) {
            if (kept != c) drafts[kept] = std::move(drafts[c]);
            ++kept;
        }
    drafts.resize(kept);
    replace_contacts(model, joints, std::move(drafts), true);
    return true;
}

} // namespace kaya
