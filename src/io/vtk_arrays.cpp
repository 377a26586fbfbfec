#include "io/vtk_arrays.hpp"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

namespace kaya {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// x_velocity next to velocity, x next to position, xx_stress next to stress.
bool is_component(const Field& field) {
    const std::string_view name = field.name;
    const auto has = [&](const std::string& whole) {
        const Field* found = find_field(field.kind, whole);
        return found != nullptr && found != &field;
    };
    if (name == "x" || name == "y" || name == "z") return true;
    if (name.size() > 2 && name[1] == '_' && (name[0] == 'x' || name[0] == 'y' || name[0] == 'z')) {
        const std::string rest(name.substr(2));
        return has(rest) || has(rest + "_vector");
    }
    return field.kind == ObjectKind::zone && name.size() == 9 && name.ends_with("_stress");
}

/// Objects by the numbers that users see.
std::int64_t whole_of(const Model& model, const FieldValue& value) {
    if (const auto* link = std::get_if<Link>(&value)) return object_number(model, *link).value_or(-1);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
    return -1;
}

double real_of(const FieldValue& value) {
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return none;
}

/// One array of any type, filled row by row.
template <class Array, class Put> void add_array(vtkFieldData* target, const std::string& name, const Field& field,
                                                 int components, std::span<const Row> rows, Put&& put) {
    vtkNew<Array> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) put(array.Get(), static_cast<vtkIdType>(i), rows[i]);
    set_unit(array, field.unit);
    target->AddArray(array);
}

void add_texts(vtkFieldData* target, vtkFieldData* whole, const Model& model, const std::string& name,
               const Field& field, std::span<const Row> rows) {
    std::vector<std::string> names;
    std::map<std::string, int> places;
    add_array<vtkIntArray>(target, name, field, 1, rows, [&](vtkIntArray* array, vtkIdType i, Row row) {
        if (row == no_row) return array->SetValue(i, -1);
        const auto [place, is_new] =
            places.try_emplace(std::get<std::string>(field.get(model, row)), static_cast<int>(names.size()));
        if (is_new) names.push_back(place->first);
        array->SetValue(i, place->second);
    });
    vtkNew<vtkStringArray> list;
    list->SetName((name + "_names").c_str());
    for (const auto& text : names) list->InsertNextValue(text);
    whole->AddArray(list);
}

void add_field(vtkFieldData* target, vtkFieldData* whole, const Model& model, const std::string& name,
               const Field& field, std::span<const Row> rows, const FieldValue& sample) {
    if (std::holds_alternative<std::string>(sample)) return add_texts(target, whole, model, name, field, rows);
    if (std::holds_alternative<Vec3>(sample))
        return add_array<vtkDoubleArray>(
            target, name, field, 3, rows, [&](vtkDoubleArray* array, vtkIdType i, Row row) {
                const Vec3 vector = row == no_row ? Vec3::Constant(none) : std::get<Vec3>(field.get(model, row));
                array->SetTuple(i, vector.data());
            });
    if (std::holds_alternative<double>(sample))
        return add_array<vtkDoubleArray>(target, name, field, 1, rows,
                                         [&](vtkDoubleArray* array, vtkIdType i, Row row) {
                                             array->SetValue(i, row == no_row ? none : real_of(field.get(model, row)));
                                         });
    add_array<vtkTypeInt64Array>(target, name, field, 1, rows, [&](vtkTypeInt64Array* array, vtkIdType i, Row row) {
        array->SetValue(i, row == no_row ? -1 : whole_of(model, field.get(model, row)));
    });
}

} // namespace

void set_unit(vtkDataArray* array, std::string_view unit) {
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), std::string(unit).c_str());
}

void add_fields(vtkFieldData* target, vtkFieldData* whole, const Model& model, ObjectKind table,
                std::span<const Row> rows, std::string_view prefix) {
    const auto first = std::ranges::find_if(rows, [](Row row) { return row != no_row; });
    if (first == rows.end()) return; // nothing tells what its values would be
    for (const Field& field : fields()) {
        if (field.kind != table || is_component(field)) continue;
        const std::string name = fmt::format("{}{}", prefix, field.name);
        if (target->HasArray(name.c_str())) continue;
        add_field(target, whole, model, name, field, rows, field.get(model, *first));
    }
}

void add_own_values(vtkFieldData* target, const Model& model, const OwnValues& own, std::span<const Row> rows) {
    std::set<std::string> names;
    for (const auto& properties : model.joint_properties)
        if (const auto found = own.find(properties.model); found != own.end())
            for (const auto& [name, value] : found->second) names.insert(name);
    for (const auto& name : names) {
        vtkNew<vtkDoubleArray> array;
        array->SetName(("jmodel_" + name).c_str());
        for (const Row row : rows) {
            const Row set = row == no_row ? no_row
                                          : model.contacts.properties[static_cast<std::size_t>(
                                                model.sub_contacts.contact[static_cast<std::size_t>(row)])];
            const auto joint =
                set == no_row ? own.end() : own.find(model.joint_properties[static_cast<std::size_t>(set)].model);
            const bool known = joint != own.end() && joint->second.contains(name);
            array->InsertNextValue(known ? joint->second.at(name)(model, row) : none);
        }
        target->AddArray(array);
    }
}

} // namespace kaya
