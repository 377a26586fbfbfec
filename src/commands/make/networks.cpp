#include "commands/make/networks.hpp"

#include "base/lower_case.hpp"

#include <fmt/format.h>

namespace kaya {

Network& network_named(SurfaceSets& sets, const std::string& name, const Place& place) {
    const auto found = sets.networks.find(name);
    if (found != sets.networks.end()) return found->second;
    throw Diagnostic(fmt::format("there is no network of fractures named '{}'", name),
                     "make it before: fracture create dfn 'name' ...")
        .at(place);
}

bool chosen(const lang::FractureChoice& choice, const Fracture& fracture) {
    const auto within = [](const auto& limits, auto value) {
        return !limits || (value >= (*limits)[0] && value <= (*limits)[1]);
    };
    return within(choice.ids, fracture.id) && within(choice.sizes, fracture.disc.diameter) &&
           (choice.group.empty() || in_group(fracture, choice.group));
}

std::vector<Network*> networks_of(SurfaceSets& sets, const lang::FractureChoice& choice, const Place& place) {
    if (choice.network) return {&network_named(sets, lower_case(*choice.network), place)};
    std::vector<Network*> networks;
    for (auto& [name, network] : sets.networks) networks.push_back(&network);
    return networks;
}

Network chosen_fractures(SurfaceSets& sets, const lang::FractureChoice& choice, const Place& place) {
    Network result;
    for (const Network* network : networks_of(sets, choice, place))
        for (const Fracture& fracture : *network)
            if (chosen(choice, fracture)) result.push_back(fracture);
    return result;
}

Box box_given(const Session& session, const std::optional<std::array<double, 6>>& bounds, const char* word,
              const Place& place) {
    if (!bounds) {
        if (session.engine.model.gridpoints.position.empty())
            throw Diagnostic("there are no blocks whose box could be taken",
                             fmt::format("make blocks before, or write: {} x1 x2 y1 y2 z1 z2", word))
                .at(place);
        return box_around(
            {session.engine.model.gridpoints.position.begin(), session.engine.model.gridpoints.position.end()});
    }
    const auto& b = *bounds;
    const Box box{{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
    if (!((box.high - box.low).minCoeff() > 0))
        throw Diagnostic(fmt::format("the bounds of {} are not in order", word),
                         "write: x1 x2 y1 y2 z1 z2, the least first")
            .at(place);
    return box;
}

} // namespace kaya
