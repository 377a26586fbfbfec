// Joint model `bilinear-mohr`: Coulomb slip with one line of strength at low and another at high normal stress.
// docs/joint-models/bilinear-mohr.md has the equations.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/rows.hpp"

namespace {

using namespace kaya::joints::coulomb;

enum OwnProperty : std::size_t {
    friction_2 = property_count,
    cohesion_2,
    dilation_2,
    friction_2_residual,
    cohesion_2_residual,
    crossing,
    crossing_residual,
};

constexpr auto all_properties =
    properties +
    std::to_array<kaya_jproperty>({
        {"friction-2", "f2", "angle", "angle of friction of the second line before failure", NAN, 0, 90, 0},
        {"cohesion-2", "c2", "stress", "cohesion of the second line before failure", NAN, 0, INFINITY, 0},
        {"dilation-2", "d2", "angle", "angle of dilation on the second line", 0, 0, 89, 0},
        {"friction-2-residual", "f2-residual", "angle",
         "angle of friction of the second line after failure; not given: that before", NAN, 0, 90, 1},
        {"cohesion-2-residual", "c2-residual", "stress", "cohesion of the second line after failure", 0, 0, INFINITY,
         0},
        {"nstress", "", "stress", "normal stress at which the second line begins; not given: where the lines cross",
         NAN, 0, INFINITY, 1},
        {"nstress-residual", "", "stress", "the same after failure", NAN, 0, INFINITY, 1},
    });

/// Strength over normal stress: the first line below `crossing`, the second from there on.
struct Lines {
    double cohesion[2], tangent[2];
    double crossing;
};

/// The same for one row, in forces.
struct RowLines {
    double bond[2], tangent[2], crossing;

    [[gnu::always_inline]] RowLines(const Lines& before, const Lines& after, bool failed, double area)
        : bond{(failed ? after.cohesion[0] : before.cohesion[0]) * area,
               (failed ? after.cohesion[1] : before.cohesion[1]) * area},
          tangent{failed ? after.tangent[0] : before.tangent[0], failed ? after.tangent[1] : before.tangent[1]},
          crossing((failed ? after.crossing : before.crossing) * area) {}

    [[gnu::always_inline]] bool high(double normal) const { return normal >= crossing; }
    [[gnu::always_inline]] double at(double normal) const {
        const double first = bond[0] + normal * tangent[0], second = bond[1] + normal * tangent[1];
        return std::max(0.0, high(normal) ? second : first);
    }
    [[gnu::always_inline]] double slope(double normal) const { return high(normal) ? tangent[1] : tangent[0]; }
};

/// Where two lines cross; lines that do not cross at a pressure leave the lower one at every pressure.
double crossing_of(const Lines& l) {
    const double steeper = l.tangent[0] - l.tangent[1], higher = l.cohesion[1] - l.cohesion[0];
    if (steeper > 0 && higher >= 0) return higher / steeper;
    return higher < 0 || steeper > 0 ? 0 : INFINITY;
}

Lines lines(double c1, double phi1, double c2, double phi2, double given_crossing) {
    Lines made{{c1, c2}, {tan_degrees(phi1), tan_degrees(phi2)}, given_crossing};
    if (std::isnan(given_crossing)) made.crossing = crossing_of(made);
    return made;
}

double or_else(double value, double otherwise) { return std::isnan(value) ? otherwise : value; }

Lines peak_lines(const double* p) { return lines(p[cohesion], p[friction], p[cohesion_2], p[friction_2], p[crossing]); }

Lines residual_lines(const double* p) {
    return lines(p[cohesion_residual], or_else(p[friction_residual], p[friction]), p[cohesion_2_residual],
                 or_else(p[friction_2_residual], p[friction_2]), p[crossing_residual]);
}

template <bool dilates> void run_rows(kaya_jbatch* batch, const Values& values) {
    const double* p = batch->properties;
    const double second_dilatancy = tan_degrees(p[dilation_2]);
    const Lines before = peak_lines(p), after = residual_lines(p);

    const Columns columns(*batch, history_count);
    const std::size_t n = batch->n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        const bool failed = columns.states[i] != 0;
        const RowLines strength(before, after, failed, columns.area[i]);
        // The line on which the step begins gives the dilation of the step.
        Limits limits = values.limits(failed);
        limits.dilatancy = strength.high(columns.normal_force[i]) ? second_dilatancy : values.dilatancy;
        step<dilates>(columns, i, values.kn, values.ks, limits, strength);
    }
}

ptrdiff_t run(kaya_jbatch* batch) {
    const Values values(batch->properties);
    if (values.dilatancy > 0 || batch->properties[dilation_2] > 0) run_rows<true>(batch, values);
    else run_rows<false>(batch, values);
    return -1;
}

constexpr auto all_history = history + history_of_dilation;

const char* check_lines(const double* p) {
    if (const char* fault = check(p)) return fault;
    if (p[cohesion_2_residual] > p[cohesion_2])
        return "cohesion-2-residual is above cohesion-2: failure cannot make the joint stronger, give a cohesion-2 of "
               "at least that";
    const Lines peak = peak_lines(p);
    if (std::isnan(p[crossing]) && !std::isfinite(peak.crossing))
        return "the lines of strength do not cross: give cohesion-2 above cohesion and friction-2 below friction, or "
               "say with nstress where the second line begins";
    return nullptr;
}

constexpr kaya_jmodel descriptor =
    model("bilinear-mohr", "Coulomb slip with two lines of strength", all_properties, all_history, run, check_lines);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
