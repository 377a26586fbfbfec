// list, print: quantities of the whole model.
#include "commands/session/save_session.hpp"
#include "commands/list/listing.hpp"
#include "commands/list/row_table.hpp"

#include "base/parallel.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/new_contacts.hpp"
#include "commands/session/materials.hpp"
#include "commands/monitors/progress.hpp"
#include "commands/run/time_step.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "model/measure/compatibility.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/measure.hpp"
#include "model/fields/sampling.hpp"
#include "model/measure/time_step_fraction.hpp"
#include "model/whole/state_hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace kaya {

namespace {

std::string given(double value) { return std::isnan(value) ? "-" : number_text(value); }

/// Largest of a quantity and where it is.
struct Extreme {
    std::string_view name, quantity;
    double value = 0;
    Vec3 place = Vec3::Zero();

    void consider(double candidate, const Vec3& where) {
        if (std::abs(candidate) <= std::abs(value)) return;
        value = candidate;
        place = where;
    }
};

/// One of the two normals of a plane: the one that points up; of a vertical plane the one that points east, or north.
bool points_up(const Vec3& normal) {
    const double flat = 1e-9 * normal.norm();
    if (std::abs(normal[2]) > flat) return normal[2] > 0;
    if (std::abs(normal[0]) > flat) return normal[0] > 0;
    return normal[1] > 0;
}

/// Dip and dip direction in degrees; the direction of a level plane is 0.
std::pair<double, double> dip_of_normal(const Vec3& normal) {
    constexpr double degrees = 180 / std::numbers::pi;
    const double across = std::hypot(normal[0], normal[1]);
    const double dip = std::atan2(across, normal[2]) * degrees;
    if (across <= 1e-9 * normal.norm()) return {0, 0};
    const double direction = std::atan2(normal[0], normal[1]) * degrees;
    return {dip, direction < 0 ? direction + 360 : direction};
}

} // namespace

std::string list_properties(Session& session, const lang::List& command) {
    using enum lang::List::Part;
    const bool of_blocks = command.part != joints, of_joints = command.part != blocks;
    std::vector<std::string> headings{of_blocks ? "mat" : "jmat"};
    if (of_blocks)
        for (const char* word : {"density", "bulk", "shear", "bcoh", "bfric", "bten", "bdil"})
            headings.emplace_back(word);
    if (of_joints) headings.emplace_back("joint");
    TextTable table(std::move(headings));
    for (const auto& [number, m] : session.engine.model.materials) {
        if (command.number.value_or(number) != number || (!of_blocks && m.joint.empty())) continue;
        std::vector<std::string> row{std::to_string(number)}, joint;
        if (of_blocks)
            row.insert(row.end(), {given(m.density), given(m.bulk), given(m.shear), number_text(m.cohesion),
                                   number_text(m.friction), number_text(m.tension), number_text(m.dilation)});
        for (const auto& [word, value] : m.joint) joint.push_back(fmt::format("{} {}", word, number_text(value)));
        if (of_joints) row.push_back(joint.empty() ? "-" : fmt::format("{}", fmt::join(joint, ", ")));
        table.add(std::move(row));
    }
    if (table.size() > 0) return table.text();
    return command.number ? fmt::format("no material {}", *command.number) : "no materials";
}

std::string list_joint_models(Session& session, const lang::List&) {
    std::string text;
    for (const auto& model : session.engine.joints.loaded()) {
        text += fmt::format("{} {}: {}\n", model->name, model->version, model->title);
        TextTable table({"  property", "also", "unit", "meaning"});
        for (const auto& p : model->properties)
            table.add({"  " + p.name, p.aliases.empty() ? "-" : fmt::format("{}", fmt::join(p.aliases, " ")), p.unit,
                       p.help});
        text += table.text() + "\n";
    }
    for (const Row row : property_sets_in_use(session.engine.model)) {
        const auto& set = session.engine.model.joint_properties[row];
        const JointModel* model = session.engine.joints.find(set.model);
        text += fmt::format("in use, jmat {}: {}", set.material, set.model);
        for (std::size_t i = 0; model != nullptr && i < set.values.size(); ++i)
            text += fmt::format(" {} {}", model->properties[i].name, given(set.values[i]));
        text += '\n';
    }
    return text.empty() ? "no joint model is loaded" : text;
}

