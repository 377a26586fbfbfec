#include "commands/stability/model_on_trial.hpp"

#include "commands/run/run_cycles.hpp"
#include "commands/session/materials.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/cell_state.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/tables/model_edit.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace kaya {

namespace {

/// Cycles after which a model that cannot fail ought to be at rest.
constexpr std::int64_t patience = 100000;
constexpr std::int64_t shortest_span = 100;
/// Dashpots of contacts in trials, of critical damping.
constexpr double dashpots = 0.4;

} // namespace

ModelOnTrial::ModelOnTrial(Session& session, const Asked& asked, bool associated)
    : session_(session), energy_(session.engine.model.settings.energy), damping_(session.engine.model.settings.damping),
      dashpots_(session.engine.model.settings.contact_damping) {
    // Local damping holds back sliding bodies (docs/theory/damping.md); no damping of bodies stops vibrations excited by friction.
    if (damping_ == Damping::local) session.engine.model.settings.damping = Damping::combined;
    session.engine.model.settings.contact_damping = std::max(dashpots_, dashpots);
    initial_.model = session.engine.model;
    initial_.model.settings.energy = true; // a failing trial is detected by its energy account
    initial_.model.unreduced = static_cast<std::uint8_t>((asked.of_zones(Reduced::friction) ? 0 : keep_friction) |
                                                         (asked.of_zones(Reduced::cohesion) ? 0 : keep_cohesion) |
                                                         (asked.of_zones(Reduced::tension) ? 0 : keep_tension) |
                                                         (associated ? flow_is_associated : 0));
}

ModelOnTrial::~ModelOnTrial() {
    session_.engine.model = left_ ? *left_ : initial_.model;
    ModelEdit(session_.engine.model, Change::lists);
    session_.engine.model.unreduced = 0;
    session_.engine.model.settings.energy = energy_;
    session_.engine.model.settings.damping = damping_;
    session_.engine.model.settings.contact_damping = dashpots_;
    drop_idle_dashpots(session_.engine.model);
}

void check_for_associated_flow(Session& session, const Place& place) {
    bool flows = false;
    for (const auto& name : zone_models_in_use(session.engine.model)) {
        const ZoneModel& zones = session.engine.joints.zones.get(name);
        if (!zones.flows()) continue;
        flows = true;
        if (!can_flow_associated(zones))
            throw Diagnostic(
                fmt::format("zone model '{}' has no dilation that could be as large as its friction", name),
                "leave associated out")
                .at(place);
    }
    if (!flows)
        throw Diagnostic("associated is about zones that yield, and there are none", "leave associated out").at(place);
}

void check_for_trials(Session& session, const Asked& asked, const Place& place) {
    std::string without;
    bool any = false;
    if (asked.joints())
        for (const Row row : property_sets_in_use(session.engine.model)) {
            const auto& set = session.engine.model.joint_properties[row];
            const JointModel& joint = session.engine.joints.get(set.model);
            const bool strong = reduced(joint, set.values, 1, asked).has_value();
            any = any || strong;
            if (!strong) without = joint.name;
            if (auto doubt = doubtful_tension(joint, set)) session.warn(std::move(*doubt).at(place));
        }
    for (const auto& name : zone_models_in_use(session.engine.model)) {
        const ZoneModel& zones = session.engine.joints.zones.get(name);
        any = any || (can_be_reduced(zones) && asked.zones());
        if (asked.zones() && zones.flows() && !can_be_reduced(zones))
            session.warn(Diagnostic(fmt::format("zone model '{}' has no strength that could be divided", name),
                                    "its strength is unchanged in all trials")
                             .at(place));
    }
    if (!any)
        throw Diagnostic(without.empty()
                             ? "there is no joint whose strength could be divided"
                             : fmt::format("joint model '{}' has no strength that could be divided", without),
                         "a factor of safety needs joints with friction, cohesion or tension")
            .at(place);
    if (!without.empty())
        session.warn(Diagnostic(fmt::format("joint model '{}' has no friction, cohesion or tension", without),
                                "its strength is unchanged in all trials")
                         .at(place));
    if (session.engine.model.settings.damping == Damping::none)
        throw Diagnostic("without damping a model never comes to rest, and no factor of safety can be found",
                         "write before it, for example: damp local")
            .at(place);
}

std::int64_t characteristic_span(Session& session, Progress& progress, const RestRatio& ratio, const Place& place) {
    Model& model = session.engine.model;
    const ElasticJoints strong(session);
    model.settings.strength_factor = 0.01; // zones a hundred times as strong do not yield
    for (double& force : model.sub_contacts.normal_force) force *= 0.5;
    for (auto& column : model.sub_contacts.shear_force.component)
        for (double& force : column) force *= 0.5;
    scale_zone_stresses(model, 0.5);
    initialise_sub_contacts(model, session.engine.joints, std::vector<char>(model.sub_contacts.size(), 1));
    ModelEdit(model, Change::properties);
    progress.expect("how long the model takes to come to rest", std::nullopt);
    const RestSpan span = advance_span(session, patience, ratio, nullptr, &progress);
    if (span.at_rest) return std::max(span.cycles, shortest_span);
    throw Diagnostic(
        fmt::format("with joints that cannot fail the model is not at rest after {} cycles: the ratio is {:.3e}",
                    span.cycles, ratio.now(model.clock)),
        "hold it so that only joints can let it go, or give a larger `ratio`, or the `cycles` of a span")
        .at(place);
}

} // namespace kaya
