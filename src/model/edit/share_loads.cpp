#include "model/edit/share_loads.hpp"

#include "model/tables/model.hpp"

#include <array>
#include <cmath>
#include <tuple>

namespace kaya {

namespace {

using What = BoundaryHistories::What;

/// Sums of loads by component, as in BoundaryHistories.
struct Components {
    std::array<double, BoundaryHistories::loads> value{}, size{}; ///< size: sums of absolute values

    void add(const PlacedLoad& load, const Vec3& about, double factor) {
        for (std::size_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                const double force = factor * load.force[k][axis];
                add(axis, force);
                for (int a = 0; a < 3; ++a)
                    add(BoundaryHistories::motions + 3 * axis + a, force * (load.place[k][a] - about[a]));
            }
    }
    /// A number without the sum; what is left of rounding is zero.
    double rest_of(double number, int component) const {
        constexpr double rounding = 1e-12;
        const auto c = static_cast<std::size_t>(component);
        const double rest = number - value[c];
        return std::abs(rest) <= rounding * size[c] ? 0 : rest;
    }

private:
    void add(int component, double part) {
        value[static_cast<std::size_t>(component)] += part;
        size[static_cast<std::size_t>(component)] += std::abs(part);
    }
};

/// Converts the arms of load histories to global axes: pieces have no other axes.
void turn_arms(BoundaryHistories& histories, BlockId block, const Mat3& turn) {
    std::vector<Row> kept;
    const std::size_t count = histories.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (histories.block[i] != block || histories.component[i] < BoundaryHistories::motions) {
            kept.push_back(static_cast<Row>(i));
            continue;
        }
        const int place = histories.component[i] - BoundaryHistories::motions;
        for (int k = 0; k < 3; ++k) {
            const double part = turn(k, place % 3);
            if (part == 0) continue;
            const std::size_t row = histories.size();
            kept.push_back(histories.append(histories, {static_cast<Row>(i)}));
            histories.component[row] = BoundaryHistories::motions + 3 * (place / 3) + k;
            histories.amplitude[row] *= part;
            histories.acting[row] *= part;
        }
    }
    if (histories.size() != count) histories.gather(kept);
}

/// Takes sums by function out of the load histories of a block. Returns the present values of the functions.
std::map<std::int32_t, double> take_out(BoundaryHistories& histories, BlockId block,
                                        const std::map<std::int32_t, Components>& sums) {
    std::map<std::int32_t, double> factors;
    std::vector<Row> kept;
    for (std::size_t i = 0; i < histories.size(); ++i) {
        const auto found = sums.find(histories.function[i]);
        double& amplitude = histories.amplitude[i];
        if (histories.block[i] == block && histories.what[i] == What::load && found != sums.end() && amplitude != 0) {
            const double factor = factors[found->first] = histories.acting[i] / amplitude;
            amplitude = found->second.rest_of(amplitude, histories.component[i]);
            histories.acting[i] = factor * amplitude;
            if (amplitude == 0) continue;
        }
        kept.push_back(static_cast<Row>(i));
    }
    if (kept.size() != histories.size()) histories.gather(kept);
    return factors;
}

/// Velocity histories of a block apply to its pieces; loads are shared by volume.
void share_histories(Model& model, BlockId block, double volume, const std::vector<Row>& pieces) {
    auto& histories = model.boundary_histories;
    const std::size_t count = histories.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (histories.block[i] != block) continue;
        const double amplitude = histories.amplitude[i], acting = histories.acting[i];
        for (const Row piece : pieces) {
            std::size_t row = i;
            if (piece != pieces.front())
                row = static_cast<std::size_t>(histories.append(histories, {static_cast<Row>(i)}));
            histories.block[row] = model.blocks.id[piece];
            const double share = histories.what[i] == What::load ? model.blocks.volume[piece] / volume : 1;
            histories.amplitude[row] = share * amplitude;
            histories.acting[row] = share * acting;
        }
    }
}

/// Load histories of some blocks, to which parts are added.
class LoadHistories {
public:
    LoadHistories(BoundaryHistories& histories, const Blocks& blocks, const std::vector<Row>& rows)
        : histories_(histories) {
        for (std::size_t i = 0; i < histories.size(); ++i)
            for (const Row b : rows)
                if (histories.block[i] == blocks.id[b] && histories.what[i] == What::load)
                    rows_[{histories.block[i], histories.component[i], histories.function[i]}] = i;
    }
    void add(BlockId block, int component, std::int32_t function, double amplitude, double acting) {
        const auto [found, fresh] = rows_.try_emplace({block, component, function}, histories_.size());
        const std::size_t row = found->second;
        if (fresh) {
            histories_.resize(row + 1);
            histories_.block[row] = block;
            histories_.gridpoint[row] = no_row;
            histories_.what[row] = What::load;
            histories_.component[row] = component;
            histories_.function[row] = function;
        }
        histories_.amplitude[row] += amplitude;
        histories_.acting[row] += acting;
    }

private:
    BoundaryHistories& histories_;
    std::map<std::tuple<BlockId, int, std::int32_t>, std::size_t> rows_;
};

} // namespace

SharedLoads::SharedLoads(Model& model, Row block, Blocks& whole, const Mat3& turn)
    : block_(model.blocks.id[block]), volume_(whole.volume[0]), loads_(take_placed_loads(model, block)) {
    turn_arms(model.boundary_histories, block_, turn);
    if (loads_.empty()) return;
    const Vec3& centroid = whole.centroid[0];
    std::map<std::int32_t, Components> sums;
    for (const PlacedLoad& load : loads_)
        if (load.function != constant_in_time) sums[load.function].add(load, centroid, 1);
    factors_ = take_out(model.boundary_histories, block_, sums);
    factors_[constant_in_time] = 1;
    Components present;
    for (const PlacedLoad& load : loads_) present.add(load, centroid, factors_[load.function]);
    for (int k = 0; k < BoundaryHistories::loads; ++k) {
        if (k >= 3 && k < BoundaryHistories::motions) continue; // moments have no place
        double& number = load_component(whole, 0, k);
        number = present.rest_of(number, k);
    }
}

void SharedLoads::give(Model& model, const std::vector<Row>& pieces, std::span<const Polyhedron> shapes) const {
    auto& blocks = model.blocks;
    share_histories(model, block_, volume_, pieces);
    if (loads_.empty()) return;
    std::vector<std::map<std::int32_t, Components>> sums(pieces.size());
    LoadPlaces places(model);
    for (const PlacedLoad& load : loads_) {
        const auto parts = parts_on(load, shapes);
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (const PlacedLoad& part : parts[i]) {
                places.add(pieces[i], part);
                sums[i][load.function].add(part, blocks.centroid[pieces[i]], 1);
            }
    }
    LoadHistories histories(model.boundary_histories, blocks, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (const auto& [function, sum] : sums[i])
            for (int k = 0; k < BoundaryHistories::loads; ++k) {
                const double amplitude = sum.value[static_cast<std::size_t>(k)];
                if (amplitude == 0) continue;
                const double acting = factors_.at(function) * amplitude;
                load_component(blocks, pieces[i], k) += acting;
                if (function != constant_in_time) histories.add(blocks.id[pieces[i]], k, function, amplitude, acting);
            }
}

} // namespace kaya
