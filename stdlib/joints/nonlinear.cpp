// Joint model `nonlinear`: Coulomb slip with stiffnesses that are powers of the normal stress.
// docs/joint-models/nonlinear.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/rows.hpp"
#include "stdlib/joints/power_spring.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::Climb;
using coulomb::Columns;
using coulomb::length;
using coulomb::Shear;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    kn_minimum,
    kn_maximum,
    exponent_normal,
    ks_minimum,
    ks_maximum,
    exponent_shear,
    friction,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    friction_residual,
    cohesion_residual,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn kn-initial", "stress/length", "normal stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"stiffness-shear", "jks ks ks-initial", "stress/length", "shear stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"kn-minimum", "", "stress/length", "least normal stiffness; not given: none, but exponent-normal 1 needs one", NAN,
     0, INFINITY, 1},
    {"kn-maximum", "", "stress/length", "greatest normal stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"exponent-normal", "jen", "-", "power of the normal stress in the normal stiffness", 0, 0, 1, 0},
    {"ks-minimum", "", "stress/length",
     "least shear stiffness; not given: that at a normal stress as large as the cohesion", NAN, 0, INFINITY, 1},
    {"ks-maximum", "", "stress/length", "greatest shear stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"exponent-shear", "jes", "-", "power of the normal stress in the shear stiffness", 0, 0, 1, 0},
    coulomb::properties[coulomb::friction],
    coulomb::properties[coulomb::cohesion],
    coulomb::properties[coulomb::tension],
    coulomb::properties[coulomb::dilation],
    coulomb::properties[coulomb::dilation_zero],
    coulomb::properties[coulomb::friction_residual],
    coulomb::properties[coulomb::cohesion_residual],
};
static_assert(std::size(properties) == property_count);

enum History : std::size_t { closure, slip, dilation_at };

constexpr auto history =
    coulomb::operator+(std::to_array<kaya_jhistory>({
                           {"closure", "length", "closure of the joint; negative: how far it is open"},
                           coulomb::history[coulomb::slip],
                       }),
                       coulomb::history_of_dilation);

PowerSprings springs_of(const double* p) {
    PowerStiffness shear(p[stiffness_shear], p[exponent_shear], p[ks_minimum], p[ks_maximum]);
    // A bond that no normal stress acts on must resist shear with some stiffness, too.
    const bool bonded = p[cohesion] > 0 && p[cohesion] < KAYA_JMODEL_STRONG;
    if (std::isnan(p[ks_minimum]) && shear.exponent > 0 && bonded)
        shear.least = std::min(shear.at(p[cohesion]), shear.greatest);
    return {PowerSpring({p[stiffness_normal], p[exponent_normal], p[kn_minimum], p[kn_maximum]}), shear};
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    double* closures = batch->history[closure];
    springs_of(batch->properties).begin(*batch, closures);
    // Open sides have no bond that could pull them together.
    for (std::size_t i = 0; i < batch->n; ++i)
        if (batch->normal_force[i] == 0 && beyond_rounding(-closures[i], batch->area[i]))
            batch->state[i] |= coulomb::tension_past;
    return -1;
}

constexpr std::size_t together = 32; ///< rows of one pass
using Numbers = std::array<double, together>;

/// Results of the first pass over some rows for the next pass.
struct Trials {
    Numbers closed, normal, ks, x, y, z, size; ///< elastic: closure, and stresses
    Numbers cohesion, tangent;                 ///< values of the row
    Numbers along, across2, height, fall;      ///< of its Climb
    Numbers alone;                             ///< slip without dilation, where that is all of the step; else below 0
    Numbers kept, broken, slipped; ///< 0 for a row that carries no shear, else 1; 1 for one that breaks; slip

    [[gnu::always_inline]] Climb climb(std::size_t j, double rise, double end) const {
        return {along[j], across2[j], height[j], rise, fall[j], end};
    }
};

[[gnu::always_inline]] inline double strength(const Trials& t, std::size_t j, double normal) {
    return std::max(0.0, t.cohesion[j] + normal * t.tangent[j]);
}

/// Slip that brings the trial down to the strength, which dilation changes (3), by Newton's method in all rows at once.
void slip_to_strength(const PowerSpring& spring, double dilatancy, double end, Trials& t) {
    for (int k = 0; k < 40; ++k) {
        std::uint64_t moving = 0;
        for (std::size_t j = 0; j < together; ++j) {
            const double slipped = t.slipped[j];
            const Climb climb = t.climb(j, dilatancy, end);
            const double stress = spring.stress(t.closed[j] + climb.change(slipped));
            const double over = t.kept[j] * (t.size[j] - t.ks[j] * slipped - strength(t, j, stress));
            const double rise = t.tangent[j] * climb.slope(slipped) * spring.tangent(stress);
            const double more = over / std::max(t.ks[j] + rise, 0.1 * t.ks[j]);
            const double next = t.alone[j] < 0 ? std::max(0.0, slipped + more) : t.alone[j];
            moving |= static_cast<std::uint64_t>(std::abs(next - slipped) > 1e-15 * next);
            t.slipped[j] = next;
        }
        if (moving == 0) break;
    }
}

/// Values that all rows of a batch share.
struct Joint {
    explicit Joint(const double* p)
        : springs(springs_of(p)), friction_before(tan_degrees(p[friction])),
          friction_after(std::isnan(p[friction_residual]) ? friction_before : tan_degrees(p[friction_residual])),
          cohesion_before(p[cohesion]), cohesion_after(p[cohesion_residual]), tension_before(p[tension]),
          dilatancy(tan_degrees(p[dilation])), last_dilation(p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY) {}

    PowerSprings springs;
    double friction_before, friction_after, cohesion_before, cohesion_after, tension_before, dilatancy, last_dilation;
    bool bonded = tension_before > 0;
    bool springs_at_rest =
        springs.shear.exponent == 0 || springs.shear.least > 0; // shear is resisted without normal stress
};

/// The elastic trial of row `i`, and its slip where the strength is constant over the step.
template <bool dilates> [[gnu::always_inline]] inline void try_row(const Joint& joint, const Columns& c, std::size_t i,
                                                                   std::size_t j, Trials& t) {
    const double area = c.area[i], per_area = area > 0 ? 1 / area : 0;
    const bool failed = c.states[i] != 0;
    const double closed = c.gaps[i] - c.opening[i], elastic = joint.springs.normal.stress(closed); // (1)
    const bool breaks = elastic < (failed ? 0 : -joint.tension_before);
    const double normal = breaks ? 0 : elastic, unbroken = breaks ? 0.0 : 1.0;
    t.closed[j] = closed;
    t.normal[j] = normal;
    t.kept[j] = (failed && closed < 0) || (normal == 0 && !joint.springs_at_rest) ? 0 : unbroken;
    t.broken[j] = 1 - unbroken;
    // A falling normal stress takes shear force with its stiffness; a rising one adds none (2).
    const double k = joint.springs.shear.at(normal),
                 kept = std::min(1.0, k / joint.springs.shear.at(c.normal_force[i] * per_area)) * per_area;
    t.ks[j] = k;
    t.x[j] = c.force_x[i] * kept - k * c.shear_x[i];
    t.y[j] = c.force_y[i] * kept - k * c.shear_y[i];
    t.z[j] = c.force_z[i] * kept - k * c.shear_z[i];
    t.size[j] = length({t.x[j], t.y[j], t.z[j]});
    t.cohesion[j] = failed ? joint.cohesion_after : joint.cohesion_before;
    t.tangent[j] = failed ? joint.friction_after : joint.friction_before;
    if constexpr (dilates) {
        const double per_size = -1 / std::max(t.size[j], std::numeric_limits<double>::min());
        const auto climb = Climb::of(c, i, {t.x[j] * per_size, t.y[j] * per_size, t.z[j] * per_size}, joint.dilatancy,
                                     joint.last_dilation);
        t.along[j] = climb.along;
        t.across2[j] = climb.across2;
        t.height[j] = climb.height;
        t.fall[j] = climb.fall;
        // Reverse slip may reduce the strength faster than the spring force: see coulomb::step.
        const bool meet = climb.slope(0) * t.tangent[j] * joint.springs.normal.tangent(normal) > -0.9 * k;
        t.alone[j] = meet ? -1 : t.kept[j] * std::max(0.0, t.size[j] - strength(t, j, normal)) / k;
    }
    // Without dilation the slip is explicit.
    t.slipped[j] = dilates ? 0 : t.kept[j] * std::max(0.0, t.size[j] - strength(t, j, normal)) / k;
}

/// Forces, work and state of row `i` at the end of the step.
template <bool dilates> [[gnu::always_inline]] inline void end_row(const Joint& joint, const Columns& c, double* kn,
                                                                   double* ks, std::size_t i, std::size_t j,
                                                                   const Trials& t) {
    const double area = c.area[i], per_area = area > 0 ? 1 / area : 0;
    const double old_normal = c.normal_force[i] * per_area, old_ks = joint.springs.shear.at(old_normal);
    const bool slides = t.slipped[j] > 0;
    const double climbed = dilates ? t.climb(j, joint.dilatancy, joint.last_dilation).change(t.slipped[j]) : 0;
    // Sides that close by reverse slip without normal stress separate.
    const double closed = t.closed[j] + climbed, on_curve = joint.springs.normal.stress(closed);
    const double dilated = climbed < 0 ? std::max(on_curve, std::min(0.0, t.normal[j])) : on_curve;
    const double normal = slides ? dilated : t.normal[j];
    const double normal_of_limit = dilates && t.alone[j] >= 0 ? t.normal[j] : normal;
    const double most = slides ? std::min(t.size[j], strength(t, j, normal_of_limit)) : t.size[j],
                 limit = t.kept[j] * most;
    const double scale = limit / std::max(t.size[j], std::numeric_limits<double>::min());
    const Shear old = {c.force_x[i] * per_area, c.force_y[i] * per_area, c.force_z[i] * per_area};
    const Shear now = {t.x[j] * scale, t.y[j] * scale, t.z[j] * scale};
    const double sheared =
        -0.5 * ((old.x + now.x) * c.shear_x[i] + (old.y + now.y) * c.shear_y[i] + (old.z + now.z) * c.shear_z[i]);

    // Work that is neither stored in the springs nor spent on dilation (4), and the energy of a bond that breaks.
    const double new_ks = joint.springs.shear.at(normal), old_size = length(old);
    // A force that was set without a spring stores no energy.
    const double stored_before = old_normal != 0 || joint.springs_at_rest ? 0.5 * old_size * old_size / old_ks : 0;
    const double stored = 0.5 * limit * limit / new_ks - stored_before;
    const double lifted = 0.5 * (old_normal + normal) * climbed;
    const double pull = std::min(0.0, old_normal),
                 lost = joint.bonded ? t.broken[j] * joint.springs.normal.energy(pull) : 0;
    c.work[i] += area * (sheared - stored - lifted + lost);

    if constexpr (dilates) {
        const double part = t.slipped[j] / std::max(t.size[j], std::numeric_limits<double>::min());
        c.dilated[i] += climbed;
        c.travel_x[i] -= part * t.x[j];
        c.travel_y[i] -= part * t.y[j];
        c.travel_z[i] -= part * t.z[j];
    }
    const bool parts = t.broken[j] > 0 && beyond_rounding(-closed, area);
    c.gaps[i] = closed;
    c.slips[i] += t.slipped[j];
    c.normal_force[i] = normal * area;
    c.force_x[i] = now.x * area;
    c.force_y[i] = now.y * area;
    c.force_z[i] = now.z * area;
    kn[i] = joint.springs.normal.reported(normal, area);
    ks[i] = new_ks;
    c.states[i] = (c.states[i] & ~coulomb::now) | ((c.states[i] & coulomb::now) << coulomb::from_now_to_past) |
                  (slides ? coulomb::slip_now : 0) | (parts ? coulomb::tension_now : 0);
}

template <bool dilates> void run_rows(kaya_jbatch* batch) {
    const Joint joint(batch->properties);
    const Columns c(*batch, dilation_at); // its gap is the closure here
    double *kn = batch->normal_stiffness, *ks = batch->shear_stiffness;
    Trials t{};
    t.ks.fill(1); // rows that are not there
    for (std::size_t begin = 0; begin < batch->n; begin += together) {
        const std::size_t count = std::min(together, batch->n - begin);
        KAYA_INDEPENDENT_ROWS
        for (std::size_t j = 0; j < count; ++j) try_row<dilates>(joint, c, begin + j, j, t);
        if constexpr (dilates) slip_to_strength(joint.springs.normal, joint.dilatancy, joint.last_dilation, t);
        KAYA_INDEPENDENT_ROWS
        for (std::size_t j = 0; j < count; ++j) end_row<dilates>(joint, c, kn, ks, begin + j, j, t);
    }
    batch->stiffness_changed = 1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->properties[dilation] > 0) run_rows<true>(batch);
    else run_rows<false>(batch);
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (const char* fault = springs_of(p).fault()) return fault;
    return coulomb::fault_of_residuals(p[tension], 0, p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) { springs_of(p).largest_at_start(normal, shear); }

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "nonlinear",
    "Coulomb slip with stiffnesses that follow the normal stress",
    "1.0",
    properties,
    property_count,
    history.data(),
    history.size(),
    coulomb::state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
