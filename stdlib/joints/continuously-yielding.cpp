// Joint model `continuously-yielding`: shear stress that nears a bounding strength, which wears off with plastic
// displacement. docs/joint-models/continuously-yielding.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "kaya/law/rows.hpp"
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

/// (2), (3) and (5) integrated over the step. For a fixed bound the stress approaches it exponentially, and for a known plastic
/// displacement so does the angle; two passes with the mean angle make the step second-order. The bound is above 0.
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

/// Values that all rows of a batch share.
struct Joint {
    explicit Joint(const double* p)
        : springs(springs_of(p)), per_roughness(1 / p[roughness]), intrinsic(p[friction]),
          worn(coulomb::tan_degrees(p[friction])), at_first(coulomb::tan_degrees(p[friction_initial])) {}

    PowerSprings springs;
    double per_roughness, intrinsic, worn, at_first;
};

/// The columns of a batch.
struct Rows {
    explicit Rows(kaya_jbatch& b)
        : area(b.area), opening(b.normal_disp_inc), motion_x(b.shear_disp_inc[0]), motion_y(b.shear_disp_inc[1]),
          motion_z(b.shear_disp_inc[2]), normal_force(b.normal_force), force_x(b.shear_force[0]),
          force_y(b.shear_force[1]), force_z(b.shear_force[2]), work(b.frictional_work), closures(b.history[closure]),
          angles(b.history[friction_mobilised]), plastics(b.history[plastic]), ratios(b.history[reversal_ratio]),
          heads(b.history[heading]), normal_stiffness(b.normal_stiffness), shear_stiffness(b.shear_stiffness),
          states(b.state) {}

    const double *area, *opening, *motion_x, *motion_y, *motion_z;
    double *normal_force, *force_x, *force_y, *force_z, *work, *closures, *angles, *plastics, *ratios, *heads,
        *normal_stiffness, *shear_stiffness;
    std::uint32_t* states;
};

constexpr double tiny = std::numeric_limits<double>::min();

/// By value: std::max takes references, which keeps the objects of the members in memory, and rows are then not processed eight at a time.
[[gnu::always_inline]] inline double larger(double a, double b) { return a < b ? b : a; }
[[gnu::always_inline]] inline double smaller(double a, double b) { return b < a ? b : a; }

/// State of a row before the step, and its motion.
struct Start {
    double area, angle, ratio, head, tangent; ///< tangent of the mobilised angle
    double normal, ks, bound, closed;     ///< stress, stiffness and bounding strength before; closure without dilation
    Shear resistance, motion;             ///< resistance on the side that is moved: minus the force on block 2
    double size, travel, dot, per_travel; ///< of the resistance, of the motion, their product, 1 / travel
    double over;                          ///< a bound that has worn off under the resistance: how far it is above
    bool turns;                           ///< the motion turns back (4)
};

[[gnu::always_inline]] inline Start start_of(const Joint& joint, const Rows& r, std::size_t i) {
    Start s;
    const double per_area = r.area[i] > 0 ? 1 / r.area[i] : 0;
    s.area = r.area[i];
    s.angle = r.angles[i], s.ratio = r.ratios[i], s.head = r.heads[i], s.tangent = tangent_of_degrees(s.angle);
    s.normal = r.normal_force[i] * per_area, s.ks = joint.springs.shear.at(s.normal), s.bound = s.normal * s.tangent;
    s.closed = r.closures[i] - r.opening[i];
    s.resistance = {-r.force_x[i] * per_area, -r.force_y[i] * per_area, -r.force_z[i] * per_area};
    s.motion = {r.motion_x[i], r.motion_y[i], r.motion_z[i]};
    s.size = length(s.resistance), s.travel = length(s.motion);
    s.dot = s.resistance.x * s.motion.x + s.resistance.y * s.motion.y + s.resistance.z * s.motion.z;
    s.per_travel = s.travel > 0 ? 1 / larger(s.travel, tiny) : 0;
    // Never above its initial value.
    const double worn_off_by = smaller(s.size / larger(s.bound, tiny), joint.at_first / larger(s.tangent, tiny));
    s.over = s.bound > 0 ? larger(1.0, worn_off_by) : 1;
    // The motion reverses relative to the resistance.
    s.turns = s.dot * s.head < 0;
    return s;
}

/// Results of the passes over a row.
struct Found {
    double bound = 0, kept = 1; ///< bounding strength; part of the resistance that a falling normal stress leaves
    double along = 0;           ///< component of the resistance in the direction of motion
    double lifting = 0;         ///< dilation
    double across = 1;          ///< part of the resistance across the motion that is left
    Advance step{};
};

