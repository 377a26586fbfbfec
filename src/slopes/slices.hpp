// Factors of safety of a body of slices above a slip surface. Two dimensions, a thickness of 1.
#pragma once

#include "slopes/strength.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace kaya {

/// One slice. It slides to the right; lengths and angles refer to that direction.
struct Slice {
    double width = 0;          ///< length
    double base_angle = 0;     ///< radians, positive where the base goes down to the right
    double weight = 0;         ///< force/length
    double pore_pressure = 0;  ///< stress, at the middle of the base
    double downward = 0;       ///< load on the slice, force/length
    double rightward = 0;      ///< the same
    double water_push = 0;     ///< part of it that is the pressure of open water
    double still_pressure = 0; ///< part of the pore pressure that open water above the slice has at rest
    double load_moment = 0;    ///< of both about the middle of the base, clockwise
    double centroid_arm = 0;   ///< height of the centre of weight above the middle of the base
    const Strength* strength = nullptr;

    double base_length() const;
};

/// The body from its upper end on the left to its lower end on the right.
struct SlipBody {
    std::vector<Slice> slices;
    double seismic = 0;           ///< horizontal acceleration over gravity, to the right
    double water_force = 0;       ///< of water in a tension crack at the left end, force/length
    double water_arm = 0;         ///< its height above the slip surface there
    std::optional<double> radius; ///< of a circle; a method of moments needs it
    /// Heights of the centre of the circle above the middles of the bases; of a circle only.
    std::vector<double> centre_heights;
    double water_height = 0; ///< of the centre above the water force
    double depth_ratio =
        0; ///< greatest depth below the chord of the ends over the length of the chord (Janbu's correction)
};

enum class SliceMethod { ordinary, bishop, janbu, spencer, morgenstern_price };

std::string_view name_of(SliceMethod method);
/// Whether the method requires a circle: it uses moments only.
bool needs_circle(SliceMethod method);

struct SliceAnswer {
    double factor = 0;
    double lambda = 0; ///< of spencer and morgenstern-price: shear over normal force between slices where f = 1
    int pulled = 0;    ///< slices with tension on the base
    bool thrust_inside =
        true; ///< whether the line of thrust is within the body (or at most a third of its height outside)
};

/// The factor by which the strength of all bases can be divided. Not given where the equations have no answer, and where
/// the body does not slide to the right.
///  ordinary          Fellenius 1936: no forces between slices
///  bishop            Bishop 1955, simplified: they are horizontal; moments about the centre
///  janbu             Janbu 1954, simplified: they are horizontal; horizontal forces; corrected by the depth of the surface
///  spencer           Spencer 1967: parallel; horizontal forces and moments
///  morgenstern_price Morgenstern and Price 1965, their inclination follows half a sine; horizontal forces and moments
std::optional<SliceAnswer> factor_of_safety(const SlipBody& body, SliceMethod method);

} // namespace kaya
