#include "commands/session/plausible.hpp"

#include "base/counted.hpp"
#include "commands/monitors/free_fall.hpp"
#include "commands/review/text_doubts.hpp"
#include "commands/session/materials.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/session/session.hpp"
#include "commands/program/text_table.hpp"
#include "laws/property_roles.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <set>

namespace kaya {

namespace {

/// Whether a word of `prop` or `jmodel` is an angle of friction: the classic words, and those of loaded joint models.
bool is_friction_angle(const JointRegistry& joints, const std::string& word) {
    constexpr std::string_view classic = "jfriction";
    constexpr std::size_t shortest = 2;
    if (word.size() >= shortest && classic.starts_with(word)) return true;
    return std::ranges::any_of(joints.loaded(), [&](const auto& model) {
        const auto found = model->find_property(word);
        if (!found) return false;
        return strength_part(model->properties[*found].role) == StrengthPart::friction;
    });
}

constexpr double greatest_density = 1e5; // kg/m3, tonnes or megagrams: no rock, steel or lead in any usual unit

} // namespace

void warn_of(Session& session, std::vector<Diagnostic> doubts) {
    for (auto& doubt : doubts) session.warn(std::move(doubt));
}

void doubt_angles(Session& session, const std::vector<lang::Property::Item>& items) {
    for (const auto& item : items)
        if (may_be_radians(item) && is_friction_angle(session.engine.joints, item.word))
            session.warn(radian_doubt(item));
}

void doubt_elasticity(Session& session) {
    const auto& used = session.engine.model.blocks.material;
    const std::set<std::int32_t> in_use(used.begin(), used.end());
    for (const std::int32_t number : in_use) {
        const auto found = session.engine.model.materials.find(number);
        if (found == session.engine.model.materials.end()) continue;
        const double bulk = found->second.bulk, shear = found->second.shear;
        const double poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
        if (!(poisson < 0)) continue; // also when a modulus is not given
        const std::string message = fmt::format("material {} has a Poisson's ratio of {:.3g}: bulk {}, shear {}",
                                                number, poisson, number_text(bulk), number_text(shear));
        if (session.program.said_once.insert(message).second)
            session.warn(
                implausible(message, "rock has 0.1 to 0.4: a bulk modulus of 0.9 to 4.7 times the shear modulus"));
    }
}

void doubt_densities(Session& session) {
    for (const auto& [number, material] : session.engine.model.materials) {
        if (!(material.density > greatest_density)) continue;
        const std::string message = fmt::format("material {} has a density of {}: no material is that heavy", number,
                                                number_text(material.density));
        if (session.program.said_once.insert(message).second) session.warn(implausible(message, "rock has 2700 kg/m3"));
    }
}

void doubt_weight(Session& session) {
    struct System {
        double gravity, rock; ///< of the earth, and the density of rock
        const char* units;
    };
    constexpr std::array<System, 7> systems{{{9.81, 2700, "kg, m, Pa"},
                                             {9.81, 2.7, "t, m, kPa"},
                                             {9.81, 2.7e-3, "kt, m, MPa"},
                                             {9810, 2.7e-9, "t, mm, MPa"},
                                             {981, 2.7, "g, cm"},
                                             {386.1, 2.5e-4, "lbf, in"},
                                             {32.17, 5.2, "slug, ft"}}};
    constexpr double near = 0.02, lightest = 0.03,
                     heaviest = 9; // parts of the earth's gravity and of the density of rock
    const double gravity = session.engine.model.settings.gravity.norm();
    const auto of_earth = [&](const System& system) {
        return std::abs(gravity - system.gravity) < near * system.gravity;
    };
    if (session.deck.units.given() || std::ranges::none_of(systems, of_earth)) return;
    for (const auto& [number, material] : session.engine.model.materials) {
        const double density = material.density;
        const auto fits = [&](const System& system) {
            return of_earth(system) && density > lightest * system.rock && density < heaviest * system.rock;
        };
        if (!(density > 0) || density > greatest_density || std::ranges::any_of(systems, fits)) continue;
        std::vector<std::string> usual;
        for (const System& system : systems)
            if (of_earth(system)) usual.push_back(fmt::format("{:g} ({})", system.rock, system.units));
        const std::string message = fmt::format("material {} has a density of {} with a gravity of {}", number,
                                                number_text(density), number_text(gravity));
        if (session.program.said_once.insert(message).second)
            session.warn(implausible(message, fmt::format("rock has {} with this gravity", fmt::join(usual, ", "))));
    }
}

void doubt_loads(Session& session) {
    const Model& model = session.engine.model;
    const double gravity = model.settings.gravity.norm();
    if (!(gravity > 0)) return;
    constexpr double most = 1e7; // times the weight of the model
    double weight = 0, load = 0;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        weight += model.blocks.mass[b] * gravity;
        load = std::max(load, model.blocks.load[b].norm());
    }
    if (!(weight > 0) || !(load > most * weight)) return;
    const std::string message = fmt::format("a load of {:.3g} acts on a model that weighs {:.3g}", load, weight);
    if (session.program.said_once.insert(message).second)
        session.warn(implausible(message, "look at its exponent, and at the units of loads and density"));
}

