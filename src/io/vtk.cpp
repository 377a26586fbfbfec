#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "io/whole_file.hpp"
#include "model/field.hpp"
#include "model/measure.hpp"

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <limits>
#include <optional>

namespace kaya {

namespace {

/// An array of one number per row; the type of array follows from the type of number.
template <class Array, class Value>
void add_numbers(vtkFieldData* target, const char* name, std::size_t rows, Value&& value) {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
    for (std::size_t row = 0; row < rows; ++row) array->SetValue(static_cast<vtkIdType>(row), value(row));
    target->AddArray(array);
}

template <class Value>
void add_vectors(vtkFieldData* target, const char* name, std::size_t rows, Value&& value) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
    for (std::size_t row = 0; row < rows; ++row) {
        const Vec3 vector = value(row);
        array->SetTuple(static_cast<vtkIdType>(row), vector.data());
    }
    target->AddArray(array);
}

void add_names(vtkFieldData* target, const char* name, const std::vector<std::string>& names) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const auto& text : names) array->InsertNextValue(text);
    target->AddArray(array);
}

void add_time(vtkUnstructuredGrid* grid, const Clock& clock) {
    add_numbers<vtkDoubleArray>(grid->GetFieldData(), "time", 1, [&](std::size_t) { return clock.time; });
    add_numbers<vtkTypeInt64Array>(grid->GetFieldData(), "cycle", 1, [&](std::size_t) { return clock.cycle; });
}

/// The polygon around a face: the edges that only one of its triangles has, in order. None when they do
/// not make one simple loop.
std::optional<std::vector<vtkIdType>> outline(const Model& model, Row face) {
    std::map<Row, Row> next;
    std::vector<std::pair<Row, Row>> edges;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& corner = model.triangles.gridpoints[t];
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(corner[k], corner[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges) {
        if (std::binary_search(edges.begin(), edges.end(), std::pair(to, from))) continue;
        if (!next.emplace(from, to).second) return std::nullopt;
    }
    if (next.empty()) return std::nullopt;
    std::vector<vtkIdType> loop;
    Row at = next.begin()->first;
    do {
        loop.push_back(at);
        const auto edge = next.find(at);
        if (edge == next.end() || loop.size() > next.size()) return std::nullopt;
        at = edge->second;
    } while (at != next.begin()->first);
    if (loop.size() != next.size()) return std::nullopt;
    return loop;
}

/// One polyhedron: its faces as polygons where they are, else as triangles.
void insert_rigid_block(vtkUnstructuredGrid* grid, const Model& model, Row block) {
    vtkNew<vtkIdList> stream; // number of faces, then for each face its number of points and the points
    vtkIdType faces = 0;
    stream->InsertNextId(0);
    const auto add_face = [&](const auto& corners) {
        stream->InsertNextId(static_cast<vtkIdType>(corners.size()));
        for (const auto corner : corners) stream->InsertNextId(corner);
        ++faces;
    };
    const Span span = model.blocks.faces[block];
    for (Row face = span.first; face < span.end(); ++face) {
        if (const auto polygon = outline(model, face)) {
            add_face(*polygon);
            continue;
        }
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) add_face(model.triangles.gridpoints[t]);
    }
    stream->SetId(0, faces);
    grid->InsertNextCell(VTK_POLYHEDRON, stream);
}

/// VTK's order of a symmetric tensor is xx yy zz xy yz xz, ours xx yy zz xy xz yz.
void add_stress(vtkUnstructuredGrid* grid, const Model& model, const std::vector<Row>& zone_of_cell) {
    static constexpr std::array<const char*, 6> names{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    static constexpr std::array<int, 6> component{0, 1, 2, 3, 5, 4};
    vtkNew<vtkDoubleArray> array;
    array->SetName("stress");
    array->SetNumberOfComponents(6);
    for (int k = 0; k < 6; ++k) array->SetComponentName(k, names[static_cast<std::size_t>(k)]);
    array->SetNumberOfTuples(static_cast<vtkIdType>(zone_of_cell.size()));
    for (std::size_t cell = 0; cell < zone_of_cell.size(); ++cell)
        for (int k = 0; k < 6; ++k) {
            const Row zone = zone_of_cell[cell];
            const double value = zone == no_row ? 0 : model.zones.stress[zone][component[static_cast<std::size_t>(k)]];
            array->SetComponent(static_cast<vtkIdType>(cell), k, value);
        }
    grid->GetCellData()->AddArray(array);
}

std::string bytes_of(vtkUnstructuredGrid* grid) {
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(grid);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    if (!writer->Write()) throw Diagnostic("the VTK file cannot be made", {}, Fault::own);
    return writer->GetOutputString();
}

std::string xml_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

/// `stem` is the name of the files before _N.vtu, without a folder: they stand beside the series.
std::string series_text(const std::string& stem, const std::vector<double>& times) {
    std::string text = "<?xml version=\"1.0\"?>\n"
                       "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                       "  <Collection>\n";
    for (std::size_t number = 0; number < times.size(); ++number)
        text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}_{}.vtu\"/>\n", times[number],
                            xml_text(stem), number);
    return text + "  </Collection>\n</VTKFile>\n";
}

} // namespace

