#include "model/edit/ties.hpp"

#include "model/edit/joined.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace kaya {

namespace {

Row root_of(std::vector<Row>& parent, Row i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// Zoned bodies that have lost a block of a pair.
std::set<std::int32_t> bodies_that_lost_a_block(const Model& model) {
    const auto& pairs = model.tied_pairs;
    const auto& blocks = model.blocks;
    std::set<std::int32_t> bodies;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Row a = blocks.ids.row(pairs.block1[p]), b = blocks.ids.row(pairs.block2[p]);
        if ((a == no_row) == (b == no_row)) continue;
        bodies.insert(blocks.body[a == no_row ? b : a]);
    }
    // A body joined again meanwhile gets its ties later.
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks.tied_shape[b] != blocks.shape[b]) bodies.erase(blocks.body[b]);
    bodies.erase(0);
    return bodies;
}

/// Gives separate numbers to the parts of bodies that no tie holds together.
void part_bodies(Model& model, const std::set<std::int32_t>& bodies) {
    auto& blocks = model.blocks;
    std::vector<Row> parent(blocks.size());
    std::iota(parent.begin(), parent.end(), Row{0});
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> pair;
        if (model.tied_pairs.ties[p].count == 0 || !blocks_of_pair(model, static_cast<Row>(p), pair)) continue;
        const Row a = root_of(parent, pair[0]), b = root_of(parent, pair[1]);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::map<Row, std::vector<Row>> parts;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (bodies.contains(blocks.body[b])) parts[root_of(parent, static_cast<Row>(b))].push_back(static_cast<Row>(b));
    for (const auto& [first, members] : parts)
        for (const Row b : members) blocks.body[b] = members.size() == 1 ? 0 : blocks.number[first];
}

/// Keeps the listed pairs with their ties.
void keep_pairs(Model& model, const std::vector<Row>& kept) {
    auto& pairs = model.tied_pairs;
    if (kept.size() == pairs.size()) return;
    std::vector<Row> ties;
    for (const Row p : kept)
        for (Row t = pairs.ties[p].first; t < pairs.ties[p].end(); ++t) ties.push_back(t);
    pairs.gather(kept);
    model.ties.gather(ties);
    Row next = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        pairs.ties[p].first = next;
        for (; next < pairs.ties[p].end(); ++next) model.ties.pair[next] = static_cast<Row>(p);
    }
}

} // namespace

bool blocks_of_pair(const Model& model, Row pair, std::array<Row, 2>& rows) {
    const auto& pairs = model.tied_pairs;
    const auto& blocks = model.blocks;
    rows = {blocks.ids.row(pairs.block1[pair]), blocks.ids.row(pairs.block2[pair])};
    return rows[0] != no_row && rows[1] != no_row && blocks.shape[rows[0]] == pairs.shape1[pair] &&
           blocks.shape[rows[1]] == pairs.shape2[pair] && joined(model, rows[0], rows[1]);
}

TiedBlocks::TiedBlocks(const Model& model) {
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> pair;
        if (!blocks_of_pair(model, static_cast<Row>(p), pair)) continue;
        pairs_.push_back({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])});
    }
    std::ranges::sort(pairs_);
}

bool TiedBlocks::contains(Row a, Row b) const {
    return std::ranges::binary_search(pairs_, std::array{std::min(a, b), std::max(a, b)});
}

std::vector<FacePair> tied_face_pairs(const Model& model) {
    std::map<std::array<Row, 2>, double> areas;
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> pair;
        if (!blocks_of_pair(model, static_cast<Row>(p), pair)) continue;
        const Span span = model.tied_pairs.ties[p];
        for (Row t = span.first; t < span.end(); ++t)
            areas[{model.blocks.faces[pair[0]].first + model.ties.face1[t],
                   model.blocks.faces[pair[1]].first + model.ties.face2[t]}] += model.ties.area[t];
    }
    std::vector<FacePair> pairs;
    for (const auto& [faces, area] : areas) pairs.push_back({faces[0], faces[1], area});
    return pairs;
}

std::vector<Row> tied_faces(const Model& model) {
    std::vector<Row> faces;
    for (const FacePair& pair : tied_face_pairs(model)) faces.insert(faces.end(), {pair.face1, pair.face2});
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

void drop_void_ties(Model& model) {
    const auto bodies = bodies_that_lost_a_block(model);
    if (!bodies.empty()) part_bodies(model, bodies);
    const auto untied = [&](Row b) { return model.blocks.tied_shape[b] != model.blocks.shape[b]; };
    std::vector<Row> kept;
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> pair;
        if (!blocks_of_pair(model, static_cast<Row>(p), pair)) continue;
        // Blocks that are joined again may have faces in contact now.
        if (model.tied_pairs.ties[p].count == 0 && (untied(pair[0]) || untied(pair[1]))) continue;
        kept.push_back(static_cast<Row>(p));
    }
    keep_pairs(model, kept);
}

} // namespace kaya
