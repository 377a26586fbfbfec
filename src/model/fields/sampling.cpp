#include "model/fields/sampling.hpp"

#include "base/diagnostic.hpp"
#include "model/fields/field.hpp"
#include "model/kinds/nearest.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/structure_rows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

using Kind = HistorySource::Kind;

bool has_place(Kind kind) { return kind != Kind::global && kind != Kind::function; }

/// The present row of the source's object; no_row when it was deleted.
Row present_row(const Model& model, const HistorySource& source) {
    if (source.kind == Kind::cable_node)
        return node_of_cable(model, static_cast<std::int32_t>(source.slot), source.offset);
    const auto in_block = info_of(source.kind).in_block;
    if (in_block == nullptr) return info_of(source.kind).find(model, {source.slot, source.generation});
    const Row block = model.blocks.ids.row({source.slot, source.generation});
    if (block == no_row) return no_row;
    const Span span = in_block(model, block);
    if (span.count != source.rows_of_block || source.offset >= span.count) return no_row;
    return span.first + source.offset;
}

double sample(const Model& model, const Field& field, Row row) {
    const FieldValue value = field.get(model, row);
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    throw Diagnostic(fmt::format("'{}' is not a number and cannot be recorded", field.name),
                     "name one of its components");
}

/// A sub-contact's own value has the name that it has in files for ParaView. Only the joint models can read it: it is requested as
/// "jmodel_NAME of ROW".
constexpr std::string_view own_beginning = "jmodel_";

bool is_own_value(const HistorySource& source) {
    return source.kind == Kind::sub_contact && source.quantity.starts_with(own_beginning);
}

/// Rates need their quantity in every cycle.
bool any_rate(const Histories& histories) {
    return std::ranges::any_of(histories.all, [](const History& history) { return history.source.rate; });
}

bool is_due(const Model& model) { return model.clock.cycle % model.histories.interval == 0; }

/// Joints that are open in part have moved their sub-contacts: a history has the values of the place where its own was.
bool has_moved(const Model& model, const HistorySource& source, Row row) {
    return source.kind == Kind::sub_contact && has_left_place(model, row);
}

Vec3 place_of(const Model& model, const HistorySource& source, Row row) {
    return has_moved(model, source, row) ? place_on_faces(model, row) : info_of(source.kind).place(model, row);
}

double value_of(const Model& model, const HistorySource& source, const Field& field) {
    if (!has_moved(model, source, source.row)) return sample(model, field, source.row);
    return source.quantity == "normal_displacement" ? opening_on_faces(model, source.row)
                                                    : sample(model, field, row_at_place(model, source.row));
}

} // namespace

const Field* sampled_field(const HistorySource& source) {
    if (source.kind == Kind::function || is_own_value(source)) return nullptr;
    const Field* field = find_field(source.kind, source.quantity);
    if (!field) {
        std::vector<std::string_view> names;
        for (const auto& candidate : fields())
            if (candidate.kind == source.kind) names.push_back(candidate.name);
        const auto near = did_you_mean(source.quantity, names);
        throw Diagnostic(fmt::format("'{}' is not a quantity of {}", source.quantity,
                                     has_place(source.kind) ? info_of(source.kind).missing : "the whole model"),
                         near.empty() ? std::string() : fmt::format("did you mean '{}'?", near));
    }
    return field;
}

std::string unit_of(const HistorySource& source) {
    constexpr std::string_view per_time = "/time";
    const Field* field = sampled_field(source);
    if (field == nullptr) return "-";
    const std::string unit(field->unit);
    if (!source.rate) return unit;
    return unit.ends_with(per_time) ? unit + "^2" : unit + std::string(per_time);
}

