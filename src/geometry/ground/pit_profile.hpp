// Heights of a pit wall over the distance from its crest, and where its ramp runs.
#pragma once

#include "geometry/ground/pit_design.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace kaya {

/// Faces and berms below the crest, which is at 0.
class PitProfile {
public:
    explicit PitProfile(const PitDesign& design);

    double depth() const { return depth_; }        ///< of the floor
    double width() const { return knots_.back(); } ///< from the crest to the floor
    /// Distances where a face or a berm begins or ends.
    const std::vector<double>& knots() const { return knots_; }
    /// Height at a distance, 0 or less.
    double height(double distance) const;
    /// Distances at which the wall reaches a height and leaves it: the two sides of a berm.
    double first_at(double height) const;
    double last_at(double height) const;
    /// The same with a ramp of that height whose width there is `shift`.
    double height(double distance, double ramp, double shift) const;

private:
    double bench_, slope_, berm_, depth_;
    std::vector<double> knots_;
};

/// A part of an edge where the ramp's height and width change evenly.
struct RampPart {
    double from = 0, to = 0;        ///< along the edge
    std::array<double, 2> height{}; ///< at both ends
    std::array<double, 2> shift{};  ///< width at both ends
};

/// One edge of a crest: how long it is, and how fast it gets shorter inward at its ends (the cotangent of half the angle there).
struct CrestEdge {
    double length = 0;
    std::array<double, 2> shrinks{};
    double until = 0; ///< inward distance at which it or an adjacent edge vanishes
};

/// The parts of all edges that the ramp follows, for a ramp that begins on edge `first` at the distance `at` along it and follows the edges
/// in order. Throws Diagnostic where it finds no room.
std::vector<std::vector<RampPart>> ramp_parts(const PitProfile& profile, const PitRamp& ramp,
                                              const std::vector<CrestEdge>& edges, std::size_t first, double at);

} // namespace kaya
