// From a closed surface to convex parts.
#include "base/diagnostic.hpp"
#include "base/number_text.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <set>

namespace kaya {

bool comes_first(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

void put_in_order(Surface& surface) {
    std::vector<int> order(surface.vertices.size()), number(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return comes_first(surface.vertices[a], surface.vertices[b]); });
    std::vector<Vec3> vertices;
    for (const int v : order) {
        number[v] = static_cast<int>(vertices.size());
        vertices.push_back(surface.vertices[v]);
    }
    surface.vertices = std::move(vertices);
    for (auto& face : surface.faces) {
        for (int& v : face.vertices) v = number[v];
        std::rotate(face.vertices.begin(), std::min_element(face.vertices.begin(), face.vertices.end()),
                    face.vertices.end());
    }
    std::sort(surface.faces.begin(), surface.faces.end(),
              [](const Surface::Face& a, const Surface::Face& b) { return a.vertices < b.vertices; });
}

namespace {

Polyhedron polyhedron_of(const Surface& surface) {
    Polyhedron polyhedron;
    polyhedron.vertices = surface.vertices;
    for (const auto& face : surface.faces) polyhedron.faces.push_back({face.vertices, face.joint_set});
    return polyhedron;
}

/// "face 9" before "face 10".
bool counts_before(const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
}

using Names = std::pair<std::string, std::string>;

/// The pair that a message names, the first as the file counts them.
Names first_of(const std::vector<Names>& crossings) {
    std::vector<Names> sorted = crossings;
    for (auto& [a, b] : sorted)
        if (counts_before(b, a)) std::swap(a, b);
    return *std::min_element(sorted.begin(), sorted.end(), [](const Names& a, const Names& b) {
        return a.first != b.first ? counts_before(a.first, b.first) : counts_before(a.second, b.second);
    });
}

/// Gives one of two crossing faces other diagonals: the one that was changed less often. Only faces that were divided have any. False when
/// none has any left.
bool change_diagonals(const std::vector<Names>& crossings, const Surface& divided, Diagonals& diagonals) {
    constexpr int most = 4; // a face of four corners has both its diagonals tried twice
    std::map<std::string, int> pieces;
    for (const auto& face : divided.faces) ++pieces[face.name];
    std::set<std::string> changed;
    for (const auto& [a, b] : crossings) {
        const std::string* face = nullptr;
        for (const std::string* one : {&a, &b})
            if (pieces[*one] > 1 && (face == nullptr || diagonals[*one] < diagonals[*face])) face = one;
        if (changed.contains(a) || changed.contains(b) || face == nullptr || diagonals[*face] >= most) continue;
        ++diagonals[*face];
        changed.insert(*face);
    }
    return !changed.empty();
}

/// Splits a concave surface; warped faces are divided along other diagonals where they cross others.
void split_concave(Surface& surface, const Flatness& flatness, Solid& solid) {
    put_in_order(surface);
    merge_flat_neighbours(surface, flatness);
    Diagonals diagonals;
    for (;;) {
        Surface flat = surface;
        solid.triangulated.clear();
        solid.mended_by = flatten(flat, flatness, diagonals, solid.triangulated);
        ConvexSplit split = convex_parts(flat);
        solid.parts = std::move(split.parts);
        if (!split.crossed_at) return;
        const auto crossings = crossing_faces(flat);
        if (change_diagonals(crossings, flat, diagonals)) continue;
        if (crossings.empty()) throw Diagnostic("the surface crosses itself near " + place_text(*split.crossed_at));
        const auto [one, other] = first_of(crossings);
        throw Diagnostic(fmt::format("the surface crosses itself: {} cuts through {}", one, other));
    }
}

/// Adds the faces of an outward surface, turned to the inside.
void add_cavity(Surface& surface, const Surface& cavity) {
    const int first = static_cast<int>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
    for (Surface::Face face : cavity.faces) {
        std::reverse(face.vertices.begin(), face.vertices.end());
        for (int& v : face.vertices) v += first;
        surface.faces.push_back(std::move(face));
    }
}

} // namespace

Solid solid_from_surface(const Surface& given, const Flatness& flatness, const std::vector<Surface>& cavities) {
    Surface surface = given;
    Solid solid;
    check_faces(surface);
    solid.turned_faces = turn_alike(surface);
    solid.anticlockwise = !turn_outward(surface) && solid.turned_faces == 0;
    for (Surface cavity : cavities) {
        check_faces(cavity);
        turn_alike(cavity);
        turn_outward(cavity);
        add_cavity(surface, cavity);
    }
    check_outlines(surface);
    Surface flat = surface;
    merge_flat_neighbours(flat, flatness);
    solid.mended_by = flatten(flat, flatness, {}, solid.triangulated);
    // A fine net from a file is as round as the digits of single precision make it.
    const double tolerance = flat.faces.size() > fine_net ? 1e-6 : 1e-9;
    if (cavities.empty() && is_convex(flat, tolerance * size_of(flat.vertices)))
        solid.parts.push_back(polyhedron_of(flat));
    else split_concave(surface, flatness, solid);
    return solid;
}

} // namespace kaya
