// Zone model `hoek-brown`: the generalised criterion, with a constant angle of dilation.
// docs/zone-models/hoek-brown.md has the equations, (n) below are their numbers.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"

#include <optional>
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

/// The curve (1) in compression-positive stresses, by x = s3 - tip: near the tip s3 itself has lost the digits that count.
struct Curve {
    double sci, mb, s, a;

    double tip() const { return -s * sci / mb; }
    /// s1 - s3, and the slope of s1 by s3.
    double range(double x) const { return sci * std::pow(mb * x / sci, a); }
    double slope(double x) const { return 1 + a * range(x) / x; }
    /// s1 - tip.
    double height(double x) const { return x > 0 ? x + range(x) : 0; }
    /// Height and slope; x above 0.
    std::pair<double, double> line_at(double x) const { return {height(x), slope(x)}; }
    /// Whether a height above 0 lies below the curve.
    bool bears(double x, double asked) const { return asked <= height(x); }
};

/// The curve whose envelope of shear stresses is a fraction of the height of the given one's: each point of the envelope keeps its normal
/// stress, and the circle of Mohr tangent to the lower envelope there has other principal stresses (3).
class Lowered {
    struct Circle {
        double least, greatest, slope; ///< the stresses from the tip on
    };
    /// The first known circle with a greater least stress.
    auto after(double least) const {
        return std::upper_bound(known_.begin(), known_.end(), least,
                                [](double x, const Circle& known) { return x < known.least; });
    }

public:
    Lowered(const Curve& curve, double factor) : curve_(curve), factor_(factor) {
        for (std::size_t k = 0; k < known_.size(); ++k) known_[k] = circle(place(k));
    }

