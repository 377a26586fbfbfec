#include "report/tables.hpp"

#include "base/counted.hpp"
#include "base/markup_text.hpp"
#include "base/number_text.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/overlap_rows.hpp"
#include "model/whole/state_hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace kaya {

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Names on the left, values on the right.
std::string pair_table(const Pairs& pairs) {
    std::string html = "<table>\n";
    for (const auto& [name, value] : pairs)
        html += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", markup_text(name), markup_text(value));
    return html + "</table>\n";
}

/// A head and rows of cells.
std::string grid_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
    if (rows.empty()) return "<p>None.</p>\n";
    std::string html = "<table>\n<tr>";
    for (const auto& cell : head) html += "<th>" + markup_text(cell) + "</th>";
    html += "</tr>\n";
    for (const auto& row : rows) {
        html += "<tr>";
        for (const auto& cell : row) html += "<td>" + markup_text(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

/// 1 for a regular tetrahedron, 0 for a flat one: 6 sqrt(2) volume over the cube of its root mean square edge.
double shape_of(const Model& model, Row zone) {
    const auto& g = model.zones.gridpoints[zone];
    double squares = 0;
    for (int i = 0; i < 4; ++i)
        for (int k = i + 1; k < 4; ++k)
            squares += (model.gridpoints.position[g[i]] - model.gridpoints.position[g[k]]).squaredNorm();
    return 6 * std::sqrt(2.0) * zone_volume(model, zone) / std::pow(squares / 6, 1.5);
}

} // namespace

std::string run_table(Model& model, const SaveExtras& extras, const ReportOrder& order) {
    std::string decks;
    for (const auto& deck : extras.decks) decks += (decks.empty() ? "" : ", ") + deck.name;
    Pairs pairs{{order.source, order.file},
                {"written by", "kaya " + extras.program_version},
                {"report by", "kaya " + order.version},
                {"decks", decks}};
    if (!order.took.empty()) pairs.emplace_back("took", order.took);
    if (!extras.title.empty()) pairs.insert(pairs.begin(), {"title", extras.title});
    if (const Units units = units_of(extras); units.given()) pairs.emplace_back("units", units.name());
    const auto& clock = model.clock;
    pairs.insert(pairs.end(),
                 {{"cycles", fmt::format("{}", clock.cycle)},
                  {"time", fmt::format("{:.6g}{}", clock.time,
                                       model.settings.mass_scaling == MassScaling::none ? "" : " (density is scaled)")},
                  {"time step", number(clock.time_step)},
                  {"unbalanced force", number(clock.unbalanced_force)},
                  {"average ratio of forces", number(clock.average_ratio)},
                  {"gravity", coordinates_text(model.settings.gravity)},
                  {"state hash", fmt::format("{:016x}", state_hash(model))}});
    return pair_table(pairs);
}

std::string block_table(const Model& model) {
    const auto& blocks = model.blocks;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& p : model.gridpoints.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    double volume = 0;
    Row least = no_row, most = no_row;
    std::size_t deformable = 0, hidden = 0;
    for (Row b = 0; b < static_cast<Row>(blocks.size()); ++b) {
        volume += blocks.volume[b];
        deformable += blocks.deformable[b] != 0, hidden += blocks.hidden[b] != 0;
        if (least == no_row || blocks.volume[b] < blocks.volume[least]) least = b;
        if (most == no_row || blocks.volume[b] > blocks.volume[most]) most = b;
    }
    if (least == no_row) return "<p>There are no blocks.</p>\n";
    const auto of = [&](Row b) {
        return fmt::format("{:.6g} (block {} at {})", blocks.volume[b], blocks.number[b],
                           coordinates_text(block_centroid(model, b)));
    };
    return pair_table({{"blocks", fmt::format("{}, of them {} deformable{}", blocks.size(), deformable,
                                              hidden > 0 ? fmt::format(", {} hidden", hidden) : "")},
                       {"excavated", fmt::format("{}", model.excavated.blocks.size())},
                       {"gridpoints", fmt::format("{}", model.gridpoints.size())},
                       {"faces", fmt::format("{}", model.faces.size())},
                       {"from", coordinates_text(low)},
                       {"to", coordinates_text(high)},
                       {"volume", number(volume)},
                       {"smallest block", of(least)},
                       {"largest block", of(most)}});
}

std::string group_table(const Model& model) {
    std::map<std::int32_t, std::pair<std::size_t, double>> groups; // of the default slot, in order of their first use
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        auto& [count, volume] = groups[default_group_number(model, model.blocks.group[b])];
        ++count, volume += model.blocks.volume[b];
    }
    std::vector<std::vector<std::string>> rows;
    for (const auto& [group, what] : groups) {
        const std::string_view name = default_group(model, group);
        rows.push_back({name.empty() ? "none" : std::string(name), fmt::format("{}", what.first), number(what.second)});
    }
    return grid_table({"group", "blocks", "volume"}, rows);
}