std::string vtk_blocks(const Model& model) {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const auto& gridpoints = model.gridpoints;
    for (const auto& position : gridpoints.position) points->InsertNextPoint(position.data());
    grid->SetPoints(points);
    grid->Allocate(static_cast<vtkIdType>(model.zones.size() + model.blocks.size()));

    std::vector<Row> block_of_cell, zone_of_cell;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        const Span zones = model.blocks.zones[block];
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            const auto& corner = model.zones.gridpoints[zone];
            const std::array<vtkIdType, 4> ids{corner[0], corner[1], corner[2], corner[3]};
            grid->InsertNextCell(VTK_TETRA, 4, ids.data());
            block_of_cell.push_back(block);
            zone_of_cell.push_back(zone);
        }
        if (zones.count > 0) continue;
        insert_rigid_block(grid, model, block);
        block_of_cell.push_back(block);
        zone_of_cell.push_back(no_row);
    }

    vtkPointData* at_points = grid->GetPointData();
    add_vectors(at_points, "displacement", gridpoints.size(), [&](std::size_t i) { return gridpoints.displacement[i]; });
    add_vectors(at_points, "velocity", gridpoints.size(), [&](std::size_t i) { return gridpoint_velocity(model, static_cast<Row>(i)); });

    const auto add_block_numbers = [&](const char* name, const auto& column) {
        add_numbers<vtkIntArray>(grid->GetCellData(), name, block_of_cell.size(),
                                 [&](std::size_t cell) { return column[block_of_cell[cell]]; });
    };
    add_block_numbers("block_id", model.blocks.number);
    add_block_numbers("region", model.blocks.region);
    add_block_numbers("group", model.blocks.group);
    add_block_numbers("material", model.blocks.material);
    add_block_numbers("deformable", model.blocks.deformable);
    add_stress(grid, model, zone_of_cell);
    add_time(grid, model.clock);
    add_names(grid->GetFieldData(), "group_names", model.group_names);
    return bytes_of(grid);
}

namespace {

/// What joint models remember of each sub-contact, by the names of the variables.
void add_history(vtkCellData* data, const Model& model, const HistoryNames& history) {
    const auto& sub = model.sub_contacts;
    std::set<std::string> names;
    for (const auto& properties : model.joint_properties)
        if (const auto found = history.find(properties.model); found != history.end())
            names.insert(found->second.begin(), found->second.end());
    for (const auto& name : names)
        add_numbers<vtkDoubleArray>(data, ("jmodel_" + name).c_str(), sub.size(), [&](std::size_t i) {
            const Row set = model.contacts.properties[static_cast<std::size_t>(sub.contact[i])];
            const auto found = set == no_row ? history.end() : history.find(model.joint_properties[static_cast<std::size_t>(set)].model);
            if (found == history.end()) return std::numeric_limits<double>::quiet_NaN();
            const auto column = std::find(found->second.begin(), found->second.end(), name) - found->second.begin();
            const bool kept = column < static_cast<std::ptrdiff_t>(found->second.size()) && column < sub.history_columns;
            return kept ? sub.history[static_cast<std::size_t>(column)][i] : std::numeric_limits<double>::quiet_NaN();
        });
}

} // namespace

