// Joint model `bilinear-mohr`: Coulomb slip with one line of strength at low and another at high normal stress.
// docs/joint-models/bilinear-mohr.md has the equations.
#include "stdlib/joints/coulomb.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    friction,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    friction_residual,
    cohesion_residual,
    tension_residual,
    friction_2,
    cohesion_2,
    dilation_2,
    friction_2_residual,
    cohesion_2_residual,
    crossing,
    crossing_residual,
    property_count
};

constexpr kaya_jproperty properties[] = {
    coulomb::stiffness_normal_row,
    coulomb::stiffness_shear_row,
    coulomb::friction_row,
    coulomb::cohesion_row,
    coulomb::tension_row,
    coulomb::dilation_row,
    coulomb::dilation_zero_row,
    coulomb::friction_residual_row,
    coulomb::cohesion_residual_row,
    coulomb::tension_residual_row,
    {"friction-2", "f2", "angle", "angle of friction of the second line before failure", NAN, 0, 90, 0},
    {"cohesion-2", "c2", "stress", "cohesion of the second line before failure", NAN, 0, INFINITY, 0},
    {"dilation-2", "d2", "angle", "angle of dilation on the second line", 0, 0, 89, 0},
    {"friction-2-residual", "f2-residual", "angle",
     "angle of friction of the second line after failure; not given: that before", NAN, 0, 90, 1},
    {"cohesion-2-residual", "c2-residual", "stress", "cohesion of the second line after failure", 0, 0, INFINITY, 0},
    {"nstress", "", "stress", "normal stress at which the second line begins; not given: where the lines cross", NAN,
     0, INFINITY, 1},
    {"nstress-residual", "", "stress", "the same after failure", NAN, 0, INFINITY, 1},
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, history_count };

constexpr kaya_jhistory history[] = {coulomb::gap_row, coulomb::slip_row};
static_assert(std::size(history) == history_count);

/// Strength over normal stress: the first line below `crossing`, the second from there on.
struct Lines {
    double cohesion[2], tangent[2];
    double crossing;
};

/// The same for one row, in forces.
struct RowLines {
    const Lines& lines;
    double area;

    [[gnu::always_inline]] bool high(double normal) const { return normal >= lines.crossing * area; }
    [[gnu::always_inline]] double at(double normal) const {
        const double first = lines.cohesion[0] * area + normal * lines.tangent[0];
        const double second = lines.cohesion[1] * area + normal * lines.tangent[1];
        return std::max(0.0, high(normal) ? second : first);
    }
    [[gnu::always_inline]] double slope(double normal) const {
        return high(normal) ? lines.tangent[1] : lines.tangent[0];
    }
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

Lines peak_lines(const double* p) {
    return lines(p[cohesion], p[friction], p[cohesion_2], p[friction_2], p[crossing]);
}

Lines residual_lines(const double* p) {
    return lines(p[cohesion_residual], or_else(p[friction_residual], p[friction]), p[cohesion_2_residual],
                 or_else(p[friction_2_residual], p[friction_2]), p[crossing_residual]);
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    coulomb::initialise(*batch, gap, batch->properties[stiffness_normal], batch->properties[stiffness_shear]);
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double peak_tension = p[tension], residual_tension = p[tension_residual];
    const double dilatancy[2] = {tan_degrees(p[dilation]), tan_degrees(p[dilation_2])};
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;
    const Lines before = peak_lines(p), after = residual_lines(p);

    const coulomb::Columns columns(*batch, gap, slip);
    const std::size_t n = batch->n;
    for (std::size_t i = 0; i < n; ++i) {
        const bool failed = columns.states[i] != 0;
        const RowLines strength{failed ? after : before, columns.area[i]};
        // The line on which the step begins gives the dilation of the step.
        const double dilates = dilatancy[strength.high(columns.normal_force[i]) ? 1 : 0];
        coulomb::step(columns, i, kn, ks,
                      {failed ? residual_tension : peak_tension, residual_tension, dilates, last_dilation}, strength);
    }
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (p[cohesion_2_residual] > p[cohesion_2])
        return "cohesion-2-residual is above cohesion-2: failure cannot make the joint stronger, give a cohesion-2 of "
               "at least that";
    const Lines peak = peak_lines(p);
    if (std::isnan(p[crossing]) && !std::isfinite(peak.crossing))
        return "the lines of strength do not cross: give cohesion-2 above cohesion and friction-2 below friction, or "
               "say with nstress where the second line begins";
    return coulomb::fault_of_residuals(p[tension], p[tension_residual], p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "bilinear-mohr",
    "Coulomb slip with two lines of strength",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    coulomb::state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
