#include "lang/script/values/tables.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace kaya::script {

namespace {
bool before(const TablePoint& point, double x) { return point.x < x; }
bool after(double x, const TablePoint& point) { return x < point.x; }
bool goes_back(const TablePoint& point, const TablePoint& next) { return !(point.x <= next.x); }
} // namespace

double Table::at(double x) const {
    if (points_.empty()) throw Diagnostic("the table holds no point", "fill it before it is read");
    require_sorted();
    const auto right = std::lower_bound(points_.begin(), points_.end(), x, before);
    if (right == points_.end()) return points_.back().y;
    if (right == points_.begin() || right->x == x) return right->y;
    const auto left = right - 1;
    return left->y + (right->y - left->y) * ((x - left->x) / (right->x - left->x));
}

void Table::set(double x, double y) {
    require_sorted();
    const auto place = std::lower_bound(points_.begin(), points_.end(), x, before);
    if (place != points_.end() && place->x == x) place->y = y;
    else points_.insert(place, {x, y});
}

void Table::insert(double x, double y) {
    require_sorted();
    points_.insert(std::upper_bound(points_.begin(), points_.end(), x, after), {x, y});
}

void Table::replace(std::vector<TablePoint> points) {
    points_ = std::move(points);
    steps_back_ = steps_back(0, points_.size());
}

void Table::put(std::size_t i, const TablePoint& point) {
    const std::size_t first = i > 0 ? i - 1 : 0, last = std::min(i + 2, points_.size());
    const std::size_t known = steps_back(first, last);
    if (i < points_.size()) points_[i] = point;
    else points_.push_back(point);
    steps_back_ += steps_back(first, std::min(i + 2, points_.size()));
    steps_back_ -= known;
}

std::size_t Table::steps_back(std::size_t from, std::size_t to) const {
    std::size_t count = 0;
    for (std::size_t i = from + 1; i < to; ++i) count += goes_back(points_[i - 1], points_[i]) ? 1 : 0;
    return count;
}

void Table::require_sorted(std::string_view called) const {
    if (steps_back_ == 0) return;
    const auto point = std::ranges::adjacent_find(points_, goes_back);
    throw Diagnostic(fmt::format("{} is not sorted: x goes back from {:g} to {:g} at point {}", called, point->x,
                                 (point + 1)->x, point - points_.begin() + 2),
                     "fill it in the order of x; `table n x y` and table(n, x) = y put points in their places");
}

} // namespace kaya::script
