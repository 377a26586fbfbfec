#include "commands/world/model_world.hpp"

#include "base/diagnostic.hpp"
#include "base/number_text.hpp"
#include "model/kinds/groups.hpp"
#include "model/kinds/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

using script::Handle;
using script::Value;

const KindInfo& kind_of(const Handle& object) { return info_of(static_cast<ObjectKind>(object.table)); }

script::FieldInfo script_info(const Field& field) {
    return {field.name, field.classic, field.unit, field.help, field.set != nullptr, field.modern};
}

FieldValue field_value(const Value& value, const Field& field) {
    if (const auto* truth = std::get_if<bool>(&value)) return std::int64_t{*truth};
    if (const auto* number = std::get_if<std::int64_t>(&value)) return *number;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
    throw Diagnostic(fmt::format("'{}' does not accept a value of this kind", field.name),
                     "give a number, a vector or a text", Fault::run);
}

void write(Model& model, const Field& field, Row row, const Value& value) {
    if (field.set == nullptr)
        throw Diagnostic(fmt::format("'{}' can be read but not written", field.name), {}, Fault::run);
    try {
        field.set(model, row, field_value(value, field));
    } catch (Diagnostic& mistake) { // of the value alone: which field it was for
        if (!mistake.message.starts_with("'")) mistake.message = fmt::format("'{}': {}", field.name, mistake.message);
        throw;
    }
}

/// A list of FISH ends with the object that it belongs to.
Row next_of(const Model& model, const Relation& list, Row row) {
    const Span rows = list.list(model, list.owner == nullptr ? 0 : list.owner(model, row));
    Row after = row + 1;
    while (list.skips != nullptr && after < rows.end() && list.skips(model, rows, after)) ++after;
    return after < rows.end() ? after : no_row;
}

} // namespace

ModelWorld::ModelWorld(Model& model, JointRegistry& joints, WorldHost& host)
    : model_(model), joints_(joints), host_(host) {
    for (const KindInfo& kind : kinds())
        if (kind.kind < end_of_script_kinds)
            infos_.push_back({kind.name, {}, kind.classic, kind.modern, kind.has_properties, kind.has_spares});
    fields_.resize(infos_.size());
    for (const Field& field : fields()) {
        if (field.kind == ObjectKind::global) {
            global_infos_.push_back(script_info(field));
            global_fields_.push_back(&field);
            continue;
        }
        const auto table = static_cast<std::size_t>(field.kind);
        infos_[table].fields.push_back(script_info(field));
        fields_[table].push_back(&field);
    }
    add_relations();
}

void ModelWorld::add_relations() {
    using Form = script::RelationInfo::Form;
    const auto add = [&](Form form, ObjectKind from, ObjectKind to, const Relation::Names& names,
                         const Relation* relation, std::string_view array = {}) {
        relation_infos_.push_back({form, script_table(from), script_table(to), names.classic, names.modern, array});
        relations_.push_back(relation);
    };
    for (const Relation& relation : kaya::relations()) {
        const Form form = relation.list != nullptr  ? Form::first
                          : relation.one != nullptr ? Form::other
                                                    : Form::numbered;
        add(form, relation.from, relation.to, relation.first, &relation, relation.array);
        if (!relation.next.classic.empty()) add(Form::next, relation.to, relation.to, relation.next, &relation);
    }
    // Corners of faces have the positions of gridpoints, which are searched instead.
    for (const auto& table : infos_)
        if (const auto kind = static_cast<ObjectKind>(&table - infos_.data()); kind != ObjectKind::corner)
            add(Form::nearest, ObjectKind::global, kind, {}, nullptr);
}

Row ModelWorld::row_of(const Handle& object) const {
    if (object.generation == 0 || object.model != model_number) return no_row;
    const KindInfo& kind = kind_of(object);
    if (kind.in_block == nullptr) return kind.find(model_, {object.slot, object.generation});
    const Row block = block_of_shape(object.slot);
    if (block == no_row) return no_row;
    const Span rows = kind.in_block(model_, block);
    return object.generation <= static_cast<std::uint32_t>(rows.count)
               ? rows.first + static_cast<Row>(object.generation) - 1
               : no_row;
}

