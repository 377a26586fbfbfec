// fracture delete|copy|truncate|combine|group|cluster: changes of networks.
#include "commands/make/networks.hpp"
#include "commands/session/handlers.hpp"

#include "base/lower_case.hpp"
#include "geometry/fractures/combine.hpp"
#include "geometry/fractures/traces.hpp"
#include "geometry/polyhedra/random.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace kaya {

namespace {

/// "1 fracture", "2 fractures".
std::string fractures_text(std::size_t number) {
    return fmt::format("{} {}", number, number == 1 ? "fracture" : "fractures");
}

/// Calls change(fracture) for the chosen fractures; those for which it is false are deleted. Returns how many were deleted.
template <class Change>
std::size_t change_chosen(Session& session, const lang::FractureChange& command, Change change) {
    std::size_t deleted = 0;
    SurfaceSets& sets = session.deck.surface_sets;
    for (Network* network : networks_of(sets, command.choice, command.place))
        deleted += std::erase_if(
            *network, [&](Fracture& fracture) { return chosen(command.choice, fracture) && !change(fracture); });
    // A name without fractures is none.
    std::erase_if(sets.networks, [](const auto& entry) { return entry.second.empty(); });
    return deleted;
}

void remove_fractures(Session& session, const lang::FractureChange& command) {
    std::optional<Box> box;
    if (command.box) box = box_given(session, command.box, "outside", command.place);
    Random random(static_cast<std::uint64_t>(command.seed));
    const std::size_t deleted = change_chosen(session, command, [&](const Fracture& fracture) {
        if (box && area_in_box(fracture, box->low, box->high) > 0) return true;
        return command.share < 1 && random.uniform() >= command.share;
    });
    session.program.output.say(fractures_text(deleted) + " deleted");
}

void copy_fractures(Session& session, const lang::FractureChange& command) {
    SurfaceSets& sets = session.deck.surface_sets;
    Network copies = chosen_fractures(sets, command.choice, command.place);
    for (Fracture& fracture : copies) {
        fracture.joint_set = 0;
        add_fracture(sets, lower_case(command.name), std::move(fracture));
    }
    session.program.output.say(fractures_text(copies.size()) + " copied");
}

/// Of the polygon for a disc.
int sides_of(const lang::FractureChange& command) { return static_cast<int>(command.sides.value_or(12)); }

void truncate_fractures(Session& session, const lang::FractureChange& command) {
    const Box box = box_given(session, command.box, "box", command.place);
    std::size_t cut = 0;
    const std::size_t deleted = change_chosen(session, command, [&](Fracture& fracture) {
        const bool was_disc = fracture.corners.empty();
        const bool left = cut_to_box(fracture, box.low, box.high, sides_of(command));
        cut += left && was_disc && !fracture.corners.empty();
        return left;
    });
    session.program.output.say(
        fmt::format("{} deleted, {} became {}", fractures_text(deleted), cut, cut == 1 ? "a polygon" : "polygons"));
}

void combine_fractures(Session& session, const lang::FractureChange& command) {
    std::vector<Fracture*> fractures;
    for (Network* network : networks_of(session.deck.surface_sets, command.choice, command.place))
        for (Fracture& fracture : *network)
            if (chosen(command.choice, fracture)) fractures.push_back(&fracture);
    const Combined combined = combine(fractures, {*command.angle, *command.distance,
                                                  static_cast<Combining::Joining>(command.joining), sides_of(command)});
    std::set<std::int64_t> taken_up;
    for (const Fracture* fracture : combined.taken_up) taken_up.insert(fracture->id);
    change_chosen(session, command, [&](const Fracture& fracture) { return !taken_up.contains(fracture.id); });
    std::string text = fractures_text(combined.turned) + " turned";
    if (combined.moved > 0) text += fmt::format(", {} moved", combined.moved);
    if (!taken_up.empty()) text += fmt::format(", {} taken up by larger ones", taken_up.size());
    session.program.output.say(text);
}

void group_fractures(Session& session, const lang::FractureChange& command) {
    std::size_t number = 0;
    change_chosen(session, command, [&](Fracture& fracture) {
        number += !command.out || in_group(fracture, command.name);
        set_group(fracture, command.name, command.out);
        return true;
    });
    session.program.output.say(
        fmt::format("{} {} group {}", fractures_text(number), command.out ? "taken out of" : "in", command.name));
}

void cluster_fractures(Session& session, const lang::FractureChange& command) {
    const Network fractures = chosen_fractures(session.deck.surface_sets, command.choice, command.place);
    const auto clusters = clusters_of(fractures.size(), intersections_of(fractures));
    const std::string slot = command.name.empty() ? "cluster" : command.name;
    std::size_t next = 0;
    change_chosen(session, command, [&](Fracture& fracture) {
        set_group(fracture, fmt::format("{}=cluster-{}", slot, clusters[next++] + 1));
        return true;
    });
    const std::size_t number = clusters.empty() ? 0 : 1 + *std::ranges::max_element(clusters);
    session.program.output.say(fmt::format("{} in {} {}, the largest of {}", fractures_text(fractures.size()), number,
                                           number == 1 ? "cluster" : "clusters",
                                           std::ranges::count(clusters, std::size_t{0})));
}

} // namespace

void run(Session& session, const lang::FractureChange& command) {
    using What = lang::FractureChange::What;
    switch (command.what) {
    case What::remove: return remove_fractures(session, command);
    case What::copy: return copy_fractures(session, command);
    case What::truncate: return truncate_fractures(session, command);
    case What::combine: return combine_fractures(session, command);
    case What::group: return group_fractures(session, command);
    case What::cluster: return cluster_fractures(session, command);
    }
}

void add_handlers(HandlerTable& table, lang::FractureChangeCommands list) { fill(table, list); }

} // namespace kaya
