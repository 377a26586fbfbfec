// Joint model `fracture-energy`: a bond that softens in tension and shear by its fracture energies, friction, and a cap in compression.
// docs/joint-models/fracture-energy.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "kaya/law/return_mapping.hpp"
#include "kaya/law/root.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::length;
using coulomb::Shear;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    tension,
    energy_tension,
    cohesion,
    energy_shear,
    friction,
    friction_residual,
    straight,
    compression,
    compression_residual,
    energy_compression,
    cap_shear,
    property_count
};

constexpr kaya_jproperty properties[] = {
    coulomb::properties[coulomb::stiffness_normal],
    coulomb::properties[coulomb::stiffness_shear],
    {"tension", "jtension ten", "stress", "tensile strength of the bond", 0, 0, INFINITY, 0},
    {"energy-tension", "g1", "stress*length", "fracture energy of opening per area; needed with tension", NAN, 0,
     INFINITY, 1},
    {"cohesion", "jcohesion coh", "stress", "shear strength of the bond at zero normal stress", 0, 0, INFINITY, 0},
    {"energy-shear", "g2", "stress*length", "fracture energy of slip per area; needed with cohesion", NAN, 0, INFINITY,
     1},
    {"friction", "jfriction fric", "angle", "angle of friction of the whole bond", 0, 0, 89, 0},
    {"friction-residual", "jrfriction resfriction", "angle",
     "angle of friction of the broken bond; not given: that of the whole one", NAN, 0, 89, 1},
    {"straight", "", "-", "1: strength falls on a straight line; 0: exponentially", 0, 0, 1, 0},
    {"compression", "jcompression", "stress", "compressive strength; not given: none", NAN, 0, INFINITY, 1},
    {"compression-residual", "", "stress",
     "compressive strength of crushed mortar; not given: that of whole mortar, which then crushes at a constant stress",
     NAN, 0, INFINITY, 1},
    {"energy-compression", "g3", "stress*length",
     "energy of crushing per area above the residual strength; needed with compression-residual", NAN, 0, INFINITY, 1},
    {"cap-shear", "css", "-", "how much shear stress counts in crushing, as its square; 0: not at all", 0, 0, INFINITY,
     0},
};
static_assert(std::size(properties) == property_count);
static_assert(stiffness_normal == std::size_t{coulomb::stiffness_normal} &&
              stiffness_shear == std::size_t{coulomb::stiffness_shear});

enum History : std::size_t { opening, softening, slip, crushed, history_count };

constexpr kaya_jhistory history[] = {
    {"opening", "length", "opening beyond the place without normal stress"},
    {"softening", "-", "how far the bond is on its softening curve; 0: whole"},
    {"slip", "length", "plastic shear displacement, added up"},
    {"crushed", "length", "closure by crushing"},
};
static_assert(std::size(history) == history_count);

constexpr const char* state_names = "slip-now tension-now crush-now slip-past tension-past crush-past";
constexpr uint32_t slip_now = 1, tension_now = 2, crush_now = 4, now = 7;
constexpr int from_now_to_past = 3;

/// Strength that is left on the softening curve (1): from 1 at x = 0 to 0 at `end`.
struct Curve {
    bool straight;
    double end; ///< of an exponential curve where less is left than rounding

    explicit Curve(bool straight_) : straight(straight_), end(straight_ ? 1 : 40) {}
    double left(double x) const { return x >= end ? 0 : straight ? 1 - x : exponential(-x); }
    /// Integral of `left` from 0 to x.
    double area(double x) const {
        const double y = std::min(x, end);
        return straight ? y - 0.5 * y * y : 1 - left(y);
    }
    double whole() const { return straight ? 0.5 : 1; }
};

/// The bond in tension: a spring whose stiffness falls with x, with the envelope (2) and the way back to the origin (3).
struct Tension {
    Curve curve;
    double strength, elastic, length; ///< opening at the strength; opening per x on the envelope

    Tension(const double* p, Curve c)
        : curve(c), strength(p[tension]), elastic(p[tension] / p[stiffness_normal]),
          length(p[tension] > 0 ? (p[energy_tension] / p[tension] - 0.5 * elastic) / c.whole() : 0) {}

    double softened_by(double opened) const {
        if (!(opened > elastic)) return 0;
        return length > 0 ? std::min((opened - elastic) / length, curve.end) : curve.end;
    }
    double stiffness(double x) const {
        const double left = curve.left(x);
        return left > 0 && strength > 0 ? strength * left / (elastic + x * length) : 0;
    }
    double stored_at_envelope(double x) const { return 0.5 * strength * curve.left(x) * (elastic + x * length); }
    /// Energy that opening dissipates from one place on the envelope to another (6).
    double lost(double from, double to) const {
        return strength * length * (curve.area(to) - curve.area(from)) + stored_at_envelope(from) -
               stored_at_envelope(to);
    }
};

