// Springs whose stiffness is a power of the normal stress, between a least and a greatest value:
//     k = min(max(k_1 |sigma|^e, k_min), k_max),
// shared by the joint models with such springs. In closure the normal spring is a curve in closed form, so a joint that loads and unloads
// returns exactly to its initial closure, for any steps. Without a least value the curve begins with the tangent 0 and is a pure power,
// which is the same in every unit.
#pragma once

#include "kaya/law/elementary.hpp"

#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>

namespace kaya::joints {

/// Stiffness over normal stress; the same for tension as for compression.
struct PowerStiffness {
    double at_one, exponent, least, greatest;

    PowerStiffness(double at_one_, double exponent_, double least_, double greatest_)
        : at_one(at_one_), exponent(exponent_), least(std::isnan(least_) ? 0 : least_),
          greatest(std::isnan(greatest_) ? INFINITY : greatest_) {}

    /// Above 0 at any stress, so that it can divide.
    [[gnu::always_inline]] double at(double stress) const {
        return std::min(std::max(at_one * power(std::max(std::abs(stress), no_stress), exponent), least), greatest);
    }

    /// The normal stress at which the power has this value; 0 for a constant below, infinite for one above.
    double stress_of(double stiffness) const {
        if (exponent == 0) return stiffness > at_one ? INFINITY : 0;
        return std::pow(stiffness / at_one, 1 / exponent);
    }

    static constexpr double no_stress = 1e-290; ///< used for 0, which has no logarithm
};

/// The closure curve that has this stiffness: straight, power, straight; odd, so that a bond pulls as it pushes. An exponent
/// of 1 needs a least stiffness: an exponential does not pass through 0.
class PowerSpring {
public:
    explicit PowerSpring(const PowerStiffness& stiffness)
        : stiffness_(stiffness), first_(stiffness.exponent == 0 ? stiffness.at(0) : stiffness.least),
          constant_(stiffness.exponent == 0 ? 1 : 0), exponential_(stiffness.exponent == 1 ? 1 : 0),
          power_from_(stiffness.stress_of(stiffness.least)),
          closure_from_(power_from_ > 0 ? power_from_ / stiffness.least : 0) {
        const double e = stiffness.exponent;
        factor_ = stiffness.at_one * (exponential_ > 0 ? 1 : 1 - e);
        begin_ = exponential_ > 0 ? std::log(power_from_) : std::pow(power_from_, 1 - e);
        inverse_ = exponential_ > 0 ? 1 : 1 / (1 - e);
        energy_begin_ = power_from_ > 0 ? std::pow(power_from_, 2 - e) : 0;
        if (first_ == 0 && exponential_ == 0) {
            constexpr double of_size = 1e-6;
            growth_ = 0.5 * e * inverse_;
            grows_from_ = std::min(stiffness.at_one * std::pow(factor_ * of_size, e * inverse_), stiffness.greatest);
        }
        const double power_to = std::max(power_from_, stiffness.stress_of(stiffness.greatest));
        if (!std::isfinite(power_to)) return;
        power_to_ = power_to;
        last_ = stiffness.greatest;
        closure_to_ = closure_from_ + on_power(power_to);
    }

    const PowerStiffness& stiffness() const { return stiffness_; }
    [[gnu::always_inline]] double tangent(double stress) const { return stiffness_.at(stress); }

    /// The stiffness reported for the time step: the tangent. Where the curve begins with the tangent 0 it is that at a closure of a
    /// millionth of the sub-contact's size, since a stiffness of 0 gives no step.
    [[gnu::always_inline]] double reported(double stress, double area) const {
        return std::max(tangent(stress), grows_from_ * power(std::max(area, PowerStiffness::no_stress), growth_));
    }

    /// The stress that carries a closure; negative for an opening.
    [[gnu::always_inline]] double stress(double closure) const {
        const double size = pressed(std::abs(closure));
        return closure < 0 ? -size : size;
    }

    double closure(double stress) const {
        const double size = std::abs(stress), closed = closure_of_size(size);
        return stress < 0 ? -closed : closed;
    }

    /// Stored per area at a stress.
    [[gnu::always_inline]] double energy(double stress) const {
        const double size = std::abs(stress), e = stiffness_.exponent;
        const double on_line = std::min(size, power_from_), on_power = std::min(std::max(size, power_from_), power_to_);
        const double straight = power_from_ > 0 ? 0.5 * on_line * on_line / first_ : 0;
        const double rise = power(std::max(on_power, 1e-100), 2 - e);
        const double curved = (rise - energy_begin_) / ((2 - e) * stiffness_.at_one);
        const double beyond = size > power_to_ ? 0.5 * (size * size - power_to_ * power_to_) / last_ : 0;
        return straight + std::max(0.0, curved) + beyond;
    }

private:
    [[gnu::always_inline]] double pressed(double closure) const {
        const double along = factor_ * std::max(0.0, closure - closure_from_);
        const double logarithm_of_stress =
            exponential_ > 0 ? begin_ + along
                             : inverse_ * logarithm(std::max(begin_ + along, PowerStiffness::no_stress));
        const double curved = exponential(std::min(700.0, std::max(-700.0, logarithm_of_stress)));
        const double on_curve = constant_ > 0 ? power_from_ + along : curved;
        const double beyond = power_to_ + last_ * (closure - closure_to_);
        const double past_line = closure > closure_to_ ? beyond : on_curve;
        return closure <= closure_from_ ? first_ * closure : past_line;
    }

    double closure_of_size(double stress) const {
        if (stress == 0) return 0;
        if (stress <= power_from_) return stress / first_;
        if (stress > power_to_) return closure_to_ + (stress - power_to_) / last_;
        return closure_from_ + on_power(stress);
    }

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
    double energy_begin_;              ///< of the power part of its energy
    double grows_from_ = 0, growth_ = 0;                            ///< least that is reported, over the area
    double power_to_ = INFINITY, closure_to_ = INFINITY, last_ = 0; ///< where it ends, and the tangent beyond
};

/// The springs of a joint.
struct PowerSprings {
    PowerSpring normal;
    PowerStiffness shear;

    /// Why they are invalid, or null.
    const char* fault() const {
        const PowerStiffness& kn = normal.stiffness();
        if (kn.exponent == 1 && !(kn.least > 0))
            return "exponent-normal is 1, with which no closure leads from a normal stress of 0 to another: give kn-minimum, "
                   "the stiffness at first contact";
        if (!(kn.greatest > 0) || !(shear.greatest > 0))
            return "kn-maximum or ks-maximum is 0: leave it out for no limit";
        if (kn.least > kn.greatest) return "kn-minimum is above kn-maximum: exchange them";
        return shear.least > shear.greatest ? "ks-minimum is above ks-maximum: exchange them" : nullptr;
    }

    /// Initial stiffnesses of a sub-contact of area 1.
    void largest_at_start(double* kn, double* ks) const {
        *kn = normal.reported(0, 1);
        *ks = shear.at(0);
    }

    /// The closure of new rows, which agrees with their force or with their gap, and their stiffnesses.
    void begin(kaya_jbatch& batch, double* closures) const {
        for (std::size_t i = 0; i < batch.n; ++i) {
            const double stress = batch.area[i] > 0 ? batch.normal_force[i] / batch.area[i] : 0;
            closures[i] = stress != 0 ? normal.closure(stress) : std::min({0.0, closures[i], -batch.normal_disp[i]});
            batch.normal_stiffness[i] = normal.reported(stress, batch.area[i]);
            batch.shear_stiffness[i] = shear.at(stress);
        }
    }
};

} // namespace kaya::joints
