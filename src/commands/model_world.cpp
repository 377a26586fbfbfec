#include "commands/model_world.hpp"

#include "base/diagnostic.hpp"
#include "model/nearest.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

using script::Handle;
using script::Value;

/// What belongs to each script table, in the order of ScriptTable.
struct TableEntry {
    std::string_view name;
    FieldTable fields;
    ObjectKind kind;
};
constexpr std::array<TableEntry, 8> entries{{
    {"block", FieldTable::block, ObjectKind::block},
    {"gridpoint", FieldTable::gridpoint, ObjectKind::gridpoint},
    {"zone", FieldTable::zone, ObjectKind::zone},
    {"face", FieldTable::face, ObjectKind::face},
    {"contact", FieldTable::contact, ObjectKind::contact},
    {"sub_contact", FieldTable::sub_contact, ObjectKind::sub_contact},
    {"corner", FieldTable::corner, ObjectKind::triangle}, // three rows for each triangle
    {"cable_node", FieldTable::cable_node, ObjectKind::cable_node},
}};

std::string_view name_of(std::int32_t table) { return entries[static_cast<std::size_t>(table)].name; }

ScriptTable script_table(FieldTable table) {
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].fields == table) return static_cast<ScriptTable>(i);
    throw std::logic_error("a link to a table that scripts do not see");
}

script::FieldInfo info_of(const Field& field) {
    return {field.name, field.classic, field.unit, field.help, field.set != nullptr};
}

FieldValue field_value(const Value& value, const Field& field) {
    if (const auto* truth = std::get_if<bool>(&value)) return std::int64_t{*truth};
    if (const auto* number = std::get_if<std::int64_t>(&value)) return *number;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
    throw Diagnostic(fmt::format("'{}' cannot take a value of this kind", field.name),
                     "give a number, a vector or a text", Fault::run);
}

void write(Model& model, const Field& field, Row row, const Value& value) {
    if (field.set == nullptr)
        throw Diagnostic(fmt::format("'{}' can be read but not written", field.name), {}, Fault::run);
    field.set(model, row, field_value(value, field));
}

/// The rows that `row` is listed with: a list of FISH ends with the block or contact it belongs to.
Span siblings(const Model& model, ScriptTable table, Row row) {
    switch (table) {
    case ScriptTable::gridpoint:
        return model.blocks.gridpoints[model.gridpoints.block[row]];
    case ScriptTable::zone:
        return model.blocks.zones[model.zones.block[row]];
    case ScriptTable::face:
        return model.blocks.faces[model.faces.block[row]];
    case ScriptTable::sub_contact:
        return model.contacts.sub_contacts[model.sub_contacts.contact[row]];
    case ScriptTable::corner: {
        const Span triangles = model.faces.triangles[model.triangles.face[row / 3]];
        return {3 * triangles.first, 3 * triangles.count};
    }
    case ScriptTable::cable_node:
        return model.structures.cables.nodes[model.structures.nodes.cable[row]];
    case ScriptTable::block:
    case ScriptTable::contact:
        break;
    }
    return {0, static_cast<Row>(row_count(model, entries[static_cast<std::size_t>(table)].fields))};
}

/// The block that a gridpoint, zone, face or corner belongs to.
Row block_of(const Model& model, ScriptTable table, Row row) {
    if (table == ScriptTable::gridpoint) return model.gridpoints.block[row];
    if (table == ScriptTable::zone) return model.zones.block[row];
    return model.faces.block[table == ScriptTable::face ? row : model.triangles.face[row / 3]];
}

/// The rows of a block in such a table.
Span rows_of_shape(const Model& model, ScriptTable table, Row block) {
    const auto& blocks = model.blocks;
    if (table == ScriptTable::gridpoint) return blocks.gridpoints[block];
    if (table == ScriptTable::zone) return blocks.zones[block];
    if (table == ScriptTable::face) return blocks.faces[block];
    return {3 * blocks.triangles[block].first, 3 * blocks.triangles[block].count};
}

/// Triangles of a face share corners; a list names each gridpoint once.
bool named_before(const Model& model, Row first, Row corner) {
    const auto gridpoint = [&](Row row) { return model.triangles.gridpoints[row / 3][row % 3]; };
    for (Row row = first; row < corner; ++row)
        if (gridpoint(row) == gridpoint(corner)) return true;
    return false;
}

} // namespace

ObjectKind object_kind(ScriptTable table) { return entries[static_cast<std::size_t>(table)].kind; }

ModelWorld::ModelWorld(Model& model, JointRegistry& joints, WorldHost& host) : model_(model), joints_(joints), host_(host), fields_(entries.size()) {
    for (const auto& entry : entries) infos_.push_back({entry.name, {}});
    for (const Field& field : fields()) {
        if (field.table == FieldTable::global) {
            global_infos_.push_back(info_of(field));
            global_fields_.push_back(&field);
            continue;
        }
        const auto table = static_cast<std::size_t>(script_table(field.table));
        infos_[table].fields.push_back(info_of(field));
        fields_[table].push_back(&field);
    }
}

