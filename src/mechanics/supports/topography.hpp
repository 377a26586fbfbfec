// The weight above a place: stress below a surface that is not flat.
#pragma once

#include "model/measure/cell_faces.hpp"

#include <vector>

namespace kaya {

/// The weight of all blocks straight above a place. Built once for a model; queries do not change it.
class Overburden {
public:
    /// Throws Diagnostic when gravity does not point down along z, or a block has no density.
    explicit Overburden(const Model& model);

    /// Weight per horizontal area of the blocks above the place: the sum over blocks of density times gravity times the height of the block
    /// on a vertical line through the place. Holes weigh nothing.
    double at(const Vec3& place) const;

private:
    /// Cells of a grid over x and y, and the parts above each.
    std::size_t cell(int i, int j) const {
        return static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
    }
    int index(double place, int axis) const;

    const Model& model_;
    /// A triangle of a block, or of an outer face of a cell along either diagonal.
    struct Part {
        TriangleCorners corners;
        double weight; ///< per volume below or above it
    };
    std::vector<Part> parts_;
    Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
    std::size_t columns_ = 1;
    std::vector<std::vector<std::size_t>> above_;
};

} // namespace kaya