void doubt_units(Session& session) {
    if (!session.deck.units.given()) return;
    const Units& units = session.deck.units;
    const auto doubt_value = [&](const std::string& what, double value, double in_si, const char* si, double least,
                                 double most, std::string_view quantity) {
        const double size = std::abs(in_si);
        if (!(size > 0) || (size >= least && size <= most)) return; // also when it is not given
        const std::string unit = units.label(quantity);
        const std::string meant = unit == si ? "" : fmt::format(", which is {:.3g} {}", in_si, si);
        const std::string message =
            fmt::format("{} {} {}{}: are the units {}?", what, number_text(value), unit, meant, units.name());
        if (session.program.said_once.insert(message).second)
            session.warn(
                implausible(message, fmt::format("usual are {:g} to {:g} {}; `set units` names other systems: {}",
                                                 least, most, si, fmt::join(Units::names(), ", "))));
    };
    for (const auto& entry : session.engine.model.materials) {
        const std::int32_t number = entry.first;
        const Material& material = entry.second;
        const auto of = [&](const char* what) { return fmt::format("material {}: {}", number, what); };
        doubt_value(of("density"), material.density, units.density_in_si(material.density), "kg/m^3", 100, 25000,
                    "density");
        doubt_value(of("bulk modulus"), material.bulk, units.stress_in_si(material.bulk), "Pa", 1e5, 1e12, "stress");
        doubt_value(of("shear modulus"), material.shear, units.stress_in_si(material.shear), "Pa", 1e4, 1e12, "stress");
    }
    const double gravity = session.engine.model.settings.gravity.norm();
    doubt_value("gravity", gravity, units.acceleration_in_si(gravity), "m/s^2", 0.1, 100, "acceleration");
}

void doubt_gravity(Session& session, const Vec3& gravity, const Place& place) {
    if (!(gravity.z() > 0 && gravity.x() == 0 && gravity.y() == 0)) return;
    session.program.show_note(implausible("gravity points up, along z", "down is gravity 0 0 -9.81").at(place));
}

void doubt_joints(Session& session) {
    double density = 0;
    for (const auto& [number, material] : session.engine.model.materials) density = std::max(density, material.density);
    const double size = model_size(session.engine.model);
    const double weight =
        density * session.engine.model.settings.gravity.norm() * size; // of the highest column: a stress
    for (const Row row : property_sets_in_use(session.engine.model)) {
        const JointProperties& set = session.engine.model.joint_properties[static_cast<std::size_t>(row)];
        const JointModel* joint = session.engine.joints.find(set.model);
        if (joint == nullptr) continue;
        const auto say = [&](const std::string& message, const std::string& hint) {
            const std::string where = set.place.empty() ? set.model : fmt::format("{}, {}", set.model, set.place);
            const std::string text = fmt::format("{} ({})", message, where);
            if (session.program.said_once.insert(text).second) session.warn(implausible(text, hint));
        };
        const auto value = [&](kaya_jrole role) { return value_of_role(*joint, set.values, role); };
        const auto shear = value(KAYA_JROLE_STIFFNESS_SHEAR), cohesion = value(KAYA_JROLE_COHESION),
                   tension = value(KAYA_JROLE_TENSION);
        const auto friction = value(KAYA_JROLE_FRICTION), dilation = value(KAYA_JROLE_DILATION),
                   stiffness = value(KAYA_JROLE_STIFFNESS_NORMAL), walls = value(KAYA_JROLE_WALL_STRENGTH);
        if (friction && dilation && *dilation > *friction)
            say(fmt::format("dilation {} is above friction {}: a joint that slips would give energy",
                            number_text(*dilation), number_text(*friction)),
                "dilation is at most the friction, and mostly a fraction of it");
        constexpr double steepest = 89; // rough joints have up to 80 at the lowest stress
        if (friction && *friction > steepest)
            say(fmt::format("friction {}: an angle that no joint has", number_text(*friction)),
                "joints have 15 to 70 degrees; for a joint that never slips write jmodel model elastic");
        constexpr double beyond = 10; // times where the line of friction ends
        if (tension && cohesion && friction && *cohesion > 0 && *friction > 0 &&
            *tension * std::tan(*friction * std::numbers::pi / 180) > beyond * *cohesion)
            say(fmt::format("tension {} is far above the cohesion {}", number_text(*tension), number_text(*cohesion)),
                "joints have a tensile strength of at most cohesion / tan(friction): are both in the same unit?");
        if (tension && cohesion && friction && *tension > 0 && *cohesion == 0 && *friction == 0)
            say(fmt::format(
                    "tension {} without friction and cohesion: the bond ends with its first slip, however small",
                    number_text(*tension)),
                "give it a cohesion");
        // Half of the digits of a place are left for its closure.
        constexpr double least = 1e-12;
        const bool unresolved = stiffness && weight > 0 && weight / *stiffness < least * size;
        if (unresolved)
            say(fmt::format(
                    "normal stiffness {}: the weight of the model closes the joint by {:.1e}, less than places resolve",
                    number_text(*stiffness), weight / *stiffness),
                "about ten times the modulus of the rock over the size of a block is stiff enough");
        constexpr double stiffest = 10,
                         softest = 1e-4; // of shear, to that of normal stiffness; 0 and no friction: a smooth joint
        if (!unresolved && stiffness && shear && *stiffness > 0 && *shear > 0 &&
            (*shear > stiffest * *stiffness || (friction.value_or(0) > 0 && *shear < softest * *stiffness)))
            say(fmt::format("shear stiffness {} with a normal stiffness of {}", number_text(*shear),
                            number_text(*stiffness)),
                "joints have 0.1 to 1 times the normal stiffness: are both in the same unit?");
        constexpr double soft = 0.1; // MPa/m or GPa/m in a deck of Pa
        if (stiffness && *stiffness > 0 && weight / *stiffness > soft * size)
            say(fmt::format(
                    "normal stiffness {}: the weight of the model closes the joint by {:.3g}, the model is {:.3g} "
                    "long",
                    number_text(*stiffness), weight / *stiffness, size),
                "is it in MPa/m or GPa/m, and the rest in Pa?");
        constexpr double far_below = 0.01; // MPa for Pa is a factor of a million
        if (walls && *walls > 0 && *walls < far_below * weight)
            say(fmt::format("{} {} is far below the stress of the model's weight, {:.3g}",
                            joint->properties[*find_role(*joint, KAYA_JROLE_WALL_STRENGTH)].name, number_text(*walls),
                            weight),
                "are the strengths in MPa and the rest in Pa?");
    }
}