Row ModelWorld::row_of(Handle object) const {
    if (object.generation == 0 || object.model != model_number) return no_row;
    const auto table = static_cast<ScriptTable>(object.table);
    switch (table) {
    case ScriptTable::block:
        return model_.blocks.ids.row({object.slot, object.generation});
    case ScriptTable::contact:
        return model_.contacts.ids.row({object.slot, object.generation});
    case ScriptTable::sub_contact:
        return model_.sub_contacts.ids.row({object.slot, object.generation});
    case ScriptTable::cable_node:
        return node_of_cable(model_, static_cast<std::int32_t>(object.slot), static_cast<Row>(object.generation) - 1);
    case ScriptTable::gridpoint:
    case ScriptTable::zone:
    case ScriptTable::face:
    case ScriptTable::corner:
        break;
    }
    const Row block = block_of_shape(object.slot);
    if (block == no_row) return no_row;
    const Span rows = rows_of_shape(model_, table, block);
    return object.generation <= static_cast<std::uint32_t>(rows.count) ? rows.first + static_cast<Row>(object.generation) - 1
                                                                       : no_row;
}

Row ModelWorld::block_of_shape(std::uint32_t shape) const {
    const auto& blocks = model_.blocks;
    // Blocks that are new since the last question stand at the end of their table; whatever else changes it says so.
    if (next_known_shape_ != model_.next_shape_number) {
        for (std::size_t b = blocks.size(); b-- > 0 && blocks.shape[b] >= next_known_shape_;)
            block_of_shape_[blocks.shape[b]] = static_cast<Row>(b);
        next_known_shape_ = model_.next_shape_number;
    }
    const auto found = block_of_shape_.find(static_cast<std::int32_t>(shape));
    if (found == block_of_shape_.end()) return no_row;
    const auto block = static_cast<std::size_t>(found->second);
    return block < blocks.size() && blocks.shape[block] == found->first ? found->second : no_row;
}

Row ModelWorld::living_row(Handle object) const {
    const Row row = row_of(object);
    if (row != no_row) return row;
    if (object.generation == 0)
        throw Diagnostic(fmt::format("this {} is null", name_of(object.table)),
                         "test it against 0 (FISH) or nil (Lua) before use", Fault::run);
    const auto table = static_cast<ScriptTable>(object.table);
    const bool lasting = table == ScriptTable::block || table == ScriptTable::contact || table == ScriptTable::sub_contact || table == ScriptTable::cable_node;
    throw Diagnostic(fmt::format("this {} no longer exists", name_of(object.table)),
                     object.model != model_number ? "it belonged to a model that was replaced since (new, restore); find it again"
                     : lasting ? "it was deleted; find another one"
                             : "its block was deleted, cut, zoned or taken out since it was found; find it again",
                     Fault::run);
}

Handle ModelWorld::handle(ScriptTable table, Row row) const {
    if (row == no_row) return {static_cast<std::int32_t>(table), 0, 0};
    const auto from = [&](auto id) {
        return Handle{static_cast<std::int32_t>(table), id.slot, id.generation, model_number};
    };
    switch (table) {
    case ScriptTable::block:
        return from(model_.blocks.id[row]);
    case ScriptTable::contact:
        return from(model_.contacts.id[row]);
    case ScriptTable::sub_contact:
        return from(model_.sub_contacts.id[row]);
    case ScriptTable::cable_node: {
        const Row cable = model_.structures.nodes.cable[row];
        return {static_cast<std::int32_t>(table), static_cast<std::uint32_t>(model_.structures.cables.number[cable]),
                static_cast<std::uint32_t>(row - model_.structures.cables.nodes[cable].first) + 1, model_number};
    }
    case ScriptTable::gridpoint:
    case ScriptTable::zone:
    case ScriptTable::face:
    case ScriptTable::corner:
        break;
    }
    const Row block = block_of(model_, table, row);
    return {static_cast<std::int32_t>(table), static_cast<std::uint32_t>(model_.blocks.shape[block]),
            static_cast<std::uint32_t>(row - rows_of_shape(model_, table, block).first) + 1, model_number};
}

Value ModelWorld::script_value(const FieldValue& value) const {
    switch (value.index()) {
    case 0:
        return *std::get_if<double>(&value);
    case 1:
        return *std::get_if<std::int64_t>(&value);
    case 2:
        return *std::get_if<Vec3>(&value);
    case 3:
        return *std::get_if<std::string>(&value);
    default:
        break;
    }
    const Link& link = *std::get_if<Link>(&value);
    return handle(script_table(link.table), link.row);
}

Value ModelWorld::get(Handle object, std::size_t field) {
    const Row row = living_row(object);
    return script_value(fields_[static_cast<std::size_t>(object.table)][field]->get(model_, row));
}

