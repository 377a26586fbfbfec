#include "lang/script/values/tables.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>

namespace kaya::script {

namespace {
bool before(const TablePoint& point, double x) { return point.x < x; }
bool after(double x, const TablePoint& point) { return x < point.x; }
} // namespace

double Table::at(double x) const {
    if (points.empty()) throw Diagnostic("the table holds no point", "fill it before it is read");
    const auto right = std::lower_bound(points.begin(), points.end(), x, before);
    if (right == points.end()) return points.back().y;
    if (right == points.begin() || right->x == x) return right->y;
    const auto left = right - 1;
    return left->y + (right->y - left->y) * ((x - left->x) / (right->x - left->x));
}

void Table::set(double x, double y) {
    const auto place = std::lower_bound(points.begin(), points.end(), x, before);
    if (place != points.end() && place->x == x) place->y = y;
    else points.insert(place, {x, y});
}

void Table::insert(double x, double y) {
    points.insert(std::upper_bound(points.begin(), points.end(), x, after), {x, y});
}

} // namespace kaya::script