void doubt_dynamic_damping(Session& session) {
    const Settings& s = session.engine.model.settings;
    if (!s.dynamic || !damps_to_rest(s)) return;
    if (!session.program.said_once.insert("dynamic-damping").second) return;
    // Equation (2) of docs/theory/damping.md.
    const std::string what =
        s.damping == Damping::local
            ? fmt::format("damp local {} leaves {:.2g} of an amplitude in each half of a period",
                          number_text(s.local_factor), std::sqrt((1 - s.local_factor) / (1 + s.local_factor)))
            : "damp global and damp combined bring a model to rest";
    session.program.show_note(implausible("the run is dynamic, and " + what,
                                          "damp none, `damp contact 0.1` or a fraction and a frequency let it swing; "
                                          "set dynamic off for a static solution"));
}

void doubt_undamped_search(Session& session, const Place& place) {
    const Settings& s = session.engine.model.settings;
    if (s.damping != Damping::none || s.contact_damping != 0) return;
    session.warn(implausible("nothing damps the motion: it does not come to rest",
                             "damp local 0.8 before `solve`; cycle time T runs undamped motion")
                     .at(place));
}

void doubt_gone_blocks(Session& session, const Place& place) {
    const Model& model = session.engine.model;
    const auto gone = blocks_that_left(model);
    if (gone.empty()) return;
    const Row first = gone.front();
    if (!session.program.said_once.insert(fmt::format("left:{}", model.blocks.number[first])).second) return;
    std::string text = body_text(model, {first});
    if (gone.size() > 1) text += " and " + counted(gone.size() - 1, "other block");
    Diagnostic d = implausible(fmt::format("{} left all others: nothing touches it", text),
                               "look at what drives it, or delete it");
    if (model.settings.dynamic) session.program.show_note(d.at(place));
    else session.warn(d.at(place));
}

void doubt_idle_model(Session& session, const Place& place) {
    const Model& model = session.engine.model;
    if (model.blocks.empty() || !model.settings.gravity.isZero(0) || model.zones.size() > 0 ||
        model.boundary_histories.size() > 0 || model.structures.any() || model.settings.water != Water::none)
        return;
    const auto none = [](const auto& column) {
        return std::ranges::all_of(column, [](const Vec3& v) { return v.isZero(0); });
    };
    const std::vector<double> forces = acting_forces(model);
    if (std::ranges::any_of(forces, [](double force) { return force != 0; }) || !none(model.gridpoints.velocity) ||
        !none(model.blocks.velocity))
        return;
    session.warn(implausible("no force acts and nothing moves: there is no equilibrium to look for",
                             "gravity 0 0 -9.81 gives weight, apply and boundary give loads")
                     .at(place));
}

void doubt_empty_model(Session& session, const Place& place) {
    if (session.engine.model.blocks.empty())
        session.warn(implausible("there are no blocks: nothing moves", session.engine.model.excavated.blocks.size() > 0
                                                                           ? "all are excavated: fill puts them back"
                                                                           : "make them first: poly brick ...")
                         .at(place));
}

} // namespace kaya
