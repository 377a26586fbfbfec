#include "commands/stability/fine_zones.hpp"

#include "commands/session/materials.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

bool weakens(const ZoneModel& zones) { return zones.flows() && can_be_reduced(zones); }

/// Why a model has no factor on fine zones; none where it has one.
std::optional<Diagnostic> objection(Session& session, const Asked& asked) {
    const Model& model = session.engine.model;
    const auto names = zone_models_in_use(model);
    const bool flow = asked.zones() && std::ranges::any_of(names, [&](const auto& name) {
                          return weakens(session.engine.joints.zones.get(name));
                      });
    if (!flow)
        return Diagnostic("extrapolate needs zones whose strength is divided: only their factor depends on their size",
                          "leave extrapolate out");
    if (model.contacts.size() > 0)
        return Diagnostic("extrapolate is for models without joints: zones that share their strains do not resist the "
                          "uneven forces of joints",
                          "leave extrapolate out and run two meshes, or join the blocks");
    if (model.structures.stand())
        return Diagnostic("extrapolate is for models without cables, beams and liners: zones that share their strains "
                          "do not resist the uneven forces of structures",
                          "leave extrapolate out and run two meshes");
    return std::nullopt;
}

/// Whether the zones of a block are those that the estimate was fitted to: Mohr-Coulomb zones that dilate as much as they have friction.
bool is_verified(const Model& model, Row block, const ZoneModel& zones, bool associated) {
    if (zones.name != "mohr-coulomb") return false;
    if (associated) return true;
    const std::vector<double> values = zone_model_values(model, block, zones);
    const auto value = [&](std::string_view word) {
        const auto at = zones.find_property(word);
        return at ? values[*at] : NAN;
    };
    return value("bfriction") <= value("bdilation");
}

} // namespace

FineZones fine_zones(Session& session, const Asked& asked, const lang::Solve& command) {
    const auto against = objection(session, asked);
    if (against && command.extrapolate.value_or(false)) throw Diagnostic(*against).at(command.place);
    if (against) return FineZones::unknown;
    if (command.extrapolate) return *command.extrapolate ? FineZones::searched : FineZones::on_request;
    const Model& model = session.engine.model;
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) {
        if (!model.blocks.deformable[b]) continue;
        const ZoneModel& zones = session.engine.joints.zones.get(zone_model_of(model, b));
        if (weakens(zones) && !is_verified(model, b, zones, command.associated)) return FineZones::on_request;
    }
    return FineZones::searched;
}

std::optional<FineFactor> fine_factor(double own, double shared, const FailureMode::Shares& mode, double resolution) {
    // Of the family of slopes in docs/theory/slopes.md: the error of sharing as a part of what it takes away, n times the error that remains
    // with n zones over the height, and the error of many.
    constexpr double part = 0.2, spread = 0.2, least_error = 0.005;
    if (mode.zones_high < fewest_zones || shared > own * (1 + resolution)) return std::nullopt;
    const double factor = shared - part * (own - shared);
    const double unknown = 0.5 * resolution * ((1 + part) * shared + part * own);
    return FineFactor{factor, (spread / mode.zones_high + least_error) * factor + unknown};
}

} // namespace kaya
