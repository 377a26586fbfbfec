// Springs whose stiffness is a power of the normal stress, between a least and a greatest value:
//     k = min(max(k_1 sigma^e, k_min), k_max).
// In closure it is a curve that is known in closed form, so a joint that loads and unloads comes back to its place
// exactly, whatever its steps.
#pragma once

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

    double at(double stress) const {
        const double k = exponent == 0 ? at_one : at_one * std::pow(std::max(0.0, stress), exponent);
        return std::min(std::max(k, least), greatest);
    }

    /// The normal stress at which the power has this value; 0 for a constant below, infinite for one above.
    double stress_of(double stiffness) const {
        if (exponent == 0) return stiffness > at_one ? INFINITY : 0;
        return std::pow(stiffness / at_one, 1 / exponent);
    }
};

/// The closure curve that has this stiffness: straight, power, straight.
class PowerSpring {
public:
    explicit PowerSpring(const PowerStiffness& stiffness)
        : stiffness_(stiffness), power_from_(stiffness.stress_of(stiffness.least)),
          power_to_(std::max(power_from_, stiffness.stress_of(stiffness.greatest))),
          closure_from_(power_from_ > 0 ? power_from_ / stiffness.least : 0) {
        closure_to_ = std::isfinite(power_to_) ? closure_from_ + on_power(power_to_) : INFINITY;
    }

    const PowerStiffness& stiffness() const { return stiffness_; }
    double tangent(double stress) const { return stiffness_.at(stress); }
    double first_tangent() const { return stiffness_.at(0); }

    /// Below a closure of 0 the first straight part goes on.
    double stress(double closure) const {
        if (closure <= closure_from_) return first_tangent() * closure;
        if (closure > closure_to_) return power_to_ + stiffness_.greatest * (closure - closure_to_);
        const double along = stiffness_.at_one * (closure - closure_from_), e = stiffness_.exponent;
        if (e == 1) return power_from_ * std::exp(along);
        return std::pow(std::pow(power_from_, 1 - e) + (1 - e) * along, 1 / (1 - e));
    }

    double closure(double stress) const {
        if (stress <= power_from_) return stress / first_tangent();
        if (stress > power_to_) return closure_to_ + (stress - power_to_) / stiffness_.greatest;
        return closure_from_ + on_power(stress);
    }

private:
    /// Closure between the beginning of the power and a stress on it.
    double on_power(double stress) const {
        const double e = stiffness_.exponent;
        if (e == 1) return std::log(stress / power_from_) / stiffness_.at_one;
        return (std::pow(stress, 1 - e) - std::pow(power_from_, 1 - e)) / ((1 - e) * stiffness_.at_one);
    }

    PowerStiffness stiffness_;
    double power_from_, power_to_; ///< normal stresses between which the power holds
    double closure_from_, closure_to_;
};

/// What is wrong with the values of a stiffness, or null: `texts` says so for least <= 0, least > greatest.
inline const char* fault_of_limits(const PowerStiffness& k, const char* no_least, const char* crossed) {
    if (!(k.at(0) > 0)) return no_least;
    return k.least > k.greatest ? crossed : nullptr;
}

} // namespace kaya::joints