Row ModelWorld::block_of_shape(std::uint32_t shape) const {
    const auto& blocks = model_.blocks;
    if (known_rows_ != model_.stale.rows_revision()) {
        block_of_shape_.clear();
        next_known_shape_ = 0;
        known_rows_ = model_.stale.rows_revision();
    }
    // If no rows have moved, blocks created since the last query are at the end of their table.
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

Row ModelWorld::living_row(const Handle& object) const {
    const Row row = row_of(object);
    if (row != no_row) return row;
    const KindInfo& kind = kind_of(object);
    if (object.generation == 0)
        throw Diagnostic(fmt::format("this {} is null", kind.name), "test it against 0 (FISH) or nil (Lua) before use",
                         Fault::run);
    throw Diagnostic(
        fmt::format("this {} no longer exists", kind.name),
        object.model != model_number ? "it belonged to a model that was replaced since (new, restore); find it again"
        : kind.in_block == nullptr   ? "it was deleted; find another one"
                                   : "its block was deleted, cut, zoned or taken out since it was found; find it again",
        Fault::run);
}

Handle ModelWorld::handle(ObjectKind kind, Row row) const {
    const std::int32_t table = script_table(kind);
    if (row == no_row) return {table, 0, 0};
    const KindInfo& info = info_of(kind);
    if (info.in_block == nullptr) {
        const Identity identity = info.identity(model_, row);
        return {table, identity.slot, identity.generation, model_number};
    }
    const Row block = info.block(model_, row);
    return {table, static_cast<std::uint32_t>(model_.blocks.shape[block]),
            static_cast<std::uint32_t>(row - info.in_block(model_, block).first) + 1, model_number};
}

Value ModelWorld::script_value(const FieldValue& value) const {
    switch (value.index()) {
    case 0: return *std::get_if<double>(&value);
    case 1: return *std::get_if<std::int64_t>(&value);
    case 2: return *std::get_if<Vec3>(&value);
    case 3: return *std::get_if<std::string>(&value);
    default: break;
    }
    const Link& link = *std::get_if<Link>(&value);
    return handle(link.kind, link.row);
}

Value ModelWorld::get(const Handle& object, std::size_t field) {
    if (object.table == whole_model.table) return script_value(global_fields_[field]->get(model_, 0));
    const Row row = living_row(object);
    return script_value(fields_[static_cast<std::size_t>(object.table)][field]->get(model_, row));
}

void ModelWorld::set(const Handle& object, std::size_t field, const Value& value) {
    if (object.table == whole_model.table) return write(model_, *global_fields_[field], 0, value);
    const Row row = living_row(object);
    write(model_, *fields_[static_cast<std::size_t>(object.table)][field], row, value);
}

bool ModelWorld::in_group(const Handle& object, const std::string& group) {
    const Row row = living_row(object);
    const auto kind = static_cast<ObjectKind>(object.table);
    const GroupMembers members(model_, group);
    if (members.contains(group_of(model_, kind, row))) return true;
    if (kind == ObjectKind::contact) return false;
    if (kind == ObjectKind::sub_contact)
        return members.contains(model_.contacts.group[model_.sub_contacts.contact[row]]);
    const Row block = block_of(model_, kind, row);
    return block != no_row && members.contains(model_.blocks.group[block]);
}

Handle ModelWorld::at(std::int32_t table, std::size_t index) {
    return handle(static_cast<ObjectKind>(table), index < count(table) ? static_cast<Row>(index) : no_row);
}

Handle ModelWorld::relate(std::size_t number, const Handle& object, const At& at) {
    using Form = script::RelationInfo::Form;
    const auto& info = relation_infos_[number];
    const auto to = static_cast<ObjectKind>(info.to);
    if (info.form == Form::nearest) return nearest(to, std::get<Vec3>(at));
    const Relation& relation = *relations_[number];
    const Row row = info.from == whole_model.table ? 0 : living_row(object);
    if (info.form == Form::next) return handle(to, next_of(model_, relation, row));
    if (info.form == Form::other) return handle(to, relation.one(model_, row));
    if (info.form == Form::first) {
        const Span rows = relation.list(model_, row);
        return handle(to, rows.count > 0 ? rows.first : no_row);
    }
    const auto rows = relation.numbered(model_, row);
    const std::size_t index = std::get<std::size_t>(at);
    if (index >= rows.size())
        throw Diagnostic(fmt::format("it has {} 1 to {}, not {}", info_of(to).plural, rows.size(), index + 1), {},
                         Fault::run);
    return handle(to, rows[index]);
}

Handle ModelWorld::nearest(ObjectKind kind, const Vec3& place) {
    const Row best = nearest_row(model_, kind, place);
    if (best != no_row) {
        const double distance = distance_to(model_, kind, best, place);
        const Row block = block_of(model_, kind, best);
        const double size = block == no_row ? distance : block_size(model_, block);
        if (distance > size)
            host_.warn_once_here(
                Diagnostic(fmt::format("the nearest {} is {:.6g} away from {}, and its block is {:.6g} across",
                                       info_of(kind).name, distance, place_text(place), size),
                           "look at the place"));
    }
    return handle(kind, best);
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
        throw Diagnostic(
            fmt::format("there is no {} to take the {} of", info_of(static_cast<ObjectKind>(table)).name, how), {},
            Fault::run);
    if (how == "min" || how == "minimum") return low;
    if (how == "max" || how == "maximum") return high;
    if (how == "mean" || how == "average") return sum / rows;
    throw Diagnostic(fmt::format("'{}' is not a reduction of a field", how), "use sum, mean, minimum or maximum",
                     Fault::run);
}

std::optional<script::World::Samples> ModelWorld::history(const std::string& name) {
    const auto& all = model_.histories;
    auto found = std::ranges::find(all.all, name, &History::label);
    if (found == all.all.end()) // a label that is the number of another history comes first
        found = std::ranges::find_if(all.all,
                                     [&](const History& history) { return std::to_string(history.number) == name; });
    if (found == all.all.end()) return std::nullopt;
    return Samples{found->values, std::span(all.time).subspan(std::min(found->first_sample, all.time.size()))};
}

std::string ModelWorld::command(const std::string& text, const std::string& chunk, int line, bool caught) {
    return host_.run_text(text, chunk, line, caught);
}

} // namespace kaya
