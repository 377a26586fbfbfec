#include "geometry/mesh/delaunay.hpp"

#include "base/stop_point.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <algorithm>
#include <numeric>

namespace kaya {

std::vector<std::array<int, 4>> delaunay(const std::vector<Vec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
    using Storage = CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
    using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Storage>;

    std::vector<Kernel::Point_3> places;
    places.reserve(points.size());
    for (const Vec3& p : points) places.emplace_back(p.x(), p.y(), p.z());
    // As CGAL inserts a range of points, but one by one: the user may want to stop.
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    using Map = CGAL::Pointer_property_map<Kernel::Point_3>::type;
    CGAL::spatial_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(CGAL::make_property_map(places)));
    Triangulation triangulation;
    StopPoints stops;
    Triangulation::Cell_handle near;
    for (const std::size_t i : order) {
        stops.pass();
        const auto vertex = triangulation.insert(places[i], near);
        vertex->info() = static_cast<int>(i);
        near = vertex->cell();
    }

    std::vector<std::array<int, 4>> tetrahedra;
    tetrahedra.reserve(triangulation.number_of_finite_cells());
    for (const auto cell : triangulation.finite_cell_handles()) {
        std::array<int, 4> t;
        for (int i = 0; i < 4; ++i) t[i] = cell->vertex(i)->info();
        // Even permutations bring the lowest number first and keep the orientation, so the order of the list does not depend on storage.
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