std::string list_histories(Session& session, const lang::List& command) {
    const auto& histories = session.engine.model.histories;
    if (histories.all.empty()) return "no histories";
    TextTable table({"hist", "label", "quantity", "of", "at", "distance", "samples", "minimum", "maximum", "last"});
    for (const auto& h : histories.all) {
        if (command.number.value_or(h.number) != h.number) continue;
        const bool none = h.values.empty();
        const auto range =
            none ? std::pair<double, double>{} : std::pair{std::ranges::min(h.values), std::ranges::max(h.values)};
        const bool function = h.source.kind == HistorySource::Kind::function;
        const auto object = sampled_object(session.engine.model, h.source);
        const std::string kind = function ? "@" : h.source.rate ? "rate of " : "";
        table.add({std::to_string(h.number), h.label, kind + h.source.quantity, object ? object->name : "-",
                   object ? place_text(object->place) : "-", object ? number_text(object->distance) : "-",
                   std::to_string(h.values.size()), none ? "-" : number_text(range.first),
                   none ? "-" : number_text(range.second), none ? "-" : number_text(h.values.back())});
    }
    if (table.size() == 0) return fmt::format("no history {}", *command.number);
    return table.text() + (histories.interval == 1 ? std::string("\na sample every cycle")
                                                   : fmt::format("\na sample every {} cycles", histories.interval));
}

std::string list_time(Session& session, const lang::List&) {
    return fmt::format("time = {}\ncycle = {}", time_text(session.engine.model), session.engine.model.clock.cycle);
}

std::string list_unbalanced(Session& session, const lang::List&) {
    const auto& clock = session.engine.model.clock;
    return fmt::format("{} = {}\nratio: average {}, largest {}, local {}\ncycle = {}",
                       session.deck.units.heading("unbalanced force", "force"), number_text(clock.unbalanced_force),
                       number_text(clock.average_ratio), number_text(clock.maximum_ratio),
                       number_text(clock.local_ratio), clock.cycle);
}

std::string list_information(Session& session, const lang::List&) {
    find_joints(session);
    const auto& m = session.engine.model;
    TextTable table({"quantity", "value"});
    if (!session.deck.title.empty()) table.add({"title", session.deck.title});
    if (session.deck.units.given()) table.add({"units", session.deck.units.name()});
    table.add({"time", time_text(m)});
    const std::pair<const char*, std::size_t> counts[] = {
        {"cycle", static_cast<std::size_t>(m.clock.cycle)},
        {"blocks", m.blocks.size()},
        {"of them deformable",
         static_cast<std::size_t>(std::ranges::count_if(m.blocks.deformable, [](auto d) { return d != 0; }))},
        {"gridpoints", m.gridpoints.size()},
        {"zones", m.zones.size()},
        {"contacts", m.contacts.size()},
        {"sub-contacts", m.sub_contacts.size()},
        {"histories", m.histories.all.size()},
    };
    for (const auto& [name, count] : counts) table.add({name, std::to_string(count)});
    table.add({session.deck.units.heading("unbalanced force", "force"), number_text(m.clock.unbalanced_force)});
    return table.text();
}

std::string list_time_step(Session& session, const lang::List&) {
    session.engine.cycle->prepare();
    const std::string scaling = scaling_text(session.engine.model);
    std::string text = session.engine.cycle->time_step_report();
    for (const std::string& part : {scaling, added_mass_table(session.engine.model)})
        if (!part.empty()) text += "\n" + part;
    return text;
}

std::string list_extremes(Session& session, const lang::List&) {
    const auto& model = session.engine.model;
    Extreme displacement{"displacement", "length"}, velocity{"velocity", "velocity"},
        most_compressive{"most compressive stress", "stress"}, most_tensile{"most tensile stress", "stress"},
        shear{"joint shear displacement", "length"}, closure{"joint closure", "length"},
        opening{"joint opening", "length"};
    for (std::size_t row = 0; row < model.gridpoints.size(); ++row) {
        const auto& points = model.gridpoints;
        displacement.consider(points.displacement[row].norm(), points.position[row]);
        velocity.consider(gridpoint_velocity(model, static_cast<Row>(row)).norm(), points.position[row]);
    }
    for (Row row = 0; row < static_cast<Row>(model.zones.size()); ++row) {
        const Vec3 principal = principal_stresses(model, row), centroid = zone_centroid(model, row);
        most_compressive.consider(std::min(principal[0], 0.0), centroid);
        most_tensile.consider(std::max(principal[2], 0.0), centroid);
    }
    for (Row row = 0; row < static_cast<Row>(model.sub_contacts.size()); ++row) {
        const Vec3 place = shown_place(model, row);
        const double apart = shown_opening(model, row);
        shear.consider(model.sub_contacts.shear_displacement[row].norm(), place);
        closure.consider(std::min(apart, 0.0), place);
        opening.consider(std::max(apart, 0.0), place);
    }
    const auto along = [&](std::string_view axis) { return session.deck.units.heading(axis, "length"); };
    TextTable table({"largest", "value", along("x"), along("y"), along("z")});
    for (const Extreme* e : {&displacement, &velocity, &most_compressive, &most_tensile, &shear, &closure, &opening})
        table.add({session.deck.units.heading(e->name, e->quantity), number_text(e->value), number_text(e->place[0]),
                   number_text(e->place[1]), number_text(e->place[2])});
    return table.text() + fmt::format("\n{} = {}", session.deck.units.heading("unbalanced force", "force"),
                                      number_text(model.clock.unbalanced_force));
}

