#include "model/kinds/selection.hpp"

#include <algorithm>

namespace kaya {

std::vector<Row> select(const Model& model, ObjectKind kind, const RangeTest& test, bool hidden_too) {
    const KindInfo& info = info_of(kind);
    std::vector<Row> rows;
    const auto count = static_cast<Row>(info.count(model));
    for (Row row = 0; row < count; ++row) {
        if (!hidden_too && info.shown != nullptr && !info.shown(model, row)) continue;
        if (!test || test(model, kind, row)) rows.push_back(row);
    }
    return rows;
}

double model_size(const Model& model) {
    constexpr double smallest = 1e-30;
    const auto& position = model.gridpoints.position;
    if (position.empty()) return smallest;
    Vec3 low = position.front(), high = position.front();
    for (const auto& p : position) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return std::max((high - low).norm(), smallest);
}

} // namespace kaya
