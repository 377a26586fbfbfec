// Springs whose stiffness is a power of the normal stress, between a least and a greatest value:
//     k = min(max(k_1 sigma^e, k_min), k_max),
// and what joint models with such springs share.
// In closure the normal spring is a curve that is known in closed form, so a joint that loads and unloads comes back to its
// place exactly, whatever its steps.
#pragma once

#include "stdlib/joints/elementary.hpp"

#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>

namespace kaya::joints {

/// What a least stiffness is that nobody gave: a hundredth of that at a normal stress of 1.
constexpr double default_least_part = 0.01;

/// Stiffness over normal stress.
struct PowerStiffness {
    double at_one, exponent, least, greatest;

    PowerStiffness(double at_one_, double exponent_, double least_, double greatest_)
        : at_one(at_one_), exponent(exponent_),
          least(std::isnan(least_) ? (exponent_ > 0 ? default_least_part * at_one_ : 0) : least_),
          greatest(std::isnan(greatest_) ? INFINITY : greatest_) {}

    [[gnu::always_inline]] double at(double stress) const {
        return std::min(std::max(at_one * power(std::max(stress, no_stress), exponent), least), greatest);
    }

    /// The normal stress at which the power has this value; 0 for a constant below, infinite for one above.
    double stress_of(double stiffness) const {
        if (exponent == 0) return stiffness > at_one ? INFINITY : 0;
        return std::pow(stiffness / at_one, 1 / exponent);
    }

    static constexpr double no_stress = 1e-300; ///< stands for 0, which has no logarithm
};

/// The closure curve that has this stiffness: straight, power, straight.
class PowerSpring {
public:
    explicit PowerSpring(const PowerStiffness& stiffness)
        : stiffness_(stiffness), first_(stiffness.at(0)), constant_(stiffness.exponent == 0 ? 1 : 0),
          exponential_(stiffness.exponent == 1 ? 1 : 0), power_from_(stiffness.stress_of(stiffness.least)),
          closure_from_(power_from_ > 0 ? power_from_ / stiffness.least : 0) {
        const double e = stiffness.exponent;
        factor_ = stiffness.at_one * (exponential_ > 0 ? 1 : 1 - e);
        begin_ = exponential_ > 0 ? std::log(power_from_) : std::pow(power_from_, 1 - e);
        inverse_ = exponential_ > 0 ? 1 : 1 / (1 - e);
        const double power_to = std::max(power_from_, stiffness.stress_of(stiffness.greatest));
        if (!std::isfinite(power_to)) return;
        power_to_ = power_to;
        last_ = stiffness.greatest;
        closure_to_ = closure_from_ + on_power(power_to);
    }

    const PowerStiffness& stiffness() const { return stiffness_; }
    [[gnu::always_inline]] double tangent(double stress) const { return stiffness_.at(stress); }
    double first_tangent() const { return first_; }

    /// Below a closure of 0 the first straight part goes on.
    [[gnu::always_inline]] double stress(double closure) const {
        const double along = factor_ * std::max(0.0, closure - closure_from_);
        const double logarithm_of_stress =
            exponential_ > 0 ? begin_ + along : inverse_ * logarithm(std::max(begin_ + along, PowerStiffness::no_stress));
        const double curved = exponential(std::min(700.0, std::max(-700.0, logarithm_of_stress)));
        const double on_curve = constant_ > 0 ? power_from_ + along : curved;
        const double beyond = power_to_ + last_ * (closure - closure_to_);
        const double pressed = closure > closure_to_ ? beyond : on_curve;
        return closure <= closure_from_ ? first_ * closure : pressed;
    }

    double closure(double stress) const {
        if (stress <= power_from_) return stress / first_;
        if (stress > power_to_) return closure_to_ + (stress - power_to_) / last_;
        return closure_from_ + on_power(stress);
    }

private:
    /// Closure between the beginning of the power and a stress on it.
    double on_power(double stress) const {
        const double end = exponential_ > 0 ? std::log(stress) : std::pow(stress, 1 - stiffness_.exponent);
        return (end - begin_) / factor_;
    }

    PowerStiffness stiffness_;
    double first_;                     ///< tangent of the first straight part
    double constant_, exponential_;    ///< 1 for the exponents 0 and 1: numbers, which a vector instruction can compare
    double power_from_, closure_from_; ///< where the power begins
    double factor_, begin_, inverse_;  ///< on it: stress = (begin + factor closure)^inverse, or e to that sum
    double power_to_ = INFINITY, closure_to_ = INFINITY, last_ = 0; ///< where it ends, and the tangent beyond
};

/// What is wrong with the values of a stiffness, or null: `texts` says so for least <= 0, least > greatest.
inline const char* fault_of_limits(const PowerStiffness& k, const char* no_least, const char* crossed) {
    if (!((k.exponent > 0 ? k.least : k.at(0)) > 0)) return no_least;
    return k.least > k.greatest ? crossed : nullptr;
}

/// The springs of a joint.
struct PowerSprings {
    PowerSpring normal;
    PowerStiffness shear;

    /// What is wrong with them, or null.
    const char* fault() const {
        if (const char* of_normal = fault_of_limits(
                normal.stiffness(), "kn-minimum is 0: a joint without stiffness at first touch never closes, give a small value",
                "kn-minimum is above kn-maximum: exchange them"))
            return of_normal;
        return fault_of_limits(shear, "ks-minimum is 0: give the joint a small shear stiffness at first touch",
                               "ks-minimum is above ks-maximum: exchange them");
    }

    /// The closure of new rows, which agrees with their force or with their gap, and their stiffnesses.
    void begin(kaya_jbatch& batch, double* closures) const {
        for (std::size_t i = 0; i < batch.n; ++i) {
            const double stress = batch.area[i] > 0 ? batch.normal_force[i] / batch.area[i] : 0;
            closures[i] = stress != 0 ? normal.closure(stress) : std::min({0.0, closures[i], -batch.normal_disp[i]});
            batch.normal_stiffness[i] = normal.tangent(stress);
            batch.shear_stiffness[i] = shear.at(stress);
        }
    }
};

} // namespace kaya::joints
