#include "slopes/strength.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {

namespace {

constexpr double radian = std::numbers::pi / 180;

Coulomb barton_tangent(const Strength::Barton& joint, double normal_stress) {
    // The logarithm has no end at zero stress; there the largest angle holds.
    const double n = std::max(normal_stress, 1e-12 * joint.jcs);
    const double roughness = std::max(0.0, joint.jrc * std::log10(joint.jcs / n));
    const double angle = joint.residual_friction + roughness;
    if (angle >= joint.largest_angle) return {0, std::tan(joint.largest_angle * radian)};
    const double stress = n * std::tan(angle * radian);
    if (roughness == 0) return {0, std::tan(angle * radian)};
    const double cosine = std::cos(angle * radian);
    const double slope = std::tan(angle * radian) - joint.jrc * radian / (std::numbers::ln10 * cosine * cosine);
    return {stress - slope * n, slope};
}

/// The envelope by its minor stress: normal stress, and the tangent there.
struct EnvelopePoint {
    double normal, shear, tangent;
};

EnvelopePoint hoek_brown_point(const Strength::HoekBrown& rock, double minor) {
    const double base = std::max(rock.mb * minor / rock.strength + rock.s, 1e-30);
    const double major = minor + rock.strength * std::pow(base, rock.a);
    const double ratio =
        1 + rock.a * rock.mb * std::pow(base, rock.a - 1); // of the increments of major and minor stress
    const double normal = minor + (major - minor) / (ratio + 1);
    return {normal, (normal - minor) * std::sqrt(ratio), (ratio - 1) / (2 * std::sqrt(ratio))};
}

Coulomb hoek_brown_tangent(const Strength::HoekBrown& rock, double normal_stress) {
    double low = -rock.s * rock.strength / rock.mb,
           high = normal_stress; // the minor stress; the normal stress grows with it
    for (int i = 0; i < 200 && high - low > 1e-14 * std::max({std::abs(low), std::abs(high), 1e-12 * rock.strength});
         ++i) {
        const double middle = 0.5 * (low + high);
        (hoek_brown_point(rock, middle).normal < normal_stress ? low : high) = middle;
    }
    const EnvelopePoint at = hoek_brown_point(rock, 0.5 * (low + high));
    return {at.shear - at.tangent * normal_stress, at.tangent};
}

} // namespace

Strength Strength::coulomb(double cohesion, double friction) {
    Strength strength;
    strength.kind_ = Kind::coulomb;
    strength.line_ = {cohesion, std::tan(friction * radian)};
    return strength;
}

Strength Strength::barton(const Barton& joint) {
    Strength strength;
    strength.kind_ = Kind::barton;
    strength.barton_ = joint;
    return strength;
}

Strength Strength::hoek_brown(const HoekBrown& rock) {
    Strength strength;
    strength.kind_ = Kind::hoek_brown;
    strength.hoek_brown_ = rock;
    return strength;
}

Coulomb Strength::tangent(double normal_stress) const {
    const double n = std::max(0.0, normal_stress);
    switch (kind_) {
    case Kind::none: return {1e30, 0};
    case Kind::coulomb: return line_;
    case Kind::barton: return barton_tangent(barton_, n);
    case Kind::hoek_brown: return hoek_brown_tangent(hoek_brown_, n);
    }
    return {};
}

} // namespace kaya