/// The cap in compression (5).
struct Cap {
    double residual, fall, per_length; ///< strength that crushing leaves and takes; 1 over the closure of an e-fold
    double shear;

    explicit Cap(const double* p)
        : residual(INFINITY), fall(0), per_length(0), shear(std::isnan(p[compression]) ? 0 : p[cap_shear]) {
        if (std::isnan(p[compression])) return;
        residual = std::isnan(p[compression_residual]) ? p[compression] : p[compression_residual];
        fall = p[compression] - residual;
        per_length = fall > 0 ? fall / p[energy_compression] : 0;
    }
    double left(double closure) const { return fall * exponential(-std::min(closure * per_length, 700.0)); }
    double at(double closure) const { return residual + left(closure); }
    /// Closure that brings a trial stress back to the cap, after an earlier one.
    double closure_of(double trial, double before, double kn) const {
        const auto above = [&](double more) { return trial - kn * more - at(before + more); };
        if (!(above(0) > 0)) return 0;
        return bracketed_root(above, 0, trial / kn).x;
    }
    double lost(double before, double more) const {
        const double rest = per_length > 0 ? (left(before) - left(before + more)) / per_length : 0;
        return residual * more + rest;
    }
};

struct Bond {
    Curve curve;
    Tension pull;
    Cap cap;
    double kn, ks, bonded, slip_length; ///< slip per x
    double residual_tangent, extra_tangent;

    explicit Bond(const double* p)
        : curve(p[straight] != 0), pull(p, curve), cap(p), kn(p[stiffness_normal]), ks(p[stiffness_shear]),
          bonded(p[cohesion]),
          slip_length(p[cohesion] > 0 ? p[energy_shear] / (p[cohesion] * curve.whole()) : INFINITY),
          residual_tangent(tan_degrees(std::isnan(p[friction_residual]) ? p[friction] : p[friction_residual])),
          extra_tangent(tan_degrees(p[friction]) - residual_tangent) {}

    /// Shear strength (4), within the cap.
    double shear_strength(double normal, double x, double cap_now) const {
        const double left = curve.left(x);
        const double line = std::max(0.0, bonded * left + normal * (residual_tangent + extra_tangent * left));
        if (!(cap.shear > 0)) return line;
        return std::min(line, std::sqrt(std::max(0.0, cap_now * cap_now - normal * normal) / cap.shear));
    }
    double softened(double x, double slipped) const { return std::min(x + slipped / slip_length, curve.end); }
};

/// One row, one step, in stresses.
void step(const Bond& bond, kaya_jbatch& b, std::size_t i) {
    double* const opened = b.history[opening] + i;
    double* const x = b.history[softening] + i;
    const double area = b.area[i];
    uint32_t state = (b.state[i] & ~now) | ((b.state[i] & now) << from_now_to_past);
    if (!(area > 0)) {
        *opened = std::max(0.0, *opened + b.normal_disp_inc[i]);
        b.normal_force[i] = b.shear_force[0][i] = b.shear_force[1][i] = b.shear_force[2][i] = 0;
        b.state[i] = state;
        return;
    }
    const double before = b.normal_force[i] / area;
    const double place = (before > 0 ? -before / bond.kn : *opened) + b.normal_disp_inc[i];
    double normal = 0, lost = 0;
    if (place < 0) {
        *opened = 0;
        const double trial = -bond.kn * place;
        double& closed = b.history[crushed][i];
        const double more = bond.cap.closure_of(trial, closed, bond.kn);
        normal = trial - bond.kn * more;
        if (more > 0) {
            state |= crush_now;
            lost += bond.cap.lost(closed, more);
            closed += more;
        }
    } else {
        *opened = place;
        const double reached = bond.pull.softened_by(place);
        if (reached > *x) {
            lost += bond.pull.lost(*x, reached);
            *x = reached;
            state |= tension_now;
        }
        normal = -bond.pull.stiffness(*x) * place;
    }

    // Slip softens the bond and with it the tension across an open joint.
    const double at_start = *x, cap_now = bond.cap.at(b.history[crushed][i]);
    const auto normal_after = [&](double slipped) {
        return place < 0 ? normal : -bond.pull.stiffness(bond.softened(at_start, slipped)) * place;
    };
    const double k = bond.ks * area;
    const Shear old{b.shear_force[0][i], b.shear_force[1][i], b.shear_force[2][i]};
    const Shear trial{old.x - k * b.shear_disp_inc[0][i], old.y - k * b.shear_disp_inc[1][i],
                      old.z - k * b.shear_disp_inc[2][i]};
    const double trial_length = length(trial);
    const auto strength = [&](double, double slipped) {
        return bond.shear_strength(normal_after(slipped), bond.softened(at_start, slipped), cap_now);
    };
    const auto returned = return_to(strength, normal, trial_length / area, {bond.kn, bond.ks}, 0);
    double scale = 1;
    if (returned.slip > 0) {
        state |= slip_now;
        // Where nothing is left, not even rounding.
        scale = std::min(returned.shear, strength(0, returned.slip)) * area / trial_length;
        const double along = (old.x * trial.x + old.y * trial.y + old.z * trial.z) / (trial_length * area);
        lost += returned.work(along);
        *x = bond.softened(at_start, returned.slip);
        const double weaker = normal_after(returned.slip);
        lost += place < 0 ? 0 : 0.5 * (weaker - normal) * place;
        normal = weaker;
        b.history[slip][i] += returned.slip;
    }
    b.normal_force[i] = normal * area;
    b.shear_force[0][i] = trial.x * scale;
    b.shear_force[1][i] = trial.y * scale;
    b.shear_force[2][i] = trial.z * scale;
    b.frictional_work[i] += lost * area;
    b.state[i] = state;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const Bond bond(batch->properties);
    for (std::size_t i = 0; i < batch->n; ++i) step(bond, *batch, i);
    return -1;
}

