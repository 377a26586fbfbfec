#include "geometry/fractures/fracture_law.hpp"

#include "base/diagnostic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {
namespace {

constexpr double full_turn = 360;

/// In (0, 1].
double above_zero(Random& random) { return 1 - random.uniform(); }

/// Of the normal distribution, by Box and Muller 1958 (Ann. Math. Statist. 29).
double normal_number(Random& random) {
    const double radius = std::sqrt(-2 * std::log(above_zero(random)));
    return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

/// A value within the limits.
template <class Limits, class Draw> double within(const Limits& limits, const char* what, Draw draw) {
    constexpr int most_tries = 100'000;
    for (int k = 0; k < most_tries; ++k)
        if (const double x = draw(); limits.hold(x)) return x;
    throw Diagnostic(
        fmt::format("of {} values for the {} none is from {:g} to {:g}", most_tries, what, limits.low, limits.high),
        "widen the limits, or move the mean into them");
}

/// A direction with uniform angle around `axis` and that cosine to it.
Vec3 around(const Vec3& axis, double cosine, Random& random) {
    const double turn = 2 * std::numbers::pi * random.uniform(), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const Vec3 one = axis.unitOrthogonal(), other = axis.cross(one);
    return cosine * axis + sine * (std::cos(turn) * one + std::sin(turn) * other);
}

/// Fisher 1953 (Proc. R. Soc. London A 217): the density of a direction grows with exp(kappa cos).
double fisher_cosine(double kappa, Random& random) {
    const double u = above_zero(random);
    if (kappa == 0) return 2 * u - 1;
    return 1 + std::log(u + (1 - u) * std::exp(-2 * kappa)) / kappa;
}

void direct(Disc& disc, const FractureLaw& law, Random& random) {
    using enum FractureLaw::Orientation;
    switch (law.orientation) {
    case uniform: set_normal(disc, around(Vec3::UnitZ(), random.symmetric(), random)); return;
    case fisher: {
        const Vec3 mean = normal_of({Vec3::Zero(), law.dip, law.dip_direction, 1});
        set_normal(disc, around(mean, fisher_cosine(law.kappa, random), random));
        return;
    }
    case gauss:
        disc.dip = law.dip + law.dip_deviation * normal_number(random);
        disc.dip_direction = law.dip_direction + law.dip_direction_deviation * normal_number(random);
        set_normal(disc, normal_of(disc));
        return;
    case bootstrapped: {
        const MeasuredPlane& plane = law.planes.draw(random);
        disc.dip = plane.dip;
        disc.dip_direction = plane.dip_direction;
        return;
    }
    }
}

/// From low to high with a density that falls with the diameter to the power -exponent.
double power_law_size(const FractureLaw& law, Random& random) {
    const double u = random.uniform(), a = law.exponent - 1, low = law.sizes.low, high = law.sizes.high;
    if (a == 0) return low * std::pow(high / low, u);
    const double left = std::isinf(high) ? 0 : std::pow(high / low, -a);
    return low * std::pow(1 - u * (1 - left), -1 / a);
}

double draw_size(const FractureLaw& law, Random& random) {
    using enum FractureLaw::Size;
    switch (law.size) {
    case power_law: return std::clamp(power_law_size(law, random), law.sizes.low, law.sizes.high);
    case log_normal: {
        const double variance = std::log1p(std::pow(law.deviation / law.mean, 2));
        return std::exp(std::log(law.mean) - 0.5 * variance + std::sqrt(variance) * normal_number(random));
    }
    case gauss: return law.mean + law.deviation * normal_number(random);
    case exponential: return -law.mean * std::log(above_zero(random));
    case uniform: return law.sizes.low + random.uniform() * (law.sizes.high - law.sizes.low);
    case bootstrapped: return law.diameters.draw(random);
    }
    return 0;
}

/// A sample has a value within the limits.
void check_samples(const FractureLaw& law) {
    const auto plane = [&](const MeasuredPlane& p) {
        return law.dips.hold(p.dip) && law.dip_directions.hold(p.dip_direction);
    };
    if (law.orientation == FractureLaw::Orientation::bootstrapped && std::ranges::none_of(law.planes.values, plane))
        throw Diagnostic(
            fmt::format(
                "none of the {} measured planes has a dip from {:g} to {:g} and a dip direction from {:g} to {:g}",
                law.planes.values.size(), law.dips.low, law.dips.high, law.dip_directions.low, law.dip_directions.high),
            "widen dip-limits and dip-direction-limits");
    if (law.size == FractureLaw::Size::bootstrapped &&
        std::ranges::none_of(law.diameters.values, [&](double d) { return law.sizes.hold(d); }))
        throw Diagnostic(fmt::format("none of the {} measured sizes is from {:g} to {:g}", law.diameters.values.size(),
                                     law.sizes.low, law.sizes.high),
                         "widen size-limits");
}

} // namespace

double Directions::width() const {
    const double span = high - low;
    return span < 0 ? span + full_turn : span;
}

bool Directions::hold(double direction) const {
    constexpr double rounding = 1e-9; // of 330.1 and -29.9
    double beyond = std::fmod(direction - low, full_turn);
    if (beyond < 0) beyond += full_turn;
    return beyond <= width() + rounding || beyond >= full_turn - rounding;
}

void check(const FractureLaw& law) {
    using enum FractureLaw::Size;
    const bool open = std::isinf(law.sizes.high);
    if (law.size == uniform && open)
        throw Diagnostic("sizes that are uniform need their limits", "write: size uniform size-limits 1 5");
    if (law.size == power_law && open && law.exponent <= 1)
        throw Diagnostic(
            fmt::format("a power law with the exponent {:g} has no mean without a greatest size", law.exponent),
            "give an exponent above 1, or limits: size-limits 1 50");
    for (const auto& [limits, what] : {std::pair{law.sizes, "sizes"}, {law.dips, "dips"}})
        if (!(limits.low <= limits.high))
            throw Diagnostic(fmt::format("the limits of {} are {:g} and {:g}: the first is the greater one", what,
                                         limits.low, limits.high),
                             "give the least value first");
    check_samples(law);
}

Disc draw(const FractureLaw& law, const Vec3& low, const Vec3& high, Random& random) {
    Disc disc;
    for (int k = 0; k < 3; ++k) disc.centre[k] = low[k] + random.uniform() * (high[k] - low[k]);
    within(law.dips, "dip", [&] {
        within(law.dip_directions, "dip direction", [&] {
            direct(disc, law, random);
            return disc.dip_direction;
        });
        return disc.dip;
    });
    disc.diameter = within(law.sizes, "size", [&] { return draw_size(law, random); });
    return disc;
}

} // namespace kaya
