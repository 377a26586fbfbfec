#include "commands/world/occupied.hpp"

#include "geometry/polyhedra/quality.hpp"
#include "model/edit/build.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/block_box.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Exponent of the power of two that is not less than the box's longest side.
int size_of(const Box& box) { return std::ilogb((box.high - box.low).maxCoeff()) + 1; }

/// Calls visit(key) for each cell of width 2^exponent that the box meets; false when there are more than `most`.
template <class Visit> bool for_cells(const Box& box, int exponent, double most, Visit visit) {
    const double width = std::ldexp(1.0, exponent);
    const Vec3 low = (box.low / width).array().floor(), high = (box.high / width).array().floor();
    if (!((high - low + Vec3::Ones()).prod() <= most) || low.cwiseAbs().maxCoeff() > 1e15) return false;
    for (double x = low.x(); x <= high.x(); ++x)
        for (double y = low.y(); y <= high.y(); ++y)
            for (double z = low.z(); z <= high.z(); ++z) {
                // Cells with equal keys are distinguished by their boxes.
                const auto part = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)); };
                visit(part(x) * 0x9e3779b97f4a7c15ull ^ part(y) * 0xc2b2ae3d27d4eb4full ^
                      part(z) * 0x165667b19e3779f9ull);
            }
    return true;
}

} // namespace

void Occupied::add(Row row, const Box& box) {
    const int exponent = size_of(box);
    Grid& grid = grids_[exponent];
    for_cells(box, exponent, 27, [&](std::uint64_t key) { grid.cells[key].push_back(row); });
    grid.rows.push_back(row);
    boxes_.push_back(box);
}

Row Occupied::overlapped_by(const Model& model, Row row) {
    const auto count = static_cast<std::size_t>(row);
    if (boxes_.size() != count || made_ != model.blocks.number[row] || cycle_ != model.clock.cycle) {
        grids_.clear();
        boxes_.clear();
        for (Row b = 0; b < row; ++b) add(b, block_box(model, b));
        cycle_ = model.clock.cycle;
    }
    const Box box = block_box(model, row);
    std::vector<Row> near;
    for (const auto& [exponent, grid] : grids_) {
        const auto visit = [&, &cells = grid.cells](std::uint64_t key) {
            if (const auto found = cells.find(key); found != cells.end())
                near.insert(near.end(), found->second.begin(), found->second.end());
        };
        if (!for_cells(box, exponent, static_cast<double>(grid.rows.size()) + 27, visit))
            near.insert(near.end(), grid.rows.begin(), grid.rows.end());
    }
    add(row, box);
    made_ = model.blocks.number[row] + 1;
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    const double thin = 1e-6 * (box.high - box.low).maxCoeff();
    for (const Row other : near) {
        const Box& b = boxes_[static_cast<std::size_t>(other)];
        if ((box.low.array() > b.high.array() - thin).any() || (b.low.array() > box.high.array() - thin).any())
            continue;
        if (joined(model, row, other)) continue;
        if (!overlapping_blocks({shape_of(model, other), shape_of(model, row)}).empty()) return other;
    }
    return no_row;
}

} // namespace kaya
