#include "mechanics/contact/closed_halves.hpp"

#include <cmath>

namespace kaya {

namespace {

/// Closures of a strip that is open at one end over the mean closure 2U/V, at the two places of Gauss: 3/4 (1 +- 1/sqrt 3).
constexpr double strip_part = 0.75;
const std::array<double, 2> strip_closure{strip_part * (1 + std::sqrt(1.0 / 3)), strip_part*(1 - std::sqrt(1.0 / 3))};

} // namespace

ClosedHalves::ClosedHalves(const OverlapSlopes& slopes, double whole) : slopes_(slopes) {
    const double w = slopes.closure.value;
    even_area_ = 2 * slopes.energy.value / (w * w);
    part_ = whole > 0 ? even_area_ / whole : 0;
    shape_ = part_ <= strip_part ? Shape::strip : part_ < 1 ? Shape::trapezoid : Shape::even;
    const double spread = shape_ == Shape::trapezoid ? std::sqrt(part_ * (1 - part_)) : 0;
    switch (shape_) {
    case Shape::strip:
        area_ = even_area_ / strip_part;
        closure_ = {strip_closure[0] * w, strip_closure[1] * w};
        break;
    case Shape::trapezoid:
        area_ = whole;
        closure_ = {(part_ + spread) * w, (part_ - spread) * w};
        break;
    case Shape::even: area_ = even_area_, closure_ = {w, w}; break;
    }
}

OverlapGradient ClosedHalves::push(const Springs& springs) const {
    const double w = slopes_.closure.value, energies = springs[0].energy + springs[1].energy,
                 stresses = springs[0].stress + springs[1].stress;
    double of_energy = 0, of_closure = 0;
    switch (shape_) {
    case Shape::strip:
        of_energy = energies / (strip_part * w * w);
        of_closure =
            even_area_ / strip_part *
            (0.5 * (strip_closure[0] * springs[0].stress + strip_closure[1] * springs[1].stress) - energies / w);
        break;
    case Shape::trapezoid: {
        const double spread = 0.5 * (closure_[0] - closure_[1]);
        constexpr double narrow = 1e-7; // of the closure: the difference of the stresses is rounding
        const double slope = spread > narrow * w ? (springs[0].stress - springs[1].stress) / spread
                                                 : springs[0].stiffness + springs[1].stiffness;
        of_energy = stresses / w + 0.5 * slope * (1 - 2 * part_);
        of_closure = 0.5 * even_area_ * (slope * part_ * w - stresses);
        break;
    }
    case Shape::even:
        of_energy = energies / (w * w);
        of_closure = even_area_ * (0.5 * stresses - energies / w);
        break;
    }
    OverlapGradient push;
    push.add(slopes_.energy, of_energy);
    push.add(slopes_.closure, of_closure);
    return push;
}

} // namespace kaya