void locate(const Model& model, HistorySource& source) {
    if (!has_place(source.kind)) return;
    const KindInfo& info = info_of(source.kind);
    const auto rows = select(model, info.kind, {}, true);
    if (rows.empty()) throw Diagnostic(fmt::format("there are no {} for a history", info.missing), info.remedy);

    double nearest = std::numeric_limits<double>::infinity();
    source.row = rows.front();
    for (const Row row : rows) {
        const double distance = (place_of(model, source, row) - source.place).squaredNorm();
        if (distance < nearest) {
            nearest = distance;
            source.row = row;
        }
    }
    if (source.kind == Kind::cable_node) {
        const Row cable = model.structures.cable_nodes.cable[source.row];
        source.slot = static_cast<std::uint32_t>(model.structures.cables.number[cable]);
        source.generation = 1;
        source.offset = source.row - model.structures.cables.nodes[cable].first;
        return;
    }
    const Row owner = info.in_block == nullptr ? source.row : info.block(model, source.row);
    const Identity identity = info_of(info.in_block == nullptr ? info.kind : Kind::block).identity(model, owner);
    source.slot = identity.slot;
    source.generation = identity.generation;
    if (info.in_block == nullptr) return;
    const Span span = info.in_block(model, owner);
    source.offset = source.row - span.first;
    source.rows_of_block = span.count;
}

std::optional<SampledObject> sampled_object(const Model& model, const HistorySource& source) {
    if (!has_place(source.kind)) return std::nullopt;
    const Row row = present_row(model, source);
    if (row == no_row) return std::nullopt;
    const KindInfo& info = info_of(source.kind);
    SampledObject object;
    object.name = fmt::format("{} {}", info.noun, info.number(model, row));
    object.place = place_of(model, source, row);
    object.distance = (object.place - source.place).norm();
    const Row block = info.block(model, row);
    object.far = block != no_row && distance_to(model, info.kind, row, source.place) > block_size(model, block);
    return object;
}

History& add_history(Model& model, HistorySource source, std::string label) {
    const Field* field = sampled_field(source);
    locate(model, source);
    if (field) source.last = value_of(model, source, *field); // a text or a vector is refused now, not while cycling
    History history;
    const auto& all = model.histories.all;
    history.number = all.empty() ? 1 : all.back().number + 1;
    history.label = label.empty() ? source.quantity : std::move(label);
    history.source = std::move(source);
    history.first_sample = model.histories.time.size();
    return model.histories.all.emplace_back(std::move(history));
}

bool samples_zones(const Model& model) {
    return std::ranges::any_of(model.histories.all, [due = is_due(model)](const History& history) {
        return history.source.kind == Kind::zone && (due || history.source.rate);
    });
}

void sample_histories(Model& model, double kick, const std::function<double(const std::string&)>& script_value) {
    auto& histories = model.histories;
    const bool due = is_due(model);
    if (histories.all.empty() || (!due && !any_rate(histories))) return;
    // Values first, then all of them at once: a function of the deck may throw.
    std::vector<double> values;
    values.reserve(histories.all.size());
    for (auto& history : histories.all) {
        auto& source = history.source;
        if (source.kind == Kind::function) {
            if (!due) continue;
            if (!script_value)
                throw Diagnostic(
                    fmt::format("history {} records '{}', but no script is loaded", history.number, source.quantity),
                    "define the function before cycling");
            values.push_back(script_value(source.quantity));
            continue;
        }
        if (!due && !source.rate) continue;
        const Field* field = sampled_field(source);
        if (has_place(source.kind)) {
            source.row = present_row(model, source);
            if (source.row == no_row && count_of(model, source.kind) > 0) locate(model, source);
            if (source.row == no_row) { // none of the kind is left: the run continues
                values.push_back(std::numeric_limits<double>::quiet_NaN());
                continue;
            }
        }
        if (field == nullptr) {
            const Row row = has_moved(model, source, source.row) ? row_at_place(model, source.row) : source.row;
            values.push_back(script_value ? script_value(fmt::format("{} of {}", source.quantity, row))
                                          : std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        const double value = value_of(model, source, *field);
        values.push_back(source.rate ? (value - source.last) / kick : value);
        source.last = value;
    }
    if (!due) return;
    for (std::size_t k = 0; k < values.size(); ++k) histories.all[k].values.push_back(values[k]);
    histories.time.push_back(model.clock.time);
    histories.cycle.push_back(model.clock.cycle);
}

void reset_histories(Histories& histories) {
    for (auto& history : histories.all) {
        history.values.clear();
        history.first_sample = 0;
    }
    histories.time.clear();
    histories.cycle.clear();
}

} // namespace kaya
