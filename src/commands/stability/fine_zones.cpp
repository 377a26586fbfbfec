#include "commands/stability/fine_zones.hpp"

#include "commands/session/materials.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>

namespace kaya {

void check_for_fine_zones(Session& session, const Asked& asked, const Place& place) {
    const Model& model = session.engine.model;
    const auto names = zone_models_in_use(model);
    const bool flow = asked(Reduced::zones) && std::ranges::any_of(names, [&](const auto& name) {
                          const ZoneModel& zones = session.engine.joints.zones.get(name);
                          return zones.flows() && can_be_reduced(zones);
                      });
    if (!flow)
        throw Diagnostic("extrapolate needs zones whose strength is divided: only their factor depends on their size",
                         "leave extrapolate out")
            .at(place);
    if (model.contacts.size() > 0)
        throw Diagnostic("extrapolate is for models without joints: zones that share their strains do not resist the "
                         "uneven forces of joints",
                         "leave extrapolate out and run two meshes, or join the blocks")
            .at(place);
    if (model.structures.stand())
        throw Diagnostic("extrapolate is for models without cables, beams and liners: zones that share their strains "
                         "do not resist the uneven forces of structures",
                         "leave extrapolate out and run two meshes")
            .at(place);
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
