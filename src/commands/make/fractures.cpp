// fracture create|template|generate|import|export: networks of fractures, made one by one, drawn from laws, read from files, written.
#include "commands/make/networks.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/long_work.hpp"

#include "base/counted.hpp"
#include "base/lower_case.hpp"
#include "geometry/fractures/growth.hpp"
#include "geometry/read/read_fractures.hpp"
#include "geometry/read/read_sample.hpp"
#include "geometry/read/write_fractures.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <utility>

namespace kaya {

namespace {

std::string text_of(Session& session, const std::string& file) {
    if (auto text = file_text(session.input_file(file))) return *std::move(text);
    throw Diagnostic(fmt::format("the file '{}' cannot be read", file), "look at its name");
}

FractureLaw law_of(Session& session, const lang::FractureTemplate& command) {
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
    if (!command.planes.empty()) law.planes = read_planes(text_of(session, command.planes), command.planes);
    if (!command.diameters.empty()) {
        law.diameters = read_diameters(text_of(session, command.diameters), command.diameters);
        law.sizes = {0, largest_fracture}; // what was measured is drawn
    }
    const auto take = [](const auto& limits, auto& into) {
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
    const Box box = box_given(session, command.box, "generation-box", command.place);
    growth.low = box.low;
    growth.high = box.high;
    if (command.count) growth.target = static_cast<double>(*command.count);
    if (command.area) {
        growth.until = Growth::Until::area;
        growth.target = *command.area;
    }
    if (command.percolation) {
        growth.until = Growth::Until::percolation;
        growth.target = *command.percolation;
    }
    if (command.crossings) {
        growth.until = Growth::Until::crossings;
        growth.target = *command.crossings;
        growth.begin = command.line[0];
        growth.end = command.line[1];
    }
    return growth;
}

const Disc& disc_of(const Disc& disc) { return disc; }
const Disc& disc_of(const Fracture& fracture) { return fracture.disc; }

/// Of discs, or of fractures.
template <class Fractures> std::string sizes_text(const Fractures& fractures) {
    if (fractures.empty()) return "none";
    double least = std::numeric_limits<double>::infinity(), greatest = 0, sum = 0;
    for (const auto& fracture : fractures) {
        const Disc& disc = disc_of(fracture);
        least = std::min(least, disc.diameter);
        greatest = std::max(greatest, disc.diameter);
        sum += disc.diameter;
    }
    return fmt::format("diameters {:.3g} to {:.3g}, mean {:.3g}", least, greatest,
                       sum / static_cast<double>(fractures.size()));
}

/// The group and the rank of new fractures.
template <class Command> void given_to(Fracture& fracture, const Command& command) {
    fracture.dominance = static_cast<std::int32_t>(command.dominance);
    if (!command.group.empty()) set_group(fracture, command.group);
}

} // namespace

void run(Session& session, const lang::FractureCommand& command) {
    Fracture fracture{{command.position, command.dip, command.dip_direction, command.size}};
    given_to(fracture, command);
    add_fracture(session.deck.surface_sets, lower_case(command.network), std::move(fracture));
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
        sets.laws[name] = law_of(session, command);
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
        const std::string network = lower_case(command.network);
        for (const Disc& disc : drawn) {
            Fracture fracture{disc};
            given_to(fracture, command);
            add_fracture(sets, network, std::move(fracture));
        }
        session.program.output.say(fmt::format("fractures: {} made, {}; {:.4g} of area per volume of the box",
                                               drawn.size(), sizes_text(drawn), p32(drawn, growth.low, growth.high)));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::FractureImport& command) {
    try {
        std::vector<Fracture> read =
            read_fractures(text_of(session, command.file), command.file, static_cast<FractureFormat>(command.format));
        session.program.output.say(fmt::format("fractures: {} read, {}", read.size(), sizes_text(read)));
        const std::string network = lower_case(command.network);
        for (Fracture& fracture : read) {
            given_to(fracture, command);
            add_fracture(session.deck.surface_sets, network, std::move(fracture));
        }
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::FractureExport& command) {
    try {
        const Network chosen = chosen_fractures(session.deck.surface_sets, command.choice, command.place);
        if (chosen.empty()) throw Diagnostic("there are no fractures to write", "fracture list shows all fractures");
        const auto format = static_cast<FractureFormat>(command.format);
        write_whole_file(session.program.output_file(command.file),
                         fractures_text(chosen, format, static_cast<int>(command.sides)));
        session.program.output.say(fmt::format("{} written to {}", counted(chosen.size(), "fracture"), command.file));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void add_handlers(HandlerTable& table, lang::FractureCommands list) { fill(table, list); }

} // namespace kaya