/// With dilation the step is done three times: it closes the joint further, which changes the normal stress (1) and with it
/// all the rest.
template <int passes> [[gnu::always_inline]] inline Found find_step(const Joint& joint, const Start& s) {
    Found f;
#pragma GCC unroll 3
    for (int pass = 0; pass < passes; ++pass) {
        const double normal = larger(0.0, joint.springs.normal.stress(s.closed + f.lifting));
        const double ks = joint.springs.shear.at(normal);
        f.bound = normal * s.tangent;
        // A decreasing normal stress reduces the resistance, in proportion to stiffness (7) and bounding strength.
        const double softer = smaller(1.0, ks / s.ks), held = f.bound * s.over / larger(s.size, tiny);
        f.kept = s.size * softer > f.bound * s.over ? held : softer;
        f.along = s.dot * s.per_travel * f.kept;
        const bool moves = s.travel > 0 && f.bound > 0;
        const double some_bound = larger(f.bound, tiny), some_normal = larger(normal, tiny);
        const double turned = smaller(largest_ratio, f.along / some_bound);
        const Advance moved = advance(f.along, s.travel, ks, s.turns ? turned : s.ratio, some_normal, s.angle,
                                      joint.intrinsic, joint.per_roughness);
        f.step.stress = moves ? moved.stress : f.along;
        f.step.plastic = moves ? moved.plastic : 0;
        f.step.friction = moves ? moved.friction : s.angle;
        // Resistance across the motion is worn off by the plastic part of the motion.
        const double worn_off = left_of(-ks * moved.plastic / moved.bound_before);
        f.across = moves ? worn_off : f.across;
        // The tangent of the angle of the stress above the intrinsic friction (8).
        const double slope = moved.stress / some_normal,
                     above = larger(0.0, (slope - joint.worn) / (1 + slope * joint.worn));
        f.lifting = passes > 1 && moves ? above * moved.plastic : f.lifting;
    }
    return f;
}

/// Forces, work and state of row `i` at the end of the step.
[[gnu::always_inline]] inline void end_row(const Joint& joint, const Rows& r, std::size_t i, const Start& s,
                                           const Found& f) {
    const double turned = smaller(largest_ratio, f.along / larger(f.bound, tiny));
    const double new_ratio = s.turns ? turned : s.ratio;

    // The components along the motion and across it.
    const bool bears = f.bound > 0;
    const double forward = bears ? (s.travel > 0 ? f.step.stress : 0) * s.per_travel : 0;
    const double taken = f.along * s.per_travel, rest = bears ? f.across : 0;
    const Shear fresh = {(s.resistance.x * f.kept - taken * s.motion.x) * rest + forward * s.motion.x,
                         (s.resistance.y * f.kept - taken * s.motion.y) * rest + forward * s.motion.y,
                         (s.resistance.z * f.kept - taken * s.motion.z) * rest + forward * s.motion.z};
    const double worked = 0.5 * ((s.resistance.x + fresh.x) * s.motion.x + (s.resistance.y + fresh.y) * s.motion.y +
                                 (s.resistance.z + fresh.z) * s.motion.z);
    const double new_closed = s.closed + f.lifting, new_normal = larger(0.0, joint.springs.normal.stress(new_closed));
    const double new_ks = joint.springs.shear.at(new_normal), new_size = length(fresh);
    // Work that is neither stored in the springs nor spent on dilation. A force that was set without normal stress stores no energy.
    const double stored_before = s.normal > 0 ? 0.5 * s.size * s.size / s.ks : 0;
    const double stored = 0.5 * new_size * new_size / new_ks - stored_before;
    const double lifted = 0.5 * (s.normal + new_normal) * f.lifting;
    r.work[i] += s.area * (worked - stored - lifted);

    const double cosine =
        (fresh.x * s.motion.x + fresh.y * s.motion.y + fresh.z * s.motion.z) * s.per_travel / larger(new_size, tiny);
    const double new_head = s.travel > 0 && new_size > 0 ? cosine : s.head;
    const bool past_peak =
        f.step.stress > 0 && f.step.stress >= new_normal * tangent_of_degrees(f.step.friction) && f.step.plastic > 0;
    r.closures[i] = new_closed;
    r.angles[i] = f.step.friction;
    r.ratios[i] = bears ? new_ratio : 0;
    r.heads[i] = bears ? new_head : 0;
    r.plastics[i] += f.step.plastic;
    r.normal_force[i] = new_normal * s.area;
    r.force_x[i] = -fresh.x * s.area;
    r.force_y[i] = -fresh.y * s.area;
    r.force_z[i] = -fresh.z * s.area;
    r.normal_stiffness[i] = joint.springs.normal.reported(new_normal, s.area);
    r.shear_stiffness[i] = new_ks;
    r.states[i] = (new_normal > 0 ? 0 : is_open) | (past_peak ? is_past_peak : 0);
}

template <int passes> void run_rows(kaya_jbatch* batch) {
    const Joint joint(batch->properties);
    const Rows rows(*batch);
    const std::size_t n = batch->n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        const Start start = start_of(joint, rows, i);
        end_row(joint, rows, i, start, find_step<passes>(joint, start));
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