    double tip() const { return curve_.tip(); }
    std::pair<double, double> line_at(double x) const {
        const Circle circle = at(x);
        return {circle.greatest, circle.slope};
    }
    bool bears(double x, double asked) const {
        if (!(x > 0)) return asked <= 0;
        // The curve is convex: what lies below a chord lies below the curve, and most zones do.
        const auto next = after(x);
        if (next != known_.begin() && next != known_.end()) {
            const Circle &a = *(next - 1), &b = *next;
            if (asked <= a.greatest + (x - a.least) / (b.least - a.least) * (b.greatest - a.greatest)) return true;
        }
        return asked <= at(x).greatest;
    }

private:
    /// The circle that belongs to a place above 0 on the first curve.
    Circle circle(double x) const {
        const double k = curve_.slope(x), root = std::sqrt(k), range = curve_.range(x);
        const double normal = x + range / (k + 1), shear = range * root / (k + 1) / factor_;
        const double tangent = (k - 1) / (2 * root) / factor_, secant = std::sqrt(1 + tangent * tangent);
        const double slope = (secant + tangent) * (secant + tangent);
        return {normal - shear / (tangent + secant), normal + shear * (tangent + secant), slope};
    }
    double place(std::size_t k) const {
        return first_place * curve_.sci * std::pow(known_ratio, static_cast<double>(k));
    }
    /// The circle with this least stress; the least stress grows along the curve.
    Circle at(double least) const {
        const auto k = static_cast<std::size_t>(after(least) - known_.begin());
        double low = 0, high = place(std::min(k, known_.size() - 1)), below = -least;
        if (k > 0) low = place(k - 1), below = known_[k - 1].least - least;
        Circle found = circle(high);
        while (found.least < least) {
            low = high, below = found.least - least;
            high *= 2;
            found = circle(high);
        }
        double above = found.least - least;
        // Regula falsi with the Illinois rule.
        constexpr double rounding = 1e-14;
        for (int round = 0;
             round < 100 && high - low > rounding * high && std::abs(found.least - least) > rounding * least; ++round) {
            const double middle = above > below ? (low * above - high * below) / (above - below) : 0.5 * (low + high);
            const bool was_above = found.least > least;
            found = circle(middle);
            const double miss = found.least - least;
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

/// Where flow leads principal stresses, the greatest tension first: they fall by `rate` for each unit of flow.
struct Path {
    Vector3 from, rate;

    Vector3 at(double amount) const {
        return {from[0] - amount * rate[0], from[1] - amount * rate[1], from[2] - amount * rate[2]};
    }
};

/// The flow after which a path meets the curve; none where it passes its tip (4).
template <class Criterion> std::optional<double> flow_to(const Criterion& curve, const Path& path) {
    const double tip = curve.tip(), slope_of_path = path.rate[2] / path.rate[0];
    const double start = -path.from[0] - tip; // below 0 beyond the tip
    const auto asked = [&](double x) { return -path.from[2] - tip + (x - start) * slope_of_path; };
    // The excess over the curve is convex and falls along the path: Newton's steps from its beginning never pass the answer.
    double low = std::max(start, 0.0);
    if (curve.bears(low, asked(low))) return std::nullopt;
    double high = low + (asked(low) - low) / (1 - slope_of_path); // heights are at least x
    const double rounding = 1e-14 * (std::abs(path.from[0]) + std::abs(path.from[2]));
    double x = low > 0 ? low : high;
    for (int round = 0; round < 100; ++round) {
        const auto [height, slope] = curve.line_at(x);
        const double excess = asked(x) - height;
        if (std::abs(excess) <= rounding) break;
        (excess > 0 ? low : high) = x;
        const double next = x + excess / (slope - slope_of_path);
        constexpr double nearer = 1e-3;
        x = next > low && next < high ? next : low > 0 ? std::sqrt(low * high) : nearer * high;
    }
    return (x - start) / path.rate[0];
}

/// Brings principal stresses (the greatest first) back to the curve: along a face, where two stresses have become equal along an edge, else
/// to the tip (Koiter 1953). `m` is the slope of the flow.
template <class Criterion> Flow return_by(const Criterion& curve, double m, const Moduli& moduli, Vector3& s) {
    const double l = moduli.lame() * (m - 1), g = moduli.shear;
    const auto shears = [&](const Vector3& stress, const Vector3& strain) {
        s = stress;
        Flow flow;
        flow.strain = strain;
        flow.shear = true;
        return flow;
    };
    const Path face{s, {l + 2 * g * m, l, l - 2 * g}};
    const auto on_face = flow_to(curve, face);
    if (on_face) {
        const Vector3 stress = face.at(*on_face);
        if (stress[0] >= stress[1] && stress[1] >= stress[2]) return shears(stress, {m * *on_face, 0, -*on_face});
    }
    const double greater = 0.5 * (s[0] + s[1]), apart = (s[0] - s[1]) / (2 * g * m);
    const Path upper{{greater, greater, s[2]}, {l + g * m, l + g * m, l - 2 * g}};
    if (const auto sum = flow_to(curve, upper); sum && *sum >= apart)
        return shears(upper.at(*sum), {0.5 * m * (*sum + apart), 0.5 * m * (*sum - apart), -*sum});
    const double less = 0.5 * (s[1] + s[2]), between = (s[1] - s[2]) / (2 * g);
    const Path lower{{s[0], less, less}, {l + 2 * g * m, l - g, l - g}};
    if (const auto sum = flow_to(curve, lower); sum && *sum >= between)
        return shears(lower.at(*sum), {m * *sum, -0.5 * (*sum - between), -0.5 * (*sum + between)});
    return to_tip(-curve.tip(), moduli, s);
}

/// The same, with a flow that is nowhere steeper than the curve: it would give out work.
template <class Criterion> Flow return_to(const Criterion& curve, double m, const Moduli& moduli, Vector3& s) {
    const auto bearable = [&](const Vector3& at) {
        const double x = -at[0] - curve.tip();
        return x > 0 ? std::min(m, curve.line_at(x).second) : m;
    };
    constexpr int most = 50;
    constexpr double near = 1e-9;
    const Vector3 tried = s;
    double used = m;
    Flow flow = return_by(curve, used, moduli, s);
    for (int round = 0; round < most && std::abs(bearable(s) - used) > near; ++round) {
        used = bearable(s);
        s = tried;
        flow = return_by(curve, used, moduli, s);
    }
    return flow;
}

template <class Criterion> void run_with(kaya_zbatch* batch, const Criterion& curve) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const double flow_slope = Strength::slope_of(p[dilation]);
    add_elastic(*batch, moduli);
    forget_flow(*batch);
    // In compression positive: s1 = -low, s3 = -high.
    const auto holds = [&](std::size_t i, double high, double low) {
        batch->row = i;
        const double x = -high - curve.tip();
        return x >= 0 && curve.bears(x, -low - curve.tip());
    };
    for_rows_that_may_yield(*batch, holds, [&](std::size_t i, Principal& principal) {
        batch->row = i;
        if (holds(i, principal.value[0], principal.value[2])) return;
        const Flow flow = return_to(curve, flow_slope, moduli, principal.value);
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