std::string zone_table(const Model& model) {
    const auto zones = static_cast<Row>(model.zones.size());
    if (zones == 0) return {};
    std::vector<double> shapes;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    Row worst = 0;
    for (Row zone = 0; zone < zones; ++zone) {
        shapes.push_back(shape_of(model, zone));
        if (shapes.back() < shapes[static_cast<std::size_t>(worst)]) worst = zone;
        const double volume = zone_volume(model, zone);
        least = std::min(least, volume), most = std::max(most, volume);
    }
    const double bad = shapes[static_cast<std::size_t>(worst)];
    std::ranges::nth_element(shapes, shapes.begin() + zones / 20);
    std::size_t yielded = 0;
    for (const auto state : model.zones.state) yielded += state != 0;
    std::map<std::string, std::size_t> models;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const auto& law = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[b])].model;
        models[law.empty() ? "by constitutive number" : law] += static_cast<std::size_t>(model.blocks.zones[b].count);
    }
    std::string laws;
    for (const auto& [name, count] : models)
        if (count > 0) laws += fmt::format("{}{} ({})", laws.empty() ? "" : ", ", name, count);
    return "<h3>Zones</h3>\n" +
           pair_table(
               {{"zones", fmt::format("{}", zones)},
                {"zone models", laws},
                {"smallest and largest volume", fmt::format("{:.6g} to {:.6g}", least, most)},
                {"shape (1 is a regular tetrahedron)", fmt::format("worst {:.3f} in block {}, 5 % are below {:.3f}",
                                                                   bad, model.blocks.number[model.zones.block[worst]],
                                                                   shapes[static_cast<std::size_t>(zones / 20)])},
                {"zones with a state", fmt::format("{}", yielded)}});
}

std::string material_table(const Model& model) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [material, m] : model.materials) {
        std::string zone;
        for (const auto& [name, value] : m.zone)
            zone += fmt::format("{}{} {:.6g}", zone.empty() ? "" : ", ", name, value);
        rows.push_back({fmt::format("{}", material), number(m.density), number(m.bulk), number(m.shear), zone});
    }
    return grid_table({"material", "density", "bulk modulus", "shear modulus", "of zone models"}, rows);
}

std::string joint_table(const Model& model, const ReportOrder& order) {
    std::map<Row, std::size_t> used;
    for (const Row row : model.contacts.properties)
        if (row != no_row) ++used[row];
    std::vector<std::vector<std::string>> rows;
    for (const auto& [row, contacts] : used) {
        const auto& set = model.joint_properties[static_cast<std::size_t>(row)];
        const auto names = order.law_names ? order.law_names(set.model).properties : std::vector<std::string>{};
        std::string values;
        for (std::size_t k = 0; k < set.values.size(); ++k)
            values += fmt::format("{}{}{:.6g}", values.empty() ? "" : ", ", k < names.size() ? names[k] + " " : "",
                                  set.values[k]);
        rows.push_back({set.model, fmt::format("{}", set.material), fmt::format("{}", contacts), values, set.place});
    }
    return grid_table({"joint model", "material", "contacts", "properties", "given in"}, rows);
}

std::string contact_table(const Model& model) {
    const auto& sub = model.sub_contacts;
    double area = 0, open = 0, normal = 0, shear = 0, slip = 0, opening = 0;
    std::size_t slipping = 0;
    for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c) {
        area += common_area(model, c);
        open += idle_area(model, c);
    }
    for (std::size_t i = 0; i < sub.size(); ++i) {
        normal += sub.normal_force[i];
        const Vec3 force = sub.shear_force[i], moved = sub.shear_displacement[i];
        shear += force.norm();
        slip = std::max(slip, moved.norm());
        opening = std::max(opening, shown_opening(model, static_cast<Row>(i)));
        slipping += sub.state[i] != 0;
    }
    return pair_table({{"contacts", fmt::format("{}, with {} sub-contacts", model.contacts.size(), sub.size())},
                       {"area", number(area)},
                       {"part of it that carries nothing", area > 0 ? fmt::format("{:.2f} %", 100 * open / area) : ""},
                       {"sum of normal forces", number(normal)},
                       {"sum of shear forces", number(shear)},
                       {"largest shear displacement", number(slip)},
                       {"largest opening", number(opening)},
                       {"sub-contacts with a state", fmt::format("{}", slipping)}});
}

std::string boundary_table(const Model& model) {
    std::size_t blocks = 0, points = 0, rollers = 0, loaded = 0;
    Vec3 load = Vec3::Zero();
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        blocks += !model.blocks.deformable[b] &&
                  (model.blocks.fixed[b] != 0 || model.gridpoints.roller[model.blocks.gridpoints[b].first] != 0);
        load += block_load(model, static_cast<Row>(b));
    }
    for (std::size_t g = 0; g < model.gridpoints.size(); ++g) {
        if (!model.blocks.deformable[static_cast<std::size_t>(model.gridpoints.block[g])]) continue;
        points += model.gridpoints.fixed[g] != 0;
        rollers += model.gridpoints.roller[g] != 0;
        loaded += !model.gridpoints.load[g].isZero();
    }
    return pair_table({{"rigid blocks with prescribed velocities", fmt::format("{}", blocks)},
                       {"gridpoints with prescribed velocities", fmt::format("{}", points)},
                       {"gridpoints on rollers", fmt::format("{}", rollers)},
                       {"loaded gridpoints of deformable blocks", fmt::format("{}", loaded)},
                       {"sum of applied forces", coordinates_text(load)},
                       {"conditions that change with time", fmt::format("{}", model.boundary_histories.size())}});
}

std::string energy_table(const Model& model) {
    const auto& e = model.energy;
    return grid_table({"energy", "force times length"}, {{"kinetic, when the account was opened", number(e.start)},
                                                         {"work of gravity", number(e.gravity)},
                                                         {"work of the boundary", number(e.boundary)},
                                                         {"kinetic, now", number(e.kinetic)},
                                                         {"stored in joints", number(e.joint_stored())},
                                                         {"lost in joints by slip", number(e.joint_friction)},
                                                         {"lost in contact updates", number(e.joint_lost)},
                                                         {"work on zones", number(e.zone_work)},
                                                         {"taken out by damping", number(e.damped)},
                                                         {"residual", number(e.error())}});
}

} // namespace kaya
