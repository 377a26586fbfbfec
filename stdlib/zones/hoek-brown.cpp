// Zone model `hoek-brown`: the generalised criterion, with a constant angle of dilation.
// docs/zone-models/hoek-brown.md has the equations, (n) below are their numbers.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"

#include <cstdio>
#include <utility>

namespace {

using namespace kaya::zones;

enum Property : std::size_t {
    constant_sci = moduli_count,
    constant_mb,
    constant_s,
    constant_a,
    dilation,
    strength_factor
};
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"constant-sci", "sigci hbs_ci", "stress", "uniaxial strength of intact rock", NAN, 0, INFINITY, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-mb", "mb hb_m", "-", "m_b of the rock mass", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-s", "hb_s", "-", "s of the rock mass", NAN, 0, 1, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-a", "hb_a", "-", "exponent of the rock mass", 0.5, 0.1, 1, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"dilation", "bdilation", "angle", "angle of dilation", 0, 0, 89.9, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"strength-factor", "", "-", "the shear strength is divided by it; solve fos sets it", 1, 1e-6, 1e6,
                   0, KAYA_ZREDUCE_MULTIPLY},
};

enum History : std::size_t { plastic_shear, plastic_tension };
constexpr std::array<kaya_jhistory, 2> history{{
    {"plastic-shear", "-", "plastic shear strain so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off so far"},
}};

/// The curve in compression-positive stresses: s1 = s3 + sci (mb s3/sci + s)^a (1).
struct Curve {
    double sci, mb, s, a;

    double tip() const { return -s * sci / mb; }
    bool holds(double greatest_tension, double least_tension) const {
        return -greatest_tension >= tip() && -least_tension <= greatest(std::max(-greatest_tension, tip()));
    }
    double greatest(double s3) const { return s3 + sci * std::pow(std::max(0.0, mb * s3 / sci + s), a); }
    double slope(double s3) const { return 1 + a * mb * std::pow(std::max(1e-12, mb * s3 / sci + s), a - 1); }
    /// Greatest stress and slope at a least stress.
    std::pair<double, double> line_at(double s3) const { return {greatest(s3), slope(s3)}; }
};

/// The curve whose envelope of shear stresses is a fraction of the height of the given one's: each point of the envelope keeps its normal
/// stress, and the circle of Mohr tangent to the lower envelope there has other principal stresses (3).
class Lowered {
public:
    Lowered(const Curve& curve, double factor) : curve_(curve), factor_(factor) {
        for (std::size_t k = 0; k < known_.size(); ++k) known_[k] = circle(place(k));
    }

    double tip() const { return curve_.tip(); }
    double greatest(double s3) const { return at(s3).greatest; }
    /// Greatest stress and slope at a least stress.
    std::pair<double, double> line_at(double s3) const {
        const Circle circle = at(s3);
        return {circle.greatest, circle.slope};
    }
    bool holds(double greatest_tension, double least_tension) const {
        const double s3 = -greatest_tension, s1 = -least_tension;
        if (s3 < tip()) return false;
        // The curve is convex: a stress below a chord is below the curve, which covers most zones.
        const auto next = std::upper_bound(known_.begin(), known_.end(), s3,
                                           [](double s, const Circle& known) { return s < known.least; });
        if (next != known_.begin() && next != known_.end()) {
            const Circle &a = *(next - 1), &b = *next;
            if (s1 <= a.greatest + (s3 - a.least) / (b.least - a.least) * (b.greatest - a.greatest)) return true;
        }
        return s1 <= greatest(s3);
    }

private:
    struct Circle {
        double least, greatest, slope;
    };
    /// The circle that belongs to a least stress on the first curve.
    Circle circle(double first) const {
        const double k = curve_.slope(first), root = std::sqrt(k), range = curve_.greatest(first) - first;
        const double normal = first + range / (k + 1), shear = (normal - first) * root / factor_;
        const double tangent = (k - 1) / (2 * root) / factor_, secant = std::sqrt(1 + tangent * tangent),
                     sine = tangent / secant;
        const double centre = normal + shear * tangent, radius = shear * secant;
        return {centre - radius, centre + radius, (1 + sine) / (1 - sine)};
    }
    double place(std::size_t k) const {
        return curve_.tip() + first_place * curve_.sci * std::pow(known_ratio, static_cast<double>(k));
    }
    /// The circle with this least stress; the least stress grows along the curve.
    Circle at(double s3) const {
        const auto next = std::upper_bound(known_.begin(), known_.end(), s3,
                                           [](double s, const Circle& known) { return s < known.least; });
        const auto k = static_cast<std::size_t>(next - known_.begin());
        double low = curve_.tip(), high = place(std::min(k, known_.size() - 1));
        double below = circle(low).least - s3;
        if (k > 0) low = place(k - 1), below = known_[k - 1].least - s3;
        Circle found = circle(high);
        while (found.least < s3) {
            low = high, below = found.least - s3;
            high += 2 * (high - curve_.tip());
            found = circle(high);
        }
        double above = found.least - s3;
        // Regula falsi with the Illinois rule.
        for (int round = 0;
             round < 100 && high - low > 1e-13 * curve_.sci && std::abs(found.least - s3) > 1e-13 * curve_.sci;
             ++round) {
            const double middle = above > below ? (low * above - high * below) / (above - below) : 0.5 * (low + high);
            const bool was_above = found.least > s3;
            found = circle(middle);
            const double miss = found.least - s3;
            if (miss > 0) {
                high = middle, above = miss;
                if (was_above) below *= 0.5;
            } else {
                low = middle, below = miss;
                if (!was_above) above *= 0.5;
            }
        }
        return found;
    }

