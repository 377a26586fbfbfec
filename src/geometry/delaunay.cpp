#include "geometry/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <algorithm>

namespace kaya {

std::vector<std::array<int, 4>> delaunay(const std::vector<Vec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
    using Storage =
        CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
    using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Storage>;

    std::vector<std::pair<Kernel::Point_3, int>> numbered;
    numbered.reserve(points.size());
    for (const Vec3& p : points)
        numbered.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), static_cast<int>(numbered.size()));
    const Triangulation triangulation(numbered.begin(), numbered.end());

    std::vector<std::array<int, 4>> tetrahedra;
    tetrahedra.reserve(triangulation.number_of_finite_cells());
    for (const auto cell : triangulation.finite_cell_handles()) {
        std::array<int, 4> t;
        for (int i = 0; i < 4; ++i) t[i] = cell->vertex(i)->info();
        // Pairs of exchanges bring the lowest number first and keep the orientation, so that the order of the
        // list is one of numbers and not of storage.
        const auto lowest = std::min_element(t.begin(), t.end()) - t.begin();
        if (lowest != 0) {
            std::swap(t[0], t[lowest]);
            std::swap(t[2], t[3]);
        }
        while (t[1] > t[2] || t[1] > t[3]) std::rotate(t.begin() + 1, t.begin() + 2, t.end());
        tetrahedra.push_back(t);
    }
    std::sort(tetrahedra.begin(), tetrahedra.end());
    return tetrahedra;
}

} // namespace kaya
