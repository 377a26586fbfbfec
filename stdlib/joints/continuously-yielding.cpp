// Joint model `continuously-yielding`: shear stress that nears a bounding strength, which wears off with plastic
// displacement. docs/joint-models/continuously-yielding.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "stdlib/joints/power_spring.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::length;
using coulomb::Shear;

enum Property {
    stiffness_normal,
    stiffness_shear,
    exponent_normal,
    exponent_shear,
    kn_minimum,
    kn_maximum,
    ks_minimum,
    ks_maximum,
    friction,
    friction_initial,
    roughness,
    dilates,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"kn-initial", "jkn kn stiffness-normal", "stress/length", "a_n: normal stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"ks-initial", "jks ks stiffness-shear", "stress/length", "a_s: shear stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"exponent-normal", "jen", "-", "e_n: power of the normal stress in the normal stiffness", 0, 0, 1, 0},
    {"exponent-shear", "jes", "-", "e_s: power of the normal stress in the shear stiffness", 0, 0, 1, 0},
    {"kn-minimum", "", "stress/length", "least normal stiffness; not given: none, but exponent-normal 1 needs one", NAN,
     0, INFINITY, 1},
    {"kn-maximum", "", "stress/length", "greatest normal stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"ks-minimum", "", "stress/length", "least shear stiffness; not given: none", NAN, 0, INFINITY, 1},
    {"ks-maximum", "", "stress/length", "greatest shear stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"friction", "jfriction fric", "angle", "intrinsic angle of friction, of the worn joint", NAN, 0, 80, 0},
    {"friction-initial", "jif", "angle", "angle of friction that the joint starts towards", NAN, 0, 80, 0},
    {"roughness", "jr", "length", "R: plastic displacement in which the difference of the two falls to 1/e", NAN, 0,
     INFINITY, 0},
    {"dilation", "", "-", "1: the joint dilates by the angle of its shear stress above the intrinsic friction", 0, 0, 1,
     0},
};
static_assert(std::size(properties) == property_count);

enum History { closure, friction_mobilised, plastic, reversal_ratio, heading, history_count };

constexpr kaya_jhistory history[] = {
    {"closure", "length", "closure of the joint; negative: how far it is open"},
    {"friction-current", "angle", "angle of the bounding strength, phi_m"},
    {"plastic-strain", "length", "plastic shear displacement, added up"},
    {"reversal-ratio", "-", "shear stress over bounding strength at the last reversal, r"},
    {"heading", "-", "cosine between the last motion and the shear resistance that it met"},
};
static_assert(std::size(history) == history_count);

constexpr const char* state_names = "open past-peak";
constexpr uint32_t is_open = 1, is_past_peak = 2;
constexpr double largest_ratio = 0.75; // of r: beyond it F would be noise

PowerSprings springs_of(const double* p) {
    return {PowerSpring({p[stiffness_normal], p[exponent_normal], p[kn_minimum], p[kn_maximum]}),
            {p[stiffness_shear], p[exponent_shear], p[ks_minimum], p[ks_maximum]}};
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    springs_of(batch->properties).begin(*batch, batch->history[closure]);
    double* angles = batch->history[friction_mobilised];
    for (std::size_t i = 0; i < batch->n; ++i)
        if (angles[i] == 0) angles[i] = batch->properties[friction_initial];
    return -1;
}

/// e to the power x; x below 0 or 0.
[[gnu::always_inline]] inline double left_of(double x) { return exponential(std::max(-700.0, x)); }

/// Motion of one step along its own direction, at one normal stress.
struct Advance {
    double stress;       ///< resistance along the motion at the end
    double plastic;      ///< displacement (6)
    double friction;     ///< phi_m at the end (5)
    double bound_before; ///< bounding strength at the mean of the angles
};

/// (2), (3) and (5) integrated over the step: for a fixed bound the stress nears it exponentially, and for a known
/// plastic displacement so does the angle; two passes with the mean angle make the step of second order. The bound is above 0.
[[gnu::always_inline]] inline Advance advance(double start, double motion, double ks, double ratio, double normal,
                                              double angle, double intrinsic, double per_roughness) {
    Advance a{start, 0, angle, normal};
#pragma GCC unroll 2
    for (int pass = 0; pass < 2; ++pass) {
        const double bound = normal * tangent_of_degrees(0.5 * (angle + a.friction));
        a.bound_before = bound;
        const double left = left_of(-ks * motion / (bound * (1 - ratio)));
        a.stress = std::min(bound + (start - bound) * left, start + ks * motion); // F is 1 at most
        a.plastic = std::max(0.0, motion - (a.stress - start) / ks);
        a.friction = intrinsic + (angle - intrinsic) * left_of(-a.plastic * per_roughness);
    }
    return a;
}

/// With dilation the step is done three times: it closes the joint further, which changes the normal stress (1) and with it
/// all the rest.
template <int passes> void run_rows(kaya_jbatch* batch) {
    constexpr double tiny = std::numeric_limits<double>::min();
    const double* p = batch->properties;
    const PowerSprings springs = springs_of(p);
    const PowerSpring spring = springs.normal;
    const PowerStiffness shear = springs.shear;
    const double per_roughness = 1 / p[roughness], intrinsic = p[friction], worn = coulomb::tan_degrees(p[friction]);
    const double at_first = coulomb::tan_degrees(p[friction_initial]);

    const double *area_of = batch->area, *openings = batch->normal_disp_inc;
    const double *motion_x = batch->shear_disp_inc[0], *motion_y = batch->shear_disp_inc[1],
                 *motion_z = batch->shear_disp_inc[2];
    double *normal_force = batch->normal_force, *force_x = batch->shear_force[0], *force_y = batch->shear_force[1],
           *force_z = batch->shear_force[2], *work = batch->frictional_work;
    double *closures = batch->history[closure], *angles = batch->history[friction_mobilised],
           *plastics = batch->history[plastic];
    double *ratios = batch->history[reversal_ratio], *heads = batch->history[heading];
    double *normal_stiffness = batch->normal_stiffness, *shear_stiffness = batch->shear_stiffness;
    std::uint32_t* states = batch->state;
    const std::size_t n = batch->n;
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i) {
        const double area = area_of[i], per_area = area > 0 ? 1 / area : 0;
        const double angle = angles[i], ratio = ratios[i], head = heads[i], tangent = tangent_of_degrees(angle);
        const double old_normal = normal_force[i] * per_area, old_ks = shear.at(old_normal),
                     old_bound = old_normal * tangent;
        const double closed = closures[i] - openings[i];

        // Resistance on the side that is moved: minus the force on block 2.
        const Shear resistance = {-force_x[i] * per_area, -force_y[i] * per_area, -force_z[i] * per_area};
        const Shear motion = {motion_x[i], motion_y[i], motion_z[i]};
        const double size = length(resistance), travel = length(motion);
        const double dot = resistance.x * motion.x + resistance.y * motion.y + resistance.z * motion.z;
        const double per_travel = travel > 0 ? 1 / std::max(travel, tiny) : 0;
        // A bound that has worn off under the resistance; never more than it was worth at first.
        const double worn_off_by = std::min(size / std::max(old_bound, tiny), at_first / std::max(tangent, tiny));
        const double over = old_bound > 0 ? std::max(1.0, worn_off_by) : 1;
        // The motion turns back when it goes against the resistance after it went with it, or the other way round (4).
        const bool turns = dot * head < 0;

        double normal = 0, bound = 0, kept = 1, along = 0, lifting = 0, across = 1;
        Advance step{};
#pragma GCC unroll 3
        for (int pass = 0; pass < passes; ++pass) {
            normal = std::max(0.0, spring.stress(closed + lifting));
            const double ks = shear.at(normal);
            bound = normal * tangent;
            // A normal stress that falls takes resistance with it, as much as stiffness (7) and bounding strength say.
            const double softer = std::min(1.0, ks / old_ks), held = bound * over / std::max(size, tiny);
            kept = size * softer > bound * over ? held : softer;
            along = dot * per_travel * kept; // component in the direction of motion
            const bool moves = travel > 0 && bound > 0;
            const double some_bound = std::max(bound, tiny), some_normal = std::max(normal, tiny);
            const double turned = std::min(largest_ratio, along / some_bound);
            const Advance moved =
                advance(along, travel, ks, turns ? turned : ratio, some_normal, angle, intrinsic, per_roughness);
            step.stress = moves ? moved.stress : along;
            step.plastic = moves ? moved.plastic : 0;
            step.friction = moves ? moved.friction : angle;
            // Resistance across the motion is worn off by the plastic part of the motion.
            const double worn_off = left_of(-ks * moved.plastic / moved.bound_before);
            across = moves ? worn_off : across;
            // The tangent of the angle of the stress above the intrinsic friction (8).
            const double slope = moved.stress / some_normal, above = std::max(0.0, (slope - worn) / (1 + slope * worn));
            lifting = passes > 1 && moves ? above * moved.plastic : lifting;
        }
        const double turned = std::min(largest_ratio, along / std::max(bound, tiny));
        const double new_ratio = turns ? turned : ratio;

        // What is along the motion, and what is across it.
        const bool bears = bound > 0;
        const double forward = bears ? (travel > 0 ? step.stress : 0) * per_travel : 0;
        const double taken = along * per_travel, rest = bears ? across : 0;
        const Shear fresh = {(resistance.x * kept - taken * motion.x) * rest + forward * motion.x,
                             (resistance.y * kept - taken * motion.y) * rest + forward * motion.y,
                             (resistance.z * kept - taken * motion.z) * rest + forward * motion.z};
        const double worked = 0.5 * ((resistance.x + fresh.x) * motion.x + (resistance.y + fresh.y) * motion.y +
                                     (resistance.z + fresh.z) * motion.z);
        const double new_closed = closed + lifting, new_normal = std::max(0.0, spring.stress(new_closed));
        const double new_ks = shear.at(new_normal), new_size = length(fresh);
        // What is put in and neither stored in the springs nor spent on dilation.
        // A force that was put where nothing presses has nothing stored.
        const double stored_before = old_normal > 0 ? 0.5 * size * size / old_ks : 0;
        const double stored = 0.5 * new_size * new_size / new_ks - stored_before;
        const double lifted = 0.5 * (old_normal + new_normal) * lifting;
        work[i] += area * (worked - stored - lifted);

        const double cosine =
            (fresh.x * motion.x + fresh.y * motion.y + fresh.z * motion.z) * per_travel / std::max(new_size, tiny);
        const double new_head = travel > 0 && new_size > 0 ? cosine : head;
        const double new_angle = step.friction;
        const bool past_peak =
            step.stress > 0 && step.stress >= new_normal * tangent_of_degrees(new_angle) && step.plastic > 0;
        closures[i] = new_closed;
        angles[i] = new_angle;
        ratios[i] = bears ? new_ratio : 0;
        heads[i] = bears ? new_head : 0;
        plastics[i] += step.plastic;
        normal_force[i] = new_normal * area;
        force_x[i] = -fresh.x * area;
        force_y[i] = -fresh.y * area;
        force_z[i] = -fresh.z * area;
        normal_stiffness[i] = spring.reported(new_normal, area);
        shear_stiffness[i] = new_ks;
        states[i] = (new_normal > 0 ? 0 : is_open) | (past_peak ? is_past_peak : 0);
    }
    batch->stiffness_changed = 1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->properties[dilates] != 0) run_rows<3>(batch);
    else run_rows<1>(batch);
    return -1;
}

const char* check(const double* p) {
    if (!(p[stiffness_normal] > 0)) return "kn-initial (jkn) is 0: give the joint a normal stiffness";
    if (!(p[stiffness_shear] > 0)) return "ks-initial (jks) is 0: give the joint a shear stiffness";
    if (!(p[roughness] > 0))
        return "roughness (jr) is 0: give the plastic displacement over which the joint wears, or use jmodel mohr";
    if (p[friction] > p[friction_initial])
        return "friction is above friction-initial: this joint only wears, give a friction-initial of at least that";
    if (!(p[friction_initial] > 0)) return "friction-initial is 0: a joint without friction is jmodel mohr";
    return springs_of(p).fault();
}

void max_stiffness(const double* p, double* normal, double* shear) { springs_of(p).largest_at_start(normal, shear); }

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "continuously-yielding",
    "Continuously yielding joint of Cundall and Hart",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