void ModelWorld::set(Handle object, std::size_t field, const Value& value) {
    const Row row = living_row(object);
    write(model_, *fields_[static_cast<std::size_t>(object.table)][field], row, value);
}

std::size_t ModelWorld::count(std::int32_t table) { return row_count(model_, entries[static_cast<std::size_t>(table)].fields); }

Handle ModelWorld::at(std::int32_t table, std::size_t index) {
    return handle(static_cast<ScriptTable>(table), index < count(table) ? static_cast<Row>(index) : no_row);
}

bool ModelWorld::alive(Handle object) { return row_of(object) != no_row; }

Handle ModelWorld::next(Handle object) {
    const auto table = static_cast<ScriptTable>(object.table);
    const Row row = living_row(object);
    const Span list = siblings(model_, table, row);
    Row after = row + 1;
    while (table == ScriptTable::corner && after < list.end() && named_before(model_, list.first, after)) ++after;
    return handle(table, after < list.end() ? after : no_row);
}

Handle ModelWorld::first_child(Handle parent, std::int32_t child_table) {
    const Row row = living_row(parent);
    const auto child = static_cast<ScriptTable>(child_table);
    const auto from = static_cast<ScriptTable>(parent.table);
    const auto first = [&](const Span& span) { return handle(child, span.count > 0 ? span.first : no_row); };
    if (from == ScriptTable::block && child == ScriptTable::gridpoint)
        return first(model_.blocks.gridpoints[row]);
    if (from == ScriptTable::block && child == ScriptTable::zone) return first(model_.blocks.zones[row]);
    if (from == ScriptTable::block && child == ScriptTable::face) return first(model_.blocks.faces[row]);
    if (from == ScriptTable::contact && child == ScriptTable::sub_contact)
        return first(model_.contacts.sub_contacts[row]);
    if (from == ScriptTable::face && child == ScriptTable::corner) {
        const Span triangles = model_.faces.triangles[row];
        return first({3 * triangles.first, 3 * triangles.count});
    }
    throw Diagnostic(fmt::format("a {} has no list of {}s", name_of(parent.table), name_of(child_table)), {},
                     Fault::run);
}

Handle ModelWorld::nearest(std::int32_t table, const Vec3& place) {
    const ObjectKind kind = entries[static_cast<std::size_t>(table)].kind;
    if (kind == ObjectKind::triangle)
        throw Diagnostic("corners of faces cannot be looked for", "look for the gridpoint", Fault::run);
    const Row best = nearest_row(model_, kind, place);
    if (best != no_row) {
        const double distance = distance_to(model_, kind, best, place);
        const Row block = block_of(model_, kind, best);
        const double size = block == no_row ? distance : block_size(model_, block);
        if (distance > size)
            host_.warn_once_here(Diagnostic(fmt::format("the nearest {} is {:.6g} away from ({:.6g}, {:.6g}, {:.6g}), and its block is {:.6g} across",
                                        name_of(table), distance, place[0], place[1], place[2], size),
                            "look at the place"));
    }
    return handle(static_cast<ScriptTable>(table), best);
}

Value ModelWorld::get_global(std::size_t index) {
    return script_value(global_fields_[index]->get(model_, 0));
}

void ModelWorld::set_global(std::size_t index, const Value& value) {
    write(model_, *global_fields_[index], 0, value);
}

double ModelWorld::reduce(std::int32_t table, std::size_t field, std::string_view how) {
    const Field& quantity = *fields_[static_cast<std::size_t>(table)][field];
    const auto rows = static_cast<Row>(count(table));
    const auto number = [&](Row row) {
        const FieldValue value = quantity.get(model_, row);
        if (const auto* real = std::get_if<double>(&value)) return *real;
        if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
        throw Diagnostic(fmt::format("'{}' is not a number that can be added up or compared", quantity.name),
                         "name one component", Fault::run);
    };
    double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (Row row = 0; row < rows; ++row) {
        const double value = number(row);
        sum += value;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (how == "sum") return sum;
    if (rows == 0)
        throw Diagnostic(fmt::format("there is no {} to take the {} of", name_of(table), how), {},
                         Fault::run);
    if (how == "min" || how == "minimum") return low;
    if (how == "max" || how == "maximum") return high;
    if (how == "mean" || how == "average") return sum / rows;
    throw Diagnostic(fmt::format("'{}' is not a way to reduce a field", how),
                     "use sum, mean, minimum or maximum", Fault::run);
}

std::optional<script::World::Samples> ModelWorld::history(const std::string& name) {
    const auto& all = model_.histories;
    const auto found = std::ranges::find_if(all.all, [&](const History& history) {
        return history.label == name || std::to_string(history.number) == name;
    });
    if (found == all.all.end()) return std::nullopt;
    return Samples{found->values, std::span(all.time).subspan(std::min(found->first_sample, all.time.size()))};
}

std::string ModelWorld::command(const std::string& text, const std::string& chunk, int line, bool caught) {
    return host_.run_text(text, chunk, line, caught);
}

} // namespace kaya