/// New rows: open sides have no bond; a tension that was set from outside gets its opening.
ptrdiff_t initialise(kaya_jbatch* batch) {
    const Bond bond(batch->properties);
    for (std::size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = bond.kn;
        batch->shear_stiffness[i] = bond.ks;
        const double area = batch->area[i], force = batch->normal_force[i];
        double& opened = batch->history[opening][i];
        double& x = batch->history[softening][i];
        if (force < 0 && area > 0) {
            const double stiffness = bond.pull.stiffness(x);
            opened = stiffness > 0 ? -force / area / stiffness : 0;
        } else if (force > 0) {
            opened = 0;
        } else if (const double gap = coulomb::gap_between(*batch, i); !(opened > 0) && gap > 0) {
            opened = gap;
            x = bond.curve.end;
        }
    }
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (p[tension] > 0 && std::isnan(p[energy_tension]))
        return "tension is given without energy-tension: give the fracture energy of opening, or use jmodel mohr";
    if (p[tension] > 0 && !(p[energy_tension] > 0.5 * p[tension] * p[tension] / p[stiffness_normal]))
        return "energy-tension is not above tension^2/(2 kn), the energy stored at the strength: give a greater "
               "energy-tension or kn, or use jmodel mohr, which breaks at once";
    if (p[cohesion] > 0 && std::isnan(p[energy_shear]))
        return "cohesion is given without energy-shear: give the fracture energy of slip, or use jmodel mohr";
    const double steepest = p[straight] != 0 ? 0.5 : 1; // of the softening curve, over its energy
    if (p[cohesion] > 0 && !(p[energy_shear] > steepest * p[cohesion] * p[cohesion] / p[stiffness_shear]))
        return "energy-shear is so small that the strength falls faster than the spring unloads: it must be above "
               "cohesion^2/ks (straight: half of that); give a greater energy-shear or ks, or use jmodel mohr";
    if (p[friction_residual] > p[friction])
        return "friction-residual is above friction: this bond only weakens, give a friction of at least that";
    if (p[friction_residual] < p[friction] && !(p[cohesion] > 0))
        return "friction-residual is below friction, but without cohesion no slip breaks the bond: give cohesion and "
               "energy-shear, or use jmodel softening-mohr";
    if (std::isnan(p[compression])) {
        if (!std::isnan(p[compression_residual]) || !std::isnan(p[energy_compression]) || p[cap_shear] > 0)
            return "compression-residual, energy-compression and cap-shear need compression: give that strength, or "
                   "leave them out";
        return nullptr;
    }
    if (!(p[compression] > 0)) return "compression is 0: give the joint a compressive strength, or leave it out";
    if (p[compression_residual] > p[compression])
        return "compression-residual is above compression: crushing cannot make the joint stronger, give a "
               "compression of at least that";
    const double fall = p[compression] - p[compression_residual];
    if (fall > 0 && std::isnan(p[energy_compression]))
        return "compression-residual is given without energy-compression: give the energy of crushing, or leave both "
               "out: the joint then crushes at a constant stress";
    if (fall > 0 && !(p[energy_compression] > fall * fall / p[stiffness_normal]))
        return "energy-compression is so small that the strength falls faster than the spring unloads: it must be "
               "above (compression - compression-residual)^2/kn";
    return nullptr;
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "fracture-energy",
    "bond that softens by its fracture energies, with friction and a cap in compression",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    initialise,
    run,
    check,
    coulomb::max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
