// A slope in a vertical plane: positions and strengths of its materials.
#pragma once

#include "slopes/slices.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Distance along the section, and height.
using SectionPoint = Eigen::Vector2d;

/// A convex part of the section. Parts do not overlap.
struct SectionCell {
    std::vector<SectionPoint> corners; ///< in any sense
    double unit_weight = 0;            ///< force/length^3
    std::size_t strength = 0;          ///< index into SlopeSection::strengths
};

/// A stress on a straight line, per length of it and per thickness: vectors at its ends, which change evenly between them.
struct SectionTraction {
    SectionPoint from, to, at_from, at_to;
};

/// A force, per thickness.
struct SectionForce {
    SectionPoint at, force;
};

/// A joint: a slip surface that runs along it has its strength.
struct SectionJoint {
    SectionPoint from, to;
    std::size_t strength = 0;
};

struct SlopeSection {
    std::vector<SectionCell> cells;
    std::vector<SectionJoint> joints;
    std::vector<Strength> strengths;
    std::vector<std::string> names;                           ///< of the strengths, as users read them
    std::vector<SectionTraction> tractions;                   ///< on the ground, from left to right
    std::vector<SectionForce> forces;                         ///< of point loads and structures, the same
    std::function<double(const SectionPoint&)> pore_pressure; ///< stress; empty: none
    double pressure_ratio = 0;  ///< additional pore pressure, over the weight of the column above
    double water_weight = 0;    ///< force/length^3, of water in a tension crack
    bool water_is_open = false; ///< above the ground it is water that loads it, not the pressure of a field
    double seismic = 0;         ///< horizontal acceleration over gravity, in the direction of sliding
    double crack_depth = 0;     ///< depth below the ground at which a slip surface ends
    double crack_water = 0;     ///< height of water in the crack
};

/// The section as columns: between two consecutive corners the vertical order of materials does not change.
class SlopeColumns {
public:
    /// Throws Diagnostic when there are no cells.
    explicit SlopeColumns(const SlopeSection& section);

    const SlopeSection& section() const { return section_; }
    /// The ground surface from left to right; upright parts are two points of equal distance.
    const std::vector<SectionPoint>& ground() const { return ground_; }
    double left() const { return ground_.front().x(); }
    double right() const { return ground_.back().x(); }
    double lowest() const { return lowest_; }

    /// Height of the ground; on an upright part that of its left or its right side. None outside of the section.
    enum class Side { left, right };
    std::optional<double> ground_at(double distance, Side side = Side::right) const;

    /// Weight of a column of width 1 above a height, and the first moment of it about that height.
    struct Column {
        double weight = 0, moment = 0;
    };
    Column column(const SectionPoint& base) const;
    /// The strength at a place on a slip surface of that direction: of a joint that it runs along, else of the cell. A zero direction
    /// runs along no joint. Null outside of the ground.
    const Strength* strength_at(const SectionPoint& place, const SectionPoint& along) const;
    /// The base of a layer on a material that is stronger under the present weight, from left to right.
    struct Base {
        SectionPoint from, to;
    };
    std::vector<Base> bases_of_weak_layers() const;

private:
    struct Layer {
        std::size_t cell;
        double top_left, top_right, bottom_left, bottom_right;
    };
    struct Strip {
        double from, to;
        std::vector<Layer> layers; ///< from the top
    };
    const Strip* strip_at(double distance) const;

    const SlopeSection& section_;
    std::vector<Strip> strips_;
    std::vector<SectionPoint> ground_;
    double lowest_ = 0, near_ = 0;
};

/// A slip surface: points from one end to the other, in order along the section; both ends lie on the ground.
struct SlipSurface {
    std::vector<SectionPoint> points;
    struct Circle {
        SectionPoint centre;
        double radius;
    };
    std::optional<Circle> circle;
};

/// The circle's lower part that cuts off the deepest part of the ground. None when it cuts nothing off or leaves the section.
std::optional<SlipSurface> circle_surface(const SlopeColumns& columns, const SectionPoint& centre, double radius);

/// The body above a surface in about so many slices; it slides from its higher end to its lower one. None when the surface leaves the
/// section or the ground passes below it. The tension crack of the section cuts off its upper end.
std::optional<SlipBody> body_above(const SlopeColumns& columns, const SlipSurface& surface, int slices);

} // namespace kaya
