// The closed part of an overlap as two halves, the deeper and the shallower one: docs/theory/contacts.md, (10c) and (10d).
#pragma once

#include "mechanics/shape/overlap_patch.hpp"

#include <array>

namespace kaya {

/// A normal spring of area 1 at a closure, and its energy there.
struct HalfSpring {
    double stress = 0, stiffness = 0, energy = 0;
};

/// Area and closures of two halves that have the volume and the energy of an overlap.
class ClosedHalves {
public:
    /// `whole`: common area of the two faces; 0 where it is not known, as for edges and corners.
    ClosedHalves(const OverlapSlopes& slopes, double whole);

    double area() const { return area_; }                     ///< of both
    double closure(int half) const { return closure_[half]; } ///< 0: the deeper one
    /// Carriers that have an area together; the first and the third are the deeper half.
    CarrierRows rows(double area) const {
        return {area / carriers, {closure_[0], closure_[1], closure_[0], closure_[1]}};
    }

    using Springs = std::array<HalfSpring, 2>;
    double energy(const Springs& springs) const { return 0.5 * area_ * (springs[0].energy + springs[1].energy); }

    /// Minus the gradient of that energy.
    OverlapGradient push(const Springs& springs) const;

private:
    enum class Shape { strip, trapezoid, even };

    const OverlapSlopes& slopes_;
    Shape shape_;
    double even_area_; ///< of parallel faces of the same volume and energy
    double part_;      ///< of the whole area that it is
    double area_;
    std::array<double, 2> closure_;
};

} // namespace kaya
