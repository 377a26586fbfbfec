// fracture compute|list|intersections: what is measured on networks.
#include "commands/make/networks.hpp"
#include "commands/session/handlers.hpp"

#include "base/lower_case.hpp"
#include "geometry/fractures/traces.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

using Measure = lang::FractureMeasure::What;

/// The heading, a line for each of the first hundred, and how many more there are.
template <class Items, class Line>
std::string first_hundred(std::string text, const Items& items, const char* what, Line line) {
    constexpr std::size_t longest_table = 100;
    for (std::size_t i = 0; i < std::min(items.size(), longest_table); ++i) text += '\n' + line(items[i]);
    if (items.size() > longest_table) text += fmt::format("\n... and {} more {}", items.size() - longest_table, what);
    return text;
}

std::string list_of(const Network& fractures) {
    const std::string heading = fmt::format("{:>6} {:>12} {:>12} {:>12} {:>8} {:>8} {:>12} {:>9} {:>6} groups", "id",
                                            "x", "y", "z", "dip", "dd", "size", "dominance", "jset");
    return first_hundred(heading, fractures, "fractures", [](const Fracture& f) {
        const Vec3& x = f.disc.centre;
        return fmt::format("{:>6} {:>12.6g} {:>12.6g} {:>12.6g} {:>8.4g} {:>8.4g} {:>12.6g} {:>9} {:>6} {}", f.id,
                           x.x(), x.y(), x.z(), f.disc.dip, f.disc.dip_direction, f.disc.diameter, f.dominance,
                           f.joint_set, f.groups.empty() ? "-" : fmt::format("{}", fmt::join(f.groups, " ")));
    });
}

std::string list_of_intersections(const Network& fractures) {
    const std::string heading = fmt::format("{:>6} {:>6} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12}", "id", "id",
                                            "x1", "y1", "z1", "x2", "y2", "z2", "length");
    return first_hundred(heading, intersections_of(fractures), "intersections", [&](const Intersection& crossing) {
        const Segment& line = crossing.line;
        return fmt::format("{:>6} {:>6} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g}",
                           fractures[crossing.fractures[0]].id, fractures[crossing.fractures[1]].id, line.from.x(),
                           line.from.y(), line.from.z(), line.to.x(), line.to.y(), line.to.z(), line.length());
    });
}

std::string intersection_sums(const Network& fractures) {
    const auto intersections = intersections_of(fractures);
    double length = 0;
    for (const Intersection& crossing : intersections) length += crossing.line.length();
    const auto clusters = clusters_of(fractures.size(), intersections);
    return fmt::format("intersections = {}, length = {:.9g}, clusters = {}, fractures in the largest = {}",
                       intersections.size(), length, clusters.empty() ? 0 : 1 + *std::ranges::max_element(clusters),
                       std::ranges::count(clusters, std::size_t{0}));
}

std::string of_traces(const Session& session, const lang::FractureMeasure& command, const Network& fractures) {
    const auto& surfaces = session.deck.surface_sets.surfaces;
    const auto found = surfaces.find(lower_case(command.set));
    if (found == surfaces.end())
        throw Diagnostic(fmt::format("there is no set of surfaces named '{}'", command.set),
                         "make it before: geometry set 'name', geometry polygon create by-positions ...")
            .at(command.place);
    const TraceMeasures sums = trace_measures(found->second, fractures);
    if (!(sums.area > 0))
        throw Diagnostic(fmt::format("the set of surfaces '{}' has no area", command.set), "add polygons to it")
            .at(command.place);
    if (command.what == Measure::trace_area) return fmt::format("p21 = {:.9g}", sums.length / sums.area);
    if (command.what == Measure::trace_number)
        return fmt::format("p20 = {:.9g}", static_cast<double>(sums.centres) / sums.area);
    return fmt::format("average trace length = {:.9g}, of {}",
                       sums.number == 0 ? 0 : sums.length / static_cast<double>(sums.number), sums.number);
}

std::string in_box(const Session& session, const lang::FractureMeasure& command, const Network& fractures) {
    const Box box = box_given(session, command.box, "box", command.place);
    if (command.what == Measure::area) return fmt::format("p32 = {:.9g}", p32(fractures, box.low, box.high));
    if (command.what == Measure::percolation)
        return fmt::format("percolation = {:.9g}",
                           percolation(fractures, box.low, box.high, static_cast<AtSides>(command.option.value_or(0))));
    const auto inside = std::ranges::count_if(fractures, [&](const Fracture& f) {
        return (f.disc.centre - box.low).minCoeff() >= 0 && (box.high - f.disc.centre).minCoeff() >= 0;
    });
    return fmt::format("center density = {:.9g}", static_cast<double>(inside) / (box.high - box.low).prod());
}

std::string measured(const Session& session, const lang::FractureMeasure& command, const Network& fractures) {
    switch (command.what) {
    case Measure::list: return list_of(fractures);
    case Measure::intersections: return list_of_intersections(fractures);
    case Measure::intersection_sums: return intersection_sums(fractures);
    case Measure::crossings: return fmt::format("p10 = {:.9g}", p10(fractures, command.line[0], command.line[1]));
    case Measure::area:
    case Measure::percolation:
    case Measure::number: return in_box(session, command, fractures);
    case Measure::trace_length:
    case Measure::trace_area:
    case Measure::trace_number: return of_traces(session, command, fractures);
    }
    return {};
}

} // namespace

void run(Session& session, const lang::FractureMeasure& command) {
    const Network fractures = chosen_fractures(session.deck.surface_sets, command.choice, command.place);
    session.program.output.print(measured(session, command, fractures));
}

void add_handlers(HandlerTable& table, lang::FractureMeasureCommands list) { fill(table, list); }

} // namespace kaya
