#include "model/measure/cell_faces.hpp"

#include "model/measure/cell_corners.hpp"

#include <algorithm>

namespace kaya {

namespace {

bool has(const TriangleCorners& triangle, Row gridpoint) {
    return std::ranges::find(triangle, gridpoint) != triangle.end();
}

} // namespace

Row partner_in_cell(const Model& model, Row triangle) {
    const Row face = model.triangles.face[triangle], block = model.faces.block[face];
    if (model.blocks.cell_zones[block] != zones_of_cell || model.settings.triangular_outer_faces) return no_row;
    // The two halves follow each other.
    const Span span = model.faces.triangles[face];
    const Row partner = span.first + ((triangle - span.first) ^ 1);
    if (partner >= span.end()) return no_row;
    const TriangleCorners &own = model.triangles.gridpoints[triangle], &other = model.triangles.gridpoints[partner];
    return std::ranges::count_if(own, [&](Row g) { return has(other, g); }) == 2 ? partner : no_row;
}

std::array<Row, 4> corners_of_face(const TriangleCorners& one, const TriangleCorners& two) {
    std::size_t tip = 0;
    while (tip < 2 && has(two, one[tip])) ++tip;
    const Row opposite = *std::ranges::find_if(two, [&](Row g) { return !has(one, g); });
    return {one[tip], one[(tip + 1) % 3], opposite, one[(tip + 2) % 3]};
}

std::array<TriangleCorners, 2> other_diagonal(const TriangleCorners& one, const TriangleCorners& two) {
    const auto [a, b, c, d] = corners_of_face(one, two);
    return {TriangleCorners{a, b, c}, TriangleCorners{a, c, d}};
}

CellFaces::CellFaces(const Model& model, const std::vector<Row>& tied) : model_(model) {
    if (tied.empty()) return;
    tied_.assign(model.faces.size(), 0);
    for (const Row face : tied) tied_[static_cast<std::size_t>(face)] = 1;
}

Row CellFaces::partner(Row triangle) const {
    if (!tied_.empty() && tied_[static_cast<std::size_t>(model_.triangles.face[triangle])]) return no_row;
    return partner_in_cell(model_, triangle);
}

} // namespace kaya
