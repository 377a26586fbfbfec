// fracture: networks of discs, made one by one, drawn from laws, read from files, measured.
#include "commands/make/networks.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/long_work.hpp"

#include "base/lower_case.hpp"
#include "geometry/fractures/growth.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/read/read_discs.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace kaya {

namespace {

/// The box of six bounds, or that around the model.
Box box_of(const Session& session, const std::optional<std::array<double, 6>>& bounds, const char* word,
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

FractureLaw law_of(const lang::FractureTemplate& command) {
    FractureLaw law;
    law.orientation = static_cast<FractureLaw::Orientation>(command.orientation);
    const auto& angles = command.angles;
    law.dip = angles[0];
    if (law.orientation == FractureLaw::Orientation::gauss) {
        law.dip_deviation = angles[1];
        law.dip_direction = angles[2];
        law.dip_direction_deviation = angles[3];
    } else {
        law.dip_direction = angles[1];
        law.kappa = angles[2];
    }
    law.size = static_cast<FractureLaw::Size>(*command.size);
    if (law.size == FractureLaw::Size::power_law) law.exponent = command.sizes[0];
    else law.mean = command.sizes[0];
    law.deviation = command.sizes[1];
    const auto take = [](const auto& limits, Interval& into) {
        if (limits) into = {(*limits)[0], (*limits)[1]};
    };
    take(command.dip_limits, law.dips);
    take(command.dip_direction_limits, law.dip_directions);
    take(command.size_limits, law.sizes);
    check(law);
    return law;
}

const FractureLaw& law_named(const SurfaceSets& sets, const std::string& name, const Place& place) {
    const auto found = sets.laws.find(lower_case(name.empty() ? sets.last_law : name));
    if (found != sets.laws.end()) return found->second;
    throw Diagnostic(name.empty() ? std::string("there is no template of fractures yet")
                                  : fmt::format("there is no template of fractures named '{}'", name),
                     "make it before: fracture template create 'name' size power-law 3")
        .at(place);
}

Growth growth_of(const Session& session, const lang::FractureGenerate& command) {
    Growth growth;
    const Box box = box_of(session, command.box, "generation-box", command.place);
    growth.low = box.low;
    growth.high = box.high;
    if (command.count) growth.target = static_cast<double>(*command.count);
    if (command.area) {
        growth.until = Growth::Until::area;
        growth.target = *command.area;
    }
    if (command.crossings) {
        growth.until = Growth::Until::crossings;
        growth.target = *command.crossings;
        growth.begin = command.line[0];
        growth.end = command.line[1];
    }
    return growth;
}

std::string sizes_text(const std::vector<Disc>& discs) {
    if (discs.empty()) return "none";
    double least = discs.front().diameter, greatest = least, sum = 0;
    for (const Disc& disc : discs) {
        least = std::min(least, disc.diameter);
        greatest = std::max(greatest, disc.diameter);
        sum += disc.diameter;
    }
    return fmt::format("diameters {:.3g} to {:.3g}, mean {:.3g}", least, greatest,
                       sum / static_cast<double>(discs.size()));
}

/// Discs of one network, or of all.
std::vector<Disc> discs_of(const SurfaceSets& sets, const std::optional<std::string>& network, const Place& place) {
    if (network) return network_named(sets, lower_case(*network), place);
    std::vector<Disc> all;
    for (const auto& [name, discs] : sets.networks) all.insert(all.end(), discs.begin(), discs.end());
    return all;
}

std::string table_of(const std::vector<Disc>& discs) {
    constexpr std::size_t longest_table = 100;
    std::string text =
        fmt::format("{:>6} {:>12} {:>12} {:>12} {:>8} {:>8} {:>12}", "number", "x", "y", "z", "dip", "dd", "size");
    for (std::size_t i = 0; i < std::min(discs.size(), longest_table); ++i) {
        const Disc& d = discs[i];
        text += fmt::format("\n{:>6} {:>12.6g} {:>12.6g} {:>12.6g} {:>8.4g} {:>8.4g} {:>12.6g}", i + 1, d.centre.x(),
                            d.centre.y(), d.centre.z(), d.dip, d.dip_direction, d.diameter);
    }
    if (discs.size() > longest_table) text += fmt::format("\n... and {} more fractures", discs.size() - longest_table);
    return text;
}

} // namespace

const std::vector<Disc>& network_named(const SurfaceSets& sets, const std::string& name, const Place& place) {
    const auto found = sets.networks.find(name);
    if (found != sets.networks.end()) return found->second;
    throw Diagnostic(fmt::format("there is no network of fractures named '{}'", name),
                     "make it before: fracture create dfn 'name' ...")
        .at(place);
}

void run(Session& session, const lang::FractureCommand& command) {
    auto& networks = session.deck.surface_sets.networks;
    const std::string name = lower_case(command.network);
    if (!command.remove) {
        networks[name].push_back({command.position, command.dip, command.dip_direction, command.size});
        return;
    }
    network_named(session.deck.surface_sets, name, command.place);
    networks.erase(name);
}

void run(Session& session, const lang::FractureTemplate& command) {
    SurfaceSets& sets = session.deck.surface_sets;
    const std::string name = lower_case(command.name);
    try {
        if (command.remove) {
            law_named(sets, name, command.place);
            sets.laws.erase(name);
            if (sets.last_law == name) sets.last_law.clear();
            return;
        }
        sets.laws[name] = law_of(command);
        sets.last_law = name;
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::FractureGenerate& command) {
    SurfaceSets& sets = session.deck.surface_sets;
    try {
        const FractureLaw law = law_named(sets, command.source, command.place);
        const Growth growth = growth_of(session, command);
        // Each line draws other numbers, with the same seed too.
        std::size_t before = 0;
        for (const auto& [name, discs] : sets.networks) before += discs.size();
        LongWork work(session, "fractures");
        const std::vector<Disc> drawn =
            grow(law, growth, Random(static_cast<std::uint64_t>(command.seed), before), std::ref(work));
        auto& network = sets.networks[lower_case(command.network)];
        network.insert(network.end(), drawn.begin(), drawn.end());
        session.program.output.say(fmt::format("fractures: {} made, {}; {:.4g} of area per volume of the box",
                                               drawn.size(), sizes_text(drawn), p32(drawn, growth.low, growth.high)));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::FractureImport& command) {
    try {
        const auto text = file_text(session.input_file(command.file));
        if (!text) throw Diagnostic(fmt::format("the file '{}' cannot be read", command.file), "look at its name");
        const std::vector<Disc> discs = read_discs(*text, command.file);
        auto& network = session.deck.surface_sets.networks[lower_case(command.network)];
        network.insert(network.end(), discs.begin(), discs.end());
        session.program.output.say(fmt::format("fractures: {} read, {}", discs.size(), sizes_text(discs)));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::FractureMeasure& command) {
    using enum lang::FractureMeasure::What;
    const std::vector<Disc> discs = discs_of(session.deck.surface_sets, command.network, command.place);
    if (command.what == list) {
        session.program.output.print(table_of(discs));
        return;
    }
    if (command.what == crossings) {
        session.program.output.print(fmt::format("p10 = {:.9g}", p10(discs, command.line[0], command.line[1])));
        return;
    }
    const Box box = box_of(session, command.box, "box", command.place);
    if (command.what == area) {
        session.program.output.print(fmt::format("p32 = {:.9g}", p32(discs, box.low, box.high)));
        return;
    }
    const auto inside = std::ranges::count_if(discs, [&](const Disc& d) {
        return (d.centre - box.low).minCoeff() >= 0 && (box.high - d.centre).minCoeff() >= 0;
    });
    session.program.output.print(
        fmt::format("center density = {:.9g}", static_cast<double>(inside) / (box.high - box.low).prod()));
}

void add_handlers(HandlerTable& table, lang::FractureCommands list) { fill(table, list); }

} // namespace kaya