    static constexpr double first_place = 1e-6, known_ratio = 1.35;
    Curve curve_;
    double factor_;
    std::array<Circle, 48> known_; ///< circles along the curve, the farther apart the farther from its tip
};

/// The tangent plane at s3 as a surface of Mohr and Coulomb.
template <class Criterion> Strength tangent(const Criterion& curve, double s3, double flow) {
    const auto [greatest, k] = curve.line_at(s3);
    return {k, greatest - k * s3, flow, -curve.tip()};
}

template <class Criterion> void run_with(kaya_zbatch* batch, const Criterion& curve) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const double size = p[constant_sci];
    const double flow_slope = Strength::slope_of(p[dilation]);
    add_elastic(*batch, moduli);
    forget_flow(*batch);
    // In compression positive: s1 = -low, s3 = -high. The curve rises with s3.
    const auto holds = [&](std::size_t i, double high, double low) {
        batch->row = i;
        return curve.holds(high, low);
    };
    for_rows_that_may_yield(*batch, holds, [&](std::size_t i, Principal& principal) {
        batch->row = i;
        const Vector3 trial = principal.value;
        if (curve.holds(trial[0], trial[2])) return;
        // The curve is convex in s3: tangents at the answers so far close in on it from outside (2).
        Flow flow;
        double at = std::max(-trial[0], curve.tip());
        constexpr int most = 50;
        for (int k = 0; k < most; ++k) {
            principal.value = trial;
            flow = return_to(tangent(curve, at, flow_slope), moduli, principal.value);
            const double found = std::max(-principal.value[0], curve.tip());
            const double shift = std::abs(found - at);
            at = found;
            if (shift <= 1e-10 * size) break;
        }
        put_stress(*batch, i, principal.tensor());
        batch->dissipation[i] = dot(principal.value, flow.strain);
        batch->history[plastic_shear][i] += shear_measure(flow.strain);
        batch->history[plastic_tension][i] += flow.along_tension;
        batch->state[i] |= bits_of(flow);
    });
}

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Curve curve{p[constant_sci], p[constant_mb], p[constant_s], p[constant_a]};
    if (p[strength_factor] == 1) run_with(batch, curve);
    else run_with(batch, Lowered(curve, p[strength_factor]));
    return -1;
}

const char* check(const double* p) {
    if (!(p[constant_sci] > 0)) return "constant-sci must be above 0";
    if (!(p[constant_mb] > 0)) return "constant-mb must be above 0";
    return nullptr;
}

constexpr kaya_zmodel descriptor =
    model("hoek-brown", "generalised Hoek-Brown plasticity", properties, history, states_of_flow, true, run, check);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
