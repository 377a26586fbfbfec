// Where fractures meet each other and plane polygons, and which of them are connected.
#pragma once

#include "geometry/fractures/fracture.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace kaya {

struct Segment {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double length() const { return (to - from).norm(); }
};

/// Where a fracture crosses the polygon, which may be concave: none, one or several parts of one line. Planes that are parallel within 1e-9
/// have no trace.
std::vector<Segment> traces_on(const std::vector<Vec3>& polygon, const Fracture& fracture);

/// What is measured on the traces of fractures on polygons.
struct TraceMeasures {
    double area = 0;         ///< of the polygons
    double length = 0;       ///< of the traces
    std::size_t number = 0;  ///< of traces
    std::size_t centres = 0; ///< of whole traces, in the plane of a polygon, whose middle lies on the polygon
};
TraceMeasures trace_measures(const std::vector<std::vector<Vec3>>& polygons, const std::vector<Fracture>& fractures);

/// The line on which two fractures of a list meet.
struct Intersection {
    std::array<std::size_t, 2> fractures;
    Segment line;
};
std::vector<Intersection> intersections_of(const std::vector<Fracture>& fractures);

/// The cluster of each fracture: those that intersections connect have the same number. Counts from 0, the cluster with the most fractures
/// first.
std::vector<std::size_t> clusters_of(std::size_t fractures, const std::vector<Intersection>& intersections);

} // namespace kaya
