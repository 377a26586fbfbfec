// Edges of blocks with equal divisions, since they are opposite edges of a face of cells. Private to geometry.
#pragma once

#include "geometry/mesh/edge_field.hpp"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace kaya {

/// An edge that blocks share: the numbers of its two ends, the lower one first.
using SharedEdge = std::array<int, 2>;

/// An edge of a block's grid along one of its axes.
struct GridEdge {
    SharedEdge edge;
    bool turned;   ///< the axis runs from its higher end to its lower one
    Vec3 from, to; ///< along the axis
};
using GridEdges = std::array<std::array<GridEdge, 4>, 3>; ///< by axis

/// Classes of edges, each with one direction and one division.
class EdgeClasses {
public:
    /// Edges that are divided already, from their lower end: positions of the points on a unit length, with its ends.
    EdgeClasses(std::map<SharedEdge, std::vector<double>> given, const EdgeField& field)
        : given_(std::move(given)), field_(field) {}

    /// Makes one class of the four edges of each axis. False, and nothing happens, when edges of a class would have to have opposite directions, or
    /// cells much longer or shorter than they should be, because the row of blocks gets wider and wider.
    bool admit(const GridEdges& grid);
    /// An edge that continues another has its direction, unless that leads to a contradiction. `turned`: they begin at the same place.
    void follow(const GridEdge& a, const GridEdge& b, bool turned);

    /// For the axis of an edge, with all edges admitted.
    bool is_turned(const GridEdge& edge); ///< the axis is against the direction of the class
    std::vector<double> division(const GridEdge& edge);

private:
    struct Class {
        SharedEdge lowest;
        EdgeParts parts;
        double least, most; ///< parts of the edges
        std::optional<std::vector<double>> given;
    };
    /// Members of trees, each with a direction against that of the one above.
    struct Forest {
        std::vector<int> parent;
        std::vector<bool> turned;

        int add();
        std::pair<int, bool> root(int number);
    };
    int member(const GridEdge& edge);
    std::pair<int, bool> root(const GridEdge& edge); ///< and whether the axis is against it
    bool can_admit(const std::array<GridEdge, 4>& row);
    bool unite(const GridEdge& a, const GridEdge& b);

    std::map<SharedEdge, std::vector<double>> given_;
    EdgeField field_;
    std::map<SharedEdge, int> numbers_;
    std::vector<Class> classes_;
    Forest edges_, rows_; ///< edges of a class; classes that follow each other
};

} // namespace kaya
