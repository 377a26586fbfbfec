#include "mechanics/cycle/grid_pass.hpp"

#include "base/parallel.hpp"
#include "mechanics/motion/move_gridpoints.hpp"
#include "mechanics/ties/ties.hpp"

#include <algorithm>
#include <utility>

namespace kaya {

namespace {

constexpr Row moving = static_cast<Row>(GridpointMotion::grain), gathering = static_cast<Row>(ForceGathering::grain);
static_assert(moving % gathering == 0, "a chunk that is gathered lies in one that moves");

Row chunks_of(const Model& model, Row grain) { return (static_cast<Row>(model.gridpoints.size()) + grain - 1) / grain; }

/// The chunks of moving gridpoints that a tile sees.
struct TileChunks {
    Row first, last;
};

std::vector<TileChunks> chunks_of_tiles(const ZoneTiles& tiles) {
    std::vector<TileChunks> chunks;
    chunks.reserve(tiles.tiles.size());
    for (const ZoneTile& tile : tiles.tiles) {
        const auto points = tiles.gridpoints.begin() + tile.points.first;
        const auto [low, high] = std::minmax_element(points, points + tile.points.count);
        chunks.push_back({*low / moving, *high / moving});
    }
    return chunks;
}

/// The thread of each chunk of moving gridpoints: the chunks of a thread are consecutive, and all threads have about as many zones.
std::vector<Row> threads_of_chunks(const ZoneTiles& tiles, const std::vector<TileChunks>& chunks_of, Row chunks,
                                   int threads) {
    std::vector<std::size_t> zones(static_cast<std::size_t>(chunks), 0);
    std::size_t whole = 0, before = 0;
    for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
        const auto count = static_cast<std::size_t>(tiles.tiles[t].last - tiles.tiles[t].first);
        zones[static_cast<std::size_t>(chunks_of[t].last)] += count;
        whole += count;
    }
    std::vector<Row> thread;
    thread.reserve(zones.size());
    for (const std::size_t here : zones) {
        thread.push_back(static_cast<Row>((before + here / 2) * static_cast<std::size_t>(threads) / (whole + 1)));
        before += here;
    }
    return thread;
}

} // namespace

GridPass::GridPass(const Model& model, const ZoneTiles& tiles, int threads) : threads_(threads) {
    const Row moves = chunks_of(model, moving), gathers = chunks_of(model, gathering);
    chunks_.resize(static_cast<std::size_t>(moves));
    tiles_.resize(tiles.tiles.size());
    gathered_.done.assign(static_cast<std::size_t>(gathers), 0);
    gathered_.balance.resize(static_cast<std::size_t>(gathers));

    const std::vector<TileChunks> chunks = chunks_of_tiles(tiles);
    const std::vector<Row> thread_of = threads_of_chunks(tiles, chunks, moves, threads);
    const auto is_late = [&](const TileChunks& tile) { return thread_of[tile.first] != thread_of[tile.last]; };
    // A chunk is gathered after the last tile that sees it.
    std::vector<Row> ready(static_cast<std::size_t>(gathers));
    for (Row c = 0; c < gathers; ++c) ready[c] = c * gathering / moving;
    for (std::size_t t = 0; t < chunks.size(); ++t) {
        if (is_late(chunks[t])) late_tiles_.push_back(static_cast<Row>(t));
        const Span points = tiles.tiles[t].points;
        for (Row p = points.first; p < points.end(); ++p) {
            Row& chunk = ready[tiles.gridpoints[p] / gathering];
            chunk = std::max(chunk, is_late(chunks[t]) ? moves : chunks[t].last);
        }
    }
    const auto by_chunk = sorted_lists<Step>(static_cast<std::size_t>(moves), [&](auto add) {
        for (Row c = 0; c < moves; ++c) add(c, Step{Work::move, c});
        for (std::size_t t = 0; t < chunks.size(); ++t)
            if (!is_late(chunks[t])) add(chunks[t].last, Step{Work::zones, static_cast<Row>(t)});
        for (Row c = 0; c < gathers; ++c)
            if (ready[c] < moves) add(ready[c], Step{Work::gather, c});
    });
    for (Row c = 0; c < gathers; ++c)
        if (ready[c] == moves) late_chunks_.push_back(c);
    steps_ = sorted_lists<Step>(static_cast<std::size_t>(threads), [&](auto add) {
        for (Row c = 0; c < moves; ++c)
            for (auto step = by_chunk.begin(c); step != by_chunk.end(c); ++step) add(thread_of[c], *step);
    });
}

bool GridPass::possible(const Model& model, const ZoneLaws& laws, const TieLists& ties) {
    return !laws.tiles.tiles.empty() && tiles_go_alone(model, laws) && ties.groups() == 0;
}

void GridPass::run(Model& model, const QuietPoints& quiet, const ZoneLaws& laws, ZoneScratch& scratch,
                   const PointForces& forces, bool loads_stay, std::vector<PointRow>& zone_forces) {
    begin_zones(model, laws, scratch);
    GridpointMotion motion(model, quiet, forces.ties);
    ForceGathering gathering_of(model, forces);
    const auto run_zones = [&](Row tile) {
        const auto index = static_cast<std::size_t>(tile);
        tiles_[index] = run_tile(model, laws, laws.tiles.tiles[index], scratch, zone_forces);
    };
    const auto rows = [&](Row chunk, Row grain) {
        const auto first = static_cast<std::size_t>(chunk * grain);
        return std::pair(first, std::min(first + static_cast<std::size_t>(grain), model.gridpoints.size()));
    };
    const auto move = [&](Row chunk) {
        const auto [first, last] = rows(chunk, moving);
        chunks_[static_cast<std::size_t>(chunk)] = motion.move(first, last);
    };
    const auto gather = [&](Row chunk) {
        const auto [first, last] = rows(chunk, gathering);
        if (!loads_stay || !gathering_of.only_zones_act(first, last)) return;
        gathered_.balance[static_cast<std::size_t>(chunk)] = gathering_of.gather(first, last);
        gathered_.done[static_cast<std::size_t>(chunk)] = 1;
    };
    const auto take = [&](const Step& step) {
        if (step.work == Work::move) move(step.index);
        else if (step.work == Work::zones) run_zones(step.index);
        else gather(step.index);
    };
    for_chunks(static_cast<std::size_t>(threads_), 1, [&](std::size_t thread, std::size_t) {
        const Row row = static_cast<Row>(thread);
        for (auto step = steps_.begin(row); step != steps_.end(row); ++step) take(*step);
    });
    for_chunks(late_tiles_.size(), 1, [&](std::size_t late, std::size_t) { run_zones(late_tiles_[late]); });
    for_chunks(late_chunks_.size(), 1, [&](std::size_t late, std::size_t) { gather(late_chunks_[late]); });
    add_up();
    motion_ = motion.finish(motion_);
}

/// Rethrows the exception of the first tile that failed.
void GridPass::add_up() {
    motion_ = {};
    zones_ = {};
    for (const MotionSums& part : chunks_) motion_.add(part);
    for (TileResult& part : tiles_) {
        if (part.failure) {
            const auto failure = part.failure;
            for (TileResult& other : tiles_) other.failure = nullptr;
            std::rethrow_exception(failure);
        }
        zones_.add(part.sums);
    }
}

} // namespace kaya
