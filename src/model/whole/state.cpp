#include "model/whole/state.hpp"

#include "model/kinds/kinds.hpp"

#include <utility>

namespace kaya {

namespace {

// The members of each struct are listed by structured binding: a member that is added to the struct and not here does not compile. Lambdas
// name the struct, since clang 14 captures no bindings.

void visit_state(Archive& archive, Settings& settings) {
    auto& [gravity, damping, local_factor, global_ratio, rayleigh_fraction, rayleigh_frequency, rayleigh_mass,
           rayleigh_stiffness, strength_factor, mixed_discretisation, contact_damping, time_step_fraction,
           given_time_step, mass_scaling, scaled_time_step, water, water_value, water_origin, water_direction, dynamic,
           large_strain, energy, triangular_outer_faces, default_joint_material, default_joint_constitutive,
           default_properties] = settings;
    archive.value("gravity", gravity);
    archive.value("damping", damping);
    archive.value("local_factor", local_factor);
    archive.value("global_ratio", global_ratio);
    archive.value("rayleigh_fraction", rayleigh_fraction);
    archive.value("rayleigh_frequency", rayleigh_frequency);
    archive.value("rayleigh_mass", rayleigh_mass);
    archive.value("rayleigh_stiffness", rayleigh_stiffness);
    archive.value("strength_factor", strength_factor);
    archive.value("mixed_discretisation", mixed_discretisation);
    archive.value("contact_damping", contact_damping);
    archive.value("time_step_fraction", time_step_fraction);
    archive.value("given_time_step", given_time_step);
    archive.value("mass_scaling", mass_scaling);
    archive.value("scaled_time_step", scaled_time_step);
    archive.value("water", water);
    archive.value("water_value", water_value);
    archive.value("water_origin", water_origin);
    archive.value("water_direction", water_direction);
    archive.value("dynamic", dynamic);
    archive.value("large_strain", large_strain);
    archive.value("energy", energy);
    archive.value("triangular_outer_faces", triangular_outer_faces);
    archive.value("default_joint_material", default_joint_material);
    archive.value("default_joint_constitutive", default_joint_constitutive);
    archive.value("default_properties", default_properties);
}

void visit_state(Archive& archive, Clock& clock) {
    auto& [time, cycle, time_step, last_step, global_viscosity, unbalanced_force, average_ratio, maximum_ratio,
           local_ratio, factor_of_safety, peak_load, peak_displacement] = clock;
    archive.value("time", time);
    archive.value("cycle", cycle);
    archive.value("time_step", time_step);
    archive.value("last_step", last_step);
    archive.value("global_viscosity", global_viscosity);
    archive.value("unbalanced_force", unbalanced_force);
    archive.value("average_ratio", average_ratio);
    archive.value("maximum_ratio", maximum_ratio);
    archive.value("local_ratio", local_ratio);
    archive.aside([&] {
        archive.value("factor_of_safety", clock.factor_of_safety);
        archive.value("peak_load", clock.peak_load);
        archive.value("peak_displacement", clock.peak_displacement);
    });
}

void visit_state(Archive& archive, Energy& energy) {
    auto& [kinetic, start, gravity, boundary, damped, joint_work, joint_friction, joint_lost, zone_work, structure_work,
           step_made, inner_power, lag] = energy;
    archive.value("kinetic", kinetic);
    archive.value("start", start);
    archive.value("gravity", gravity);
    archive.value("boundary", boundary);
    archive.value("damped", damped);
    archive.value("joint_work", joint_work);
    archive.value("joint_friction", joint_friction);
    archive.value("joint_lost", joint_lost);
    archive.value("zone_work", zone_work);
    archive.value("structure_work", structure_work);
    archive.value("step_made", step_made);
    archive.value("inner_power", inner_power);
    archive.value("behind", lag);
}

/// Maps go through the walk as records of key and value.
template <class Key, class Value, class Function>
void visit_map(Archive& archive, const char* name, std::map<Key, Value>& map, const Function& visit) {
    std::vector<std::pair<Key, Value>> pairs(map.begin(), map.end());
    archive.records(name, pairs, [&](std::pair<Key, Value>& pair) { visit(pair.first, pair.second); });
    map = std::map<Key, Value>(pairs.begin(), pairs.end());
}

void visit_state(Archive& archive, Material& material) {
    auto& [density, bulk, shear, young, poisson, cohesion, friction, tension, dilation, joint, zone] = material;
    archive.value("density", density);
    archive.value("bulk", bulk);
    archive.value("shear", shear);
    archive.value("young", young);
    archive.value("poisson", poisson);
    archive.value("cohesion", cohesion);
    archive.value("friction", friction);
    archive.value("tension", tension);
    archive.value("dilation", dilation);
    visit_map(archive, "joint", joint, [&](std::string& word, double& number) {
        archive.text("word", word);
        archive.value("value", number);
    });
    visit_map(archive, "zone", zone, [&](std::string& word, double& number) {
        archive.text("word", word);
        archive.value("value", number);
    });
}

void visit_state(Archive& archive, ZoneProperties& properties) {
    auto& [model, values, place] = properties;
    archive.text("model", model);
    visit_map(archive, "values", values, [&](std::string& word, double& number) {
        archive.text("word", word);
        archive.value("value", number);
    });
    archive.aside([&] { archive.text("place", properties.place); });
}

void visit_state(Archive& archive, StructureProperties& properties) {
    auto& [area, young, density, grout_stiffness, grout_cohesion, grout_friction, grout_perimeter, yield_tension,
           yield_compression, rupture_strain, poisson, moment_of_area_y, moment_of_area_z, torsion_constant,
           plastic_moment_y, plastic_moment_z, thickness, link_normal, link_shear, link_cohesion, link_friction,
           link_tension] = properties;
    archive.value("area", area);
    archive.value("young", young);
    archive.value("density", density);
    archive.value("grout_stiffness", grout_stiffness);
    archive.value("grout_cohesion", grout_cohesion);
    archive.value("grout_friction", grout_friction);
    archive.value("grout_perimeter", grout_perimeter);
    archive.value("yield_tension", yield_tension);
    archive.value("yield_compression", yield_compression);
    archive.value("rupture_strain", rupture_strain);
    archive.value("poisson", poisson);
    archive.value("moment_of_area_y", moment_of_area_y);
    archive.value("moment_of_area_z", moment_of_area_z);
    archive.value("torsion_constant", torsion_constant);
    archive.value("plastic_moment_y", plastic_moment_y);
    archive.value("plastic_moment_z", plastic_moment_z);
    archive.value("thickness", thickness);
    archive.value("link_normal", link_normal);
    archive.value("link_shear", link_shear);
    archive.value("link_cohesion", link_cohesion);
    archive.value("link_friction", link_friction);
    archive.value("link_tension", link_tension);
}

void visit_state(Archive& archive, JointProperties& properties) {
    auto& [model, material, values, place] = properties;
    archive.text("model", model);
    archive.value("material", material);
    archive.list("values", values);
    archive.aside([&] { archive.text("place", properties.place); });
}

void visit_state(Archive& archive, TimeFunction& function) {
    auto& [kind, frequency, duration, table, script, place] = function;
    archive.value("kind", kind);
    archive.value("frequency", frequency);
    archive.value("duration", duration);
    archive.value("table", table);
    archive.text("script", script);
    archive.aside([&] { archive.text("place", function.place); });
}

void visit_state(Archive& archive, HistorySource& source) {
    auto& [kind, quantity, place, row, slot, generation, offset, rows_of_block, rate, last] = source;
    std::int32_t number = kind == ObjectKind::none ? -1 : info_of(kind).history;
    archive.value("kind", number);
    kind = recorded_kind(number);
    archive.text("quantity", quantity);
    archive.value("place", place);
    archive.value("row", row);
    archive.value("slot", slot);
    archive.value("generation", generation);
    archive.value("offset", offset);
    archive.value("rows_of_block", rows_of_block);
    archive.value("rate", rate);
    archive.value("last", last);
}

void visit_state(Archive& archive, History& history) {
    auto& [number, label, source, values, first_sample] = history;
    archive.value("number", number);
    archive.text("label", label);
    visit_state(archive, source);
    archive.list("values", values);
    archive.value("first_sample", first_sample);
}

void visit_state(Archive& archive, Histories& histories) {
    auto& [all, time, cycle, interval] = histories;
    archive.list("time", time);
    archive.list("cycle", cycle);
    archive.value("interval", interval);
    archive.records("all", all, [&](History& history) { visit_state(archive, history); });
}

template <class Tag> void visit_ids(Archive& archive, IdMap<Tag>& ids) {
    Column<Row> rows;
    Column<std::uint32_t> generations;
    for (const auto& slot : ids.slots()) {
        rows.push_back(slot.row);
        generations.push_back(slot.generation);
    }
    archive.section("ids", [&] {
        archive.list("rows", rows);
        archive.list("generations", generations);
        archive.list("free", ids.free_slots());
    });
    // Columns of different lengths: the check of the whole model reports the longer one.
    const std::size_t count = std::max(rows.size(), generations.size());
    rows.resize(count, no_row);
    generations.resize(count, 0);
    ids.slots().resize(count);
    for (std::size_t k = 0; k < count; ++k) ids.slots()[k] = {rows[k], generations[k]};
}

template <class T> void visit_column(ColumnArchive& archive, std::string_view name, Column<T>& column) {
    archive.column(name, column, new_value<T>());
}

/// Attachment has a gap between its rows and its weights; it goes as two columns.
void visit_column(ColumnArchive& archive, std::string_view name, Column<Attachment>& column) {
    Column<std::array<Row, 3>> gridpoints(column.size());
    Column<std::array<double, 3>> weights(column.size());
    for (std::size_t i = 0; i < column.size(); ++i) {
        gridpoints[i] = column[i].gridpoints;
        weights[i] = column[i].weights;
    }
    archive.column(std::string(name) + "_gridpoints", gridpoints, Attachment().gridpoints);
    archive.column(std::string(name) + "_weights", weights, Attachment().weights);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = {gridpoints[i], weights[i]};
}

/// Objects have no plain bytes; visit_objects takes what they save.
void visit_column(ColumnArchive&, std::string_view, Column<JointObject>&) {}

/// Objects of joint models: one size per row, and all bytes in order. A restoring archive leaves them unloaded, since their
/// joint models are loaded later.
void visit_objects(Archive& archive, Column<JointObject>& objects) {
    Column<std::uint64_t> sizes;
    Column<std::uint8_t> bytes;
    for (const auto& object : objects) {
        const std::string saved = object.bytes();
        sizes.push_back(saved.size());
        bytes.insert(bytes.end(), saved.begin(), saved.end());
    }
    const auto sizes_before = sizes;
    const auto bytes_before = bytes;
    archive.section("objects", [&] {
        archive.list("sizes", sizes);
        archive.list("bytes", bytes);
    });
    if (sizes == sizes_before && bytes == bytes_before) return;
    std::size_t first = 0;
    objects.assign(sizes.size(), JointObject());
    for (std::size_t row = 0; row < sizes.size(); ++row) {
        const std::size_t count = std::min<std::size_t>(sizes[row], bytes.size() - first);
        if (count > 0) objects[row] = JointObject::asleep({reinterpret_cast<const char*>(bytes.data()) + first, count});
        first += count;
    }
}

template <class T> void visit_columns(ColumnArchive& archive, T& table) {
    table.columns([&](std::string_view name, auto& column, Role) { visit_column(archive, name, column); });
}

template <class T> void visit_table(Archive& archive, const char* name, T& table) {
    struct Rows final : TableRows {
        explicit Rows(T& visited) : table(visited) {}
        std::size_t size() const override { return table.size(); }
        void resize(std::size_t count) override { table.resize(count); }
        void columns(ColumnArchive& seen) override { visit_columns(seen, table); }
        T& table;
    } rows(table);
    archive.section(name, [&] {
        if constexpr (requires { table.history_columns; }) { archive.value("history_columns", table.history_columns); }
        if constexpr (requires { table.keeps_dashpots; }) // not hashed: the column itself is
            archive.aside([&] {
                archive.value("keeps_dashpots", table.keeps_dashpots);
                archive.value("keeps_warps", table.keeps_warps);
                archive.value("keeps_warp_dashpots", table.keeps_warp_dashpots);
                archive.value("keeps_initial", table.keeps_initial);
                archive.value("keeps_layers", table.keeps_layers);
            });
        if constexpr (requires { table.keeps_load_arms; })
            archive.aside([&] { archive.value("keeps_load_arms", table.keeps_load_arms); });
        if constexpr (requires { table.keeps_objects; }) archive.value("keeps_objects", table.keeps_objects);
        if constexpr (requires { table.field_columns; }) archive.value("field_columns", table.field_columns);
        archive.rows(rows);
        visit_columns(archive, table);
        if constexpr (requires { table.keeps_objects; })
            if (table.keeps_objects) visit_objects(archive, table.object);
        if constexpr (requires { table.ids; }) visit_ids(archive, table.ids);
    });
}

} // namespace

void visit_state(Archive& archive, Model& model) {
    auto& [blocks, gridpoints, faces, triangles, zones, contacts, sub_contacts, tied_pairs, ties, boundary_histories,
           placed_loads, excavated, structures, materials, joint_properties, joint_rules, zone_properties,
           joint_constitutive, group_names, time_functions, rollers, water_ground, settings, clock, energy, histories,
           next_block_number, next_shape_number, next_contact_number, next_sub_contact_number, ruled_contacts, stale,
           unreduced, forces_set, taken_over] = model;
    // The tables named above appear here only to be counted: Model::tables() is their list.
    model.tables([&](const char* name, auto& table) { visit_table(archive, name, table); });

    model.structure_tables([&](const char* name, auto& table) { visit_table(archive, name, table); });
    visit_map(archive, "cable_properties", structures.properties,
              [&](std::int32_t& number, StructureProperties& properties) {
                  archive.value("number", number);
                  visit_state(archive, properties);
              });
    archive.value("next_cable_number", structures.next_number);

    visit_map(archive, "materials", materials, [&](std::int32_t& number, Material& material) {
        archive.value("number", number);
        visit_state(archive, material);
    });
    archive.records("joint_properties", joint_properties,
                    [&](JointProperties& properties) { visit_state(archive, properties); });
    archive.records("joint_rules", joint_rules, [&](JointRule& rule) {
        archive.text("range", rule.range);
        archive.value("properties", rule.properties);
    });
    archive.value("ruled_contacts", ruled_contacts);
    archive.records("zone_properties", zone_properties,
                    [&](ZoneProperties& properties) { visit_state(archive, properties); });
    visit_map(archive, "joint_constitutive", joint_constitutive, [&](std::int32_t& number, std::string& name) {
        archive.value("number", number);
        archive.text("model", name);
    });
    archive.records("group_names", group_names, [&](std::string& name) { archive.text("name", name); });
    Column<Vec3> places(water_ground.corners());
    Column<std::array<int, 3>> sides(water_ground.triangles());
    archive.section("water_ground", [&] {
        archive.list("corners", places);
        archive.list("triangles", sides);
    });
    if (places != water_ground.corners() || sides != water_ground.triangles())
        water_ground = Ground::restored(std::move(places), std::move(sides));
    archive.records("time_functions", time_functions, [&](TimeFunction& function) { visit_state(archive, function); });
    archive.records("rollers", rollers, [&](Roller& roller) {
        auto& [count, direction, speed] = roller;
        archive.value("count", count);
        archive.value("direction_1", direction[0]);
        archive.value("direction_2", direction[1]);
        archive.value("direction_3", direction[2]);
        archive.value("speed", speed);
    });
    archive.section("settings", [&] { visit_state(archive, model.settings); });
    archive.section("clock", [&] { visit_state(archive, model.clock); });
    archive.section("energy", [&] { visit_state(archive, model.energy); });
    archive.section("histories", [&] { visit_state(archive, model.histories); });
    archive.value("next_block_number", next_block_number);
    archive.value("next_shape_number", next_shape_number);
    archive.value("next_contact_number", next_contact_number);
    archive.value("next_sub_contact_number", next_sub_contact_number);
    archive.aside([&] { model.stale.visit(archive); });
}

} // namespace kaya
