#include "laws/joint_tables.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

const JointTables::Points& points_of(const void* table) { return *static_cast<const JointTables::Points*>(table); }

/// Number of the first point beyond x.
std::size_t beyond(const JointTables::Points& points, double x) {
    return static_cast<std::size_t>(std::upper_bound(points.x.begin(), points.x.end(), x) - points.x.begin());
}

} // namespace

double table_value(const JointTables::Points& points, double x) {
    if (points.x.empty()) return 0;
    // At a step (two points with the same x) the first of the two, as everywhere in a deck.
    const auto next =
        static_cast<std::size_t>(std::lower_bound(points.x.begin(), points.x.end(), x) - points.x.begin());
    if (next == points.x.size()) return points.y.back();
    if (next == 0 || points.x[next] == x) return points.y[next];
    const double part = (x - points.x[next - 1]) / (points.x[next] - points.x[next - 1]);
    return points.y[next - 1] + part * (points.y[next] - points.y[next - 1]);
}

double table_slope(const JointTables::Points& points, double x) {
    const std::size_t next = beyond(points, x);
    if (next == 0 || next == points.x.size()) return 0;
    return (points.y[next] - points.y[next - 1]) / (points.x[next] - points.x[next - 1]);
}

JointTables::JointTables() : interface_{} {
    interface_.tables = this;
    interface_.functions.find = [](const kaya_jtables* self, const char* name) -> const void* {
        return reinterpret_cast<const Interface*>(self)->tables->find(name);
    };
    interface_.functions.value = [](const void* table, double x) { return table_value(points_of(table), x); };
    interface_.functions.slope = [](const void* table, double x) { return table_slope(points_of(table), x); };
}

const JointTables::Points* JointTables::find(const std::string& name) {
    const std::lock_guard guard(lock_);
    const auto known = taken_.find(name);
    if (known != taken_.end()) return known->second.get();
    auto points = source_ ? source_(name) : std::nullopt;
    if (!points) return nullptr;
    return taken_.emplace(name, std::make_unique<Points>(std::move(*points))).first->second.get();
}

void JointTables::refresh() {
    const std::lock_guard guard(lock_);
    for (auto& [name, points] : taken_) {
        auto now = source_ ? source_(name) : std::nullopt;
        if (!now)
            throw Diagnostic(fmt::format("table {} was deleted, and a joint model uses it", name),
                             "define the table again before the model cycles", Fault::run);
        *points = std::move(*now);
    }
}

} // namespace kaya
