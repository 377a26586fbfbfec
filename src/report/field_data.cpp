#include "report/field_data.hpp"

#include "model/measure/measure.hpp"
#include "base/json_text.hpp"
#include "report/packed.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace kaya {

namespace {

std::string stress_json(const Model& model, std::span<const Row> gridpoints, const char* name,
                        double (*of)(const Model&, Row)) {
    std::vector<double> sum(model.gridpoints.size()), weight(model.gridpoints.size());
    for (Row zone = 0; zone < static_cast<Row>(model.zones.size()); ++zone)
        for (const Row g : model.zones.gridpoints[zone]) {
            sum[g] += of(model, zone) * model.zones.volume[zone];
            weight[g] += model.zones.volume[zone];
        }
    std::vector<float> values;
    for (const Row g : gridpoints)
        values.push_back(weight[g] > 0 ? static_cast<float>(sum[g] / weight[g])
                                       : std::numeric_limits<float>::quiet_NaN());
    return numbers_json(name, "stress", "corner", values);
}

} // namespace

double length_of(const Model& model, const FieldValue& value) {
    if (const auto* v = std::get_if<Vec3>(&value)) return v->norm();
    if (const auto* d = std::get_if<double>(&value)) return *d;
    if (const auto* i = std::get_if<std::int64_t>(&value)) return static_cast<double>(*i);
    const auto* link = std::get_if<Link>(&value);
    const auto number = link == nullptr || link->kind != ObjectKind::block ? std::nullopt : object_number(model, *link);
    return number ? static_cast<double>(*number) : std::numeric_limits<double>::quiet_NaN();
}

std::string numbers_json(std::string_view title, std::string_view unit, std::string_view of,
                         const std::vector<float>& values) {
    return fmt::format(R"({{"name":{},"unit":{},"of":"{}","names":[],"values":"{}"}})", json_text(title),
                       json_text(unit), of, packed_rounded(values));
}

std::string names_json(std::string_view title, const std::vector<std::string>& texts) {
    std::vector<float> values;
    std::vector<std::string> names;
    for (const std::string& text : texts) {
        auto found = std::ranges::find(names, text);
        if (found == names.end()) found = names.insert(found, text);
        values.push_back(static_cast<float>(found - names.begin()));
    }
    std::ranges::transform(names, names.begin(), json_text);
    return fmt::format(R"({{"name":{},"unit":"-","of":"block","names":[{}],"values":"{}"}})", json_text(title),
                       fmt::join(names, ","), packed_rounded(values));
}

std::string field_json(const Model& model, const Field& field, const char* of, std::span<const Row> rows) {
    std::vector<float> values;
    std::vector<std::string> texts;
    for (const Row row : rows) {
        const FieldValue value = field.get(model, row);
        if (const auto* text = std::get_if<std::string>(&value)) texts.push_back(text->empty() ? "none" : *text);
        else values.push_back(static_cast<float>(length_of(model, value)));
    }
    if (!texts.empty()) return names_json(field.name, texts);
    return numbers_json(field.name, field.unit, of, values);
}

std::vector<std::string> corner_fields_json(const Model& model, std::span<const Row> gridpoints) {
    std::vector<std::string> fields;
    for (const char* name : {"displacement", "velocity", "z_displacement"})
        if (const Field* field = find_field(ObjectKind::gridpoint, name))
            fields.push_back(field_json(model, *field, "corner", gridpoints));
    if (model.zones.gridpoints.empty()) return fields;
    fields.push_back(stress_json(model, gridpoints, "greatest compression",
                                 [](const Model& m, Row zone) { return -principal_stresses(m, zone)[0]; }));
    fields.push_back(stress_json(model, gridpoints, "least compression",
                                 [](const Model& m, Row zone) { return -principal_stresses(m, zone)[2]; }));
    return fields;
}

} // namespace kaya