std::string list_energy(Session& session, const lang::List&) {
    const auto& e = session.engine.model.energy;
    TextTable table({"energy", session.deck.units.heading("value", "energy")});
    std::vector<std::pair<const char*, double>> rows{{"kinetic", e.kinetic},
                                                     {"kinetic at the start", e.start},
                                                     {"work of gravity", e.gravity},
                                                     {"work of the boundary", e.boundary},
                                                     {"damped", e.damped},
                                                     {"stored in joints", e.joint_stored()},
                                                     {"lost in slip and failure", e.joint_friction},
                                                     {"lost in contact updates", e.joint_lost},
                                                     {"work on zones", e.zone_work},
                                                     {"time-step changes", e.step_made},
                                                     {"residual", e.error()}};
    if (session.engine.model.structures.any())
        rows.insert(rows.end() - 2,
                    {session.engine.model.structures.members.empty() ? "work on cables" : "work on structures",
                     e.structure_work});
    for (const auto& [name, value] : rows) table.add({name, number_text(value)});
    return table.text();
}

std::string list_timing(Session& session, const lang::List&) {
    double total = 0;
    for (const auto& phase : session.engine.cycle->timing()) total += phase.seconds;
    TextTable table({"phase", "calls", "seconds", "share %"});
    for (const auto& phase : session.engine.cycle->timing())
        table.add({phase.phase, std::to_string(phase.calls), fmt::format("{:.3f}", phase.seconds),
                   fmt::format("{:.1f}", total > 0 ? 100 * phase.seconds / total : 0.0)});
    return table.text();
}

std::string list_hash(Session& session, const lang::List&) {
    const std::string of_model = fmt::format("hash = {:016x}", state_hash(session.engine.model));
    const auto of_scripts = script_hash(session);
    return of_scripts == 0 ? of_model : fmt::format("{}\nhash of scripts and ranges = {:016x}", of_model, of_scripts);
}

std::string list_tables(Session& session, const lang::List&) {
    const auto& tables = session.engine.scripts->tables();
    if (tables.empty()) return "no tables";
    TextTable rows({"table", "pairs", "first x", "last x", "least y", "greatest y"});
    for (const auto& [number, table] : tables) {
        const auto& points = table.points();
        if (points.empty()) {
            rows.add({std::to_string(number), "0", "-", "-", "-", "-"});
            continue;
        }
        const auto [least, greatest] = std::ranges::minmax_element(points, {}, &script::TablePoint::y);
        rows.add({std::to_string(number), std::to_string(points.size()), number_text(points.front().x),
                  number_text(points.back().x), number_text(least->y), number_text(greatest->y)});
    }
    return rows.text();
}

std::string list_ranges(Session& session, const lang::List&) {
    if (session.deck.ranges.empty()) return "no named ranges";
    TextTable table({"range", "elements"});
    for (const auto& [name, phrase] : session.deck.ranges) table.add({name, std::to_string(phrase.elements.size())});
    return table.text();
}

std::string list_symbols(Session& session, const lang::List&) {
    const auto symbols = session.engine.scripts->symbols();
    return symbols.empty() ? "no FISH variables or functions" : fmt::format("{}", fmt::join(symbols, "\n"));
}

std::string list_groups(Session& session, const lang::List&) {
    const auto& model = session.engine.model;
    if (model.group_names.size() < 2) return "no groups";
    TextTable table({"group", "blocks", "faces", "zones", "joints"});
    for (const std::string& group : all_groups(model)) {
        const GroupMembers members(model, group);
        std::vector<std::string> words{group};
        for (const auto* column : {&model.blocks.group, &model.faces.group, &model.zones.group, &model.contacts.group})
            words.push_back(
                std::to_string(std::ranges::count_if(*column, [&](auto number) { return members.contains(number); })));
        table.add(std::move(words));
    }
    return table.text();
}

