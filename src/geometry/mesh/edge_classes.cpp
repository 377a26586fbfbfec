#include "geometry/mesh/edge_classes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kaya {
namespace {

/// Edges of cells may be longer than requested by this factor, or shorter where there are several of them. Next to a row that gets wider
/// there is room for tetrahedra and another row.
constexpr double most_off = 2.5;

bool divided_alike(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr double tolerance = 1e-6;
    return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= tolerance; });
}

std::vector<double> turned_over(std::vector<double> places) {
    std::ranges::reverse(places);
    for (double& place : places) place = 1 - place;
    return places;
}

} // namespace

int EdgeClasses::Forest::add() {
    parent.push_back(static_cast<int>(parent.size()));
    turned.push_back(false);
    return parent.back();
}

/// The root, and whether the member's direction is against that of the root.
std::pair<int, bool> EdgeClasses::Forest::root(int number) {
    int top = number;
    bool against = false;
    while (parent[top] != top) {
        against = against != turned[top];
        top = parent[top];
    }
    bool left = against;
    for (int n = number; parent[n] != n;) { // shorten the way
        const int next = parent[n];
        const bool rest = left != turned[n];
        parent[n] = top;
        turned[n] = left;
        left = rest;
        n = next;
    }
    return {top, against};
}

int EdgeClasses::member(const GridEdge& edge) {
    const auto [found, fresh] = numbers_.emplace(edge.edge, static_cast<int>(classes_.size()));
    if (fresh) {
        const auto there = given_.find(edge.edge);
        EdgeParts parts;
        parts.add({field_, edge.from, edge.to}, edge.turned); // from the lower end
        const double count = parts.mean();
        classes_.push_back({edge.edge, std::move(parts), count, count, {}});
        if (there != given_.end()) classes_.back().given = there->second;
        edges_.add();
        rows_.add();
    }
    return found->second;
}

std::pair<int, bool> EdgeClasses::root(const GridEdge& edge) {
    auto [top, against] = edges_.root(member(edge));
    return {top, against != edge.turned};
}

bool EdgeClasses::can_admit(const std::array<GridEdge, 4>& row) {
    std::map<int, bool> tops;
    std::optional<std::vector<double>> given;
    double sum = 0, least = std::numeric_limits<double>::infinity(), most = 0;
    int count = 0;
    for (const GridEdge& edge : row) {
        const auto [top, against] = root(edge);
        const auto [known, fresh] = tops.emplace(top, against);
        if (!fresh && known->second != against) return false;
        if (!fresh) continue;
        const Class& one = classes_[top];
        sum += one.parts.total();
        count += one.parts.edges();
        least = std::min(least, one.least);
        most = std::max(most, one.most);
        if (!one.given) continue;
        const auto division = against ? turned_over(*one.given) : *one.given;
        if (given && !divided_alike(*given, division)) return false;
        given = division;
    }
    if (given) return true;
    const int parts = whole_parts(sum / count);
    return most <= most_off * parts && (parts == 1 || parts <= most_off * least);
}

bool EdgeClasses::unite(const GridEdge& a, const GridEdge& b) {
    auto [top, against] = root(a);
    auto [other, other_against] = root(b);
    const bool turned = against != other_against;
    if (top == other) return !turned;
    if (classes_[other].lowest < classes_[top].lowest) std::swap(top, other); // the lowest edge is the root
    edges_.parent[other] = top;
    edges_.turned[other] = turned;
    Class &to = classes_[top], &from = classes_[other];
    to.parts.add(std::exchange(from.parts, {}), turned); // no longer needed
    to.least = std::min(to.least, from.least);
    to.most = std::max(to.most, from.most);
    if (!to.given && from.given) to.given = turned ? turned_over(*from.given) : *from.given;
    return true;
}

bool EdgeClasses::admit(const GridEdges& grid) {
    if (!std::ranges::all_of(grid, [&](const auto& row) { return can_admit(row); })) return false;
    bool fits = true;
    for (const auto& row : grid)
        for (std::size_t i = 1; i < row.size(); ++i) fits &= unite(row[0], row[i]);
    return fits;
}

void EdgeClasses::follow(const GridEdge& a, const GridEdge& b, bool turned) {
    const auto direction = [&](const GridEdge& edge) {
        const auto [own, against] = root(edge);
        const auto [top, row_against] = rows_.root(own);
        return std::pair{top, against != row_against};
    };
    auto [top, against] = direction(a);
    auto [other, other_against] = direction(b);
    if (top == other) return;
    if (classes_[other].lowest < classes_[top].lowest) std::swap(top, other);
    rows_.parent[other] = top;
    rows_.turned[other] = (against != other_against) != turned;
}

bool EdgeClasses::is_turned(const GridEdge& edge) {
    const auto [top, against] = root(edge);
    return against != rows_.root(top).second;
}

std::vector<double> EdgeClasses::division(const GridEdge& edge) {
    const int top = root(edge).first;
    const Class& one = classes_[top];
    const bool turned = rows_.root(top).second;
    if (one.given) return turned ? turned_over(*one.given) : *one.given;
    return one.parts.division(whole_parts(one.parts.mean()), turned);
}

} // namespace kaya