std::string vtk_joints(const Model& model, const HistoryNames& history) {
    const auto& sub = model.sub_contacts;
    const auto& contacts = model.contacts;
    const std::size_t rows = sub.size();

    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->Allocate(static_cast<vtkIdType>(rows));
    for (std::size_t i = 0; i < rows; ++i) {
        const Vec3 position = sub.position[i];
        const vtkIdType point = points->InsertNextPoint(position.data());
        grid->InsertNextCell(VTK_VERTEX, 1, &point);
    }
    grid->SetPoints(points);

    std::vector<std::string> model_names;
    for (const auto& properties : model.joint_properties)
        if (std::find(model_names.begin(), model_names.end(), properties.model) == model_names.end())
            model_names.push_back(properties.model);
    const auto model_index = [&](Row properties) {
        if (properties == no_row) return -1;
        const auto& name = model.joint_properties[static_cast<std::size_t>(properties)].model;
        return static_cast<int>(std::find(model_names.begin(), model_names.end(), name) - model_names.begin());
    };

    vtkCellData* data = grid->GetCellData();
    const auto add_field = [&](const char* name, const char* field_name) {
        const Field* field = find_field(FieldTable::sub_contact, field_name);
        add_numbers<vtkDoubleArray>(
            data, name, rows, [&](std::size_t i) { return std::get<double>(field->get(model, static_cast<Row>(i))); });
    };
    const auto add_whole = [&](const char* name, auto&& value) { add_numbers<vtkIntArray>(data, name, rows, value); };
    const auto contact = [&](std::size_t i) { return static_cast<std::size_t>(sub.contact[i]); };

    add_field("force_normal", "normal_force");
    add_vectors(data, "force_shear", rows, [&](std::size_t i) { return sub.shear_force[i]; });
    add_field("stress_normal", "normal_stress");
    add_field("stress_shear", "shear_stress");
    add_field("disp_normal", "normal_displacement");
    add_vectors(data, "disp_shear", rows, [&](std::size_t i) { return sub.shear_displacement[i]; });
    add_vectors(data, "normal", rows, [&](std::size_t i) { return contacts.normal[contact(i)]; });
    add_field("area", "area");
    add_numbers<vtkUnsignedIntArray>(data, "state", rows, [&](std::size_t i) { return sub.state[i]; });
    add_whole("joint_set", [&](std::size_t i) { return contacts.joint_set[contact(i)]; });
    add_whole("contact_id", [&](std::size_t i) { return contacts.number[contact(i)]; });
    add_whole("subcontact_id", [&](std::size_t i) { return sub.number[i]; });
    add_whole("block1", [&](std::size_t i) { return model.blocks.number[contacts.block1[contact(i)]]; });
    add_whole("block2", [&](std::size_t i) { return model.blocks.number[contacts.block2[contact(i)]]; });
    add_whole("jmodel", [&](std::size_t i) { return model_index(contacts.properties[contact(i)]); });
    add_history(data, model, history);
    add_time(grid, model.clock);
    add_names(grid->GetFieldData(), "jmodel_names", model_names);
    return bytes_of(grid);
}

std::vector<std::string> VtkSeries::write(const Model& model, const std::string& given_name,
                                          const HistoryNames& history) {
    std::filesystem::path path(given_name);
    if (path.extension() == ".vtu" || path.extension() == ".pvd") path.replace_extension();
    const std::string name = path.string(), stem = path.filename().string();
    if (stem.empty() || stem == "." || stem == "..")
        throw Diagnostic(fmt::format("'{}' is not a name for VTK files", given_name),
                         "name the files without their ending: vtk write shear");

    // The new time counts only when all files of it are there.
    std::vector<double> times = times_[name];
    const std::size_t number = times.size();
    times.push_back(model.clock.time);
    const std::vector<std::string> paths{fmt::format("{}_blocks_{}.vtu", name, number),
                                         fmt::format("{}_joints_{}.vtu", name, number), name + ".pvd",
                                         name + "_joints.pvd"};
    if (before_writing)
        for (const auto& file : paths) before_writing(file);
    write_whole_file(paths[0], vtk_blocks(model));
    write_whole_file(paths[1], vtk_joints(model, history));
    write_whole_file(paths[2], series_text(stem + "_blocks", times));
    write_whole_file(paths[3], series_text(stem + "_joints", times));
    times_[name] = std::move(times);
    return paths;
}

} // namespace kaya