std::string list_joint_sets(Session& session, const lang::List&) {
    find_joints(session);
    const auto& model = session.engine.model;
    struct JointSetSums {
        std::size_t faces = 0, contacts = 0;
        double area = 0;            ///< of contacts
        Vec3 normal = Vec3::Zero(); ///< mean of the upward normals of faces, weighted with area
    };
    std::map<std::int32_t, JointSetSums> sets;
    for (Row f = 0; f < static_cast<Row>(model.faces.size()); ++f) {
        auto& set = sets[model.faces.joint_set[f]];
        const Vec3 normal = face_area_vector(model, f);
        ++set.faces;
        set.normal += points_up(normal) ? normal : Vec3(-normal);
    }
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        auto& set = sets[model.contacts.joint_set[c]];
        ++set.contacts;
        set.area += model.contacts.area[c];
    }
    sets.erase(0);
    if (sets.empty()) return "no joint sets";
    TextTable table({"jset", "dip", "dd", "faces", "contacts", "area"});
    for (const auto& [number, set] : sets) {
        const auto [dip, direction] = dip_of_normal(set.normal);
        table.add({std::to_string(number), number_text(dip), number_text(direction), std::to_string(set.faces),
                   std::to_string(set.contacts), number_text(set.area)});
    }
    return table.text();
}

std::string list_memory(Session& session, const lang::List&) {
    constexpr double megabyte = 1 << 20;
    TextTable table({"table", "rows", "columns", "megabytes"});
    double total = 0;
    const auto add = [&](const char* name, std::size_t rows, std::size_t columns, double bytes) {
        total += bytes;
        if (rows > 0)
            table.add({name, std::to_string(rows), std::to_string(columns), fmt::format("{:.3f}", bytes / megabyte)});
    };
    session.engine.model.tables([&](const char* name, auto& rows) {
        double bytes = 0;
        std::size_t columns = 0;
        rows.columns([&](std::string_view, const auto& column, Role) {
            bytes += static_cast<double>(column.capacity() * sizeof(column[0]));
            ++columns;
        });
        add(name, rows.size(), columns, bytes);
    });
    return (table.size() > 0 ? table.text() + "\n" : "") +
           fmt::format("megabytes of all tables = {:.3f}", total / megabyte);
}

std::string list_version(Session&, const lang::List&) { return fmt::format("kaya {}", program_version()); }

namespace {

/// The damping of a model, a row for each number of it.
void add_damping(TextTable& table, const Settings& s) {
    static constexpr std::array dampings{"none", "local", "global", "combined", "rayleigh"};
    const std::string bodies = dampings[static_cast<std::size_t>(s.damping)];
    table.add({"damping", s.contact_damping == 0       ? bodies
                          : s.damping == Damping::none ? "dashpots of contacts only"
                                                       : bodies + " and dashpots of contacts"});
    table.add({"local factor", number_text(s.local_factor)});
    table.add({"rayleigh fraction", number_text(s.rayleigh_fraction)});
    table.add({"rayleigh frequency", number_text(s.rayleigh_frequency)});
    table.add({"rayleigh parts",
               fmt::format("{}{}", s.rayleigh_mass ? "mass " : "", s.rayleigh_stiffness ? "stiffness" : "")});
    table.add({"contact dashpots", number_text(s.contact_damping)});
}

} // namespace

std::string list_damping(Session& session, const lang::List&) {
    TextTable table({"setting", "value"});
    add_damping(table, session.engine.model.settings);
    return table.text();
}

std::string list_settings(Session& session, const lang::List&) {
    const auto& s = session.engine.model.settings;
    const auto yes = [](bool value) { return value ? "on" : "off"; };
    TextTable table({"setting", "value"});
    table.add({"gravity", fmt::format("{} {} {}", number_text(s.gravity[0]), number_text(s.gravity[1]),
                                      number_text(s.gravity[2]))});
    add_damping(table, s);
    table.add({"time step fraction", number_text(time_step_fraction(s))});
    table.add({"density scaling", s.mass_scaling == MassScaling::partial
                                      ? "for a step of " + number_text(s.scaled_time_step)
                                      : yes(s.mass_scaling == MassScaling::full)});
    table.add({"dynamic", yes(s.dynamic)});
    table.add({"large strain", yes(s.large_strain)});
    table.add({"compatibility", as_3dec(s) ? "3dec" : "none"});
    table.add({"jmat of new contacts", std::to_string(s.default_joint_material)});
    table.add({"jcons of new contacts", std::to_string(s.default_joint_constitutive)});
    table.add({"threads", std::to_string(threads())});
    return table.text();
}

} // namespace kaya
