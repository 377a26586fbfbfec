#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "base/markup_text.hpp"
#include "base/whole_file.hpp"
#include "io/vtk_arrays.hpp"
#include "model/joint_polygons.hpp"

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>
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

void add_time(vtkUnstructuredGrid* grid, const Clock& clock) {
    add_numbers<vtkDoubleArray>(grid->GetFieldData(), "time", 1, [&](std::size_t) { return clock.time; });
    add_numbers<vtkTypeInt64Array>(grid->GetFieldData(), "cycle", 1, [&](std::size_t) { return clock.cycle; });
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
        if (const auto polygon = face_outline(model, face)) {
            add_face(*polygon);
            continue;
        }
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) add_face(model.triangles.gridpoints[t]);
    }
    stream->SetId(0, faces);
    grid->InsertNextCell(VTK_POLYHEDRON, stream);
}

std::vector<Row> all_rows(std::size_t count) {
    std::vector<Row> rows(count);
    std::iota(rows.begin(), rows.end(), Row{0});
    return rows;
}

void add_sub_contacts(vtkFieldData* target, vtkFieldData* whole, const Model& model, const std::vector<Row>& rows,
                      const OwnValues& own) {
    add_fields(target, whole, model, ObjectKind::sub_contact, rows);
    add_own_values(target, model, own, rows);
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
            const double value = zone == no_row ? std::numeric_limits<double>::quiet_NaN()
                                                : model.zones.stress[zone][component[static_cast<std::size_t>(k)]];
            array->SetComponent(static_cast<vtkIdType>(cell), k, value);
        }
    set_unit(array, "stress");
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

/// `stem` is the name of the files before _N.vtu, without a folder: they stand next to the series, from number `first` on.
std::string series_text(const std::string& stem, const std::vector<double>& times, std::size_t first) {
    std::string text = "<?xml version=\"1.0\"?>\n"
                       "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                       "  <Collection>\n";
    for (std::size_t number = first; number < times.size(); ++number)
        text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}_{}.vtu\"/>\n", times[number],
                            markup_text(stem), number);
    return text + "  </Collection>\n</VTKFile>\n";
}

std::string python_text(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\\' || c == '\'') result += '\\';
        result += c;
    }
    return result + "'";
}

/// Opens the series in ParaView, coloured: blocks by displacement, joints by slip.
std::string paraview_script(const std::string& stem) {
    return "# Opens the series in ParaView: `paraview --script=FILE`, or Tools > Python Shell > Run Script.\n"
           "import os\n"
           "from paraview.simple import *\n\n"
           "try:\n"
           "    folder = os.path.dirname(os.path.abspath(__file__))\n"
           "except NameError:  # started from the Python shell\n"
           "    folder = os.getcwd()\n\n"
           "def opened(series, where, field, opacity):\n"
           "    data = PVDReader(registrationName=series, FileName=os.path.join(folder, series))\n"
           "    shown = Show(data)\n"
           "    shown.Representation = 'Surface With Edges'\n"
           "    shown.Opacity = opacity\n"
           "    try:\n"
           "        ColorBy(shown, (where, field))\n"
           "        shown.RescaleTransferFunctionToDataRange(True)\n"
           "        shown.SetScalarBarVisibility(GetActiveView(), True)\n"
           "    except RuntimeError:  # no data yet\n"
           "        pass\n"
           "    return data\n\n"
           "stem = " +
           python_text(stem) +
           "\n"
           "opened(stem + '.pvd', 'POINTS', 'displacement', 0.5)\n"
           "opened(stem + '_joints.pvd', 'CELLS', 'shear_displacement', 1.0)\n"
           "view = GetActiveView()\n"
           "view.OrientationAxesVisibility = 1\n"
           "GetAnimationScene().UpdateAnimationUsingDataTimeSteps()\n"
           "GetAnimationScene().GoToLast()\n"
           "ResetCamera()\n"
           "Render()\n";
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

    vtkFieldData* whole = grid->GetFieldData();
    add_fields(grid->GetPointData(), whole, model, ObjectKind::gridpoint, all_rows(gridpoints.size()));
    add_stress(grid, model, zone_of_cell);
    add_fields(grid->GetCellData(), whole, model, ObjectKind::zone, zone_of_cell);
    add_fields(grid->GetCellData(), whole, model, ObjectKind::block, block_of_cell, "block_");
    add_time(grid, model.clock);
    return bytes_of(grid);
}

std::string vtk_faces(const Model& model) {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& position : model.gridpoints.position) points->InsertNextPoint(position.data());
    grid->SetPoints(points);
    grid->Allocate(static_cast<vtkIdType>(model.triangles.size()));
    std::vector<Row> face_of_cell, block_of_cell;
    for (Row face = 0; face < static_cast<Row>(model.faces.size()); ++face) {
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            const auto& corner = model.triangles.gridpoints[t];
            const std::array<vtkIdType, 3> ids{corner[0], corner[1], corner[2]};
            grid->InsertNextCell(VTK_TRIANGLE, 3, ids.data());
            face_of_cell.push_back(face);
            block_of_cell.push_back(model.faces.block[face]);
        }
    }
    vtkFieldData* whole = grid->GetFieldData();
    add_fields(grid->GetPointData(), whole, model, ObjectKind::gridpoint, all_rows(model.gridpoints.size()));
    add_fields(grid->GetCellData(), whole, model, ObjectKind::face, face_of_cell);
    add_fields(grid->GetCellData(), whole, model, ObjectKind::block, block_of_cell, "block_");
    add_time(grid, model.clock);
    return bytes_of(grid);
}

std::string vtk_joints(const Model& model, const OwnValues& own) {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::vector<Row> contact_of_cell, sub_of_cell, sub_of_point;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        if (model.contacts.sub_contacts[contact].count == 0) continue;
        for (const auto& polygon : joint_polygons(model, contact)) {
            vtkNew<vtkIdList> corners;
            Vec3 middle = Vec3::Zero();
            for (const Vec3& place : polygon) {
                corners->InsertNextId(points->InsertNextPoint(place.data()));
                sub_of_point.push_back(nearest_sub_contact(model, contact, place));
                middle += place / static_cast<double>(polygon.size());
            }
            grid->InsertNextCell(VTK_POLYGON, corners);
            contact_of_cell.push_back(contact);
            sub_of_cell.push_back(nearest_sub_contact(model, contact, middle));
        }
    }
    grid->SetPoints(points);
    add_sub_contacts(grid->GetPointData(), grid->GetFieldData(), model, sub_of_point, own);
    add_sub_contacts(grid->GetCellData(), grid->GetFieldData(), model, sub_of_cell, own);
    add_fields(grid->GetCellData(), grid->GetFieldData(), model, ObjectKind::contact, contact_of_cell, "contact_");
    add_time(grid, model.clock);
    return bytes_of(grid);
}

std::string vtk_sub_contacts(const Model& model, const OwnValues& own) {
    const auto rows = all_rows(model.sub_contacts.size());
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid->Allocate(static_cast<vtkIdType>(rows.size()));
    std::vector<Row> contacts;
    for (const Row row : rows) {
        const Vec3 position = model.sub_contacts.position[row];
        const vtkIdType point = points->InsertNextPoint(position.data());
        grid->InsertNextCell(VTK_VERTEX, 1, &point);
        contacts.push_back(model.sub_contacts.contact[row]);
    }
    grid->SetPoints(points);
    add_sub_contacts(grid->GetCellData(), grid->GetFieldData(), model, rows, own);
    add_fields(grid->GetCellData(), grid->GetFieldData(), model, ObjectKind::contact, contacts, "contact_");
    add_time(grid, model.clock);
    return bytes_of(grid);
}

std::string vtk_cables(const Model& model) {
    const auto& nodes = model.structures.cable_nodes;
    const auto rows = all_rows(nodes.size());
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& position : nodes.position) points->InsertNextPoint(position.data());
    grid->SetPoints(points);
    grid->Allocate(static_cast<vtkIdType>(nodes.size()));
    std::vector<Row> first_of_bar;
    for (const Row row : rows) {
        if (!has_bar(nodes, row)) continue;
        const std::array<vtkIdType, 2> ids{row, row + 1};
        grid->InsertNextCell(VTK_LINE, 2, ids.data());
        first_of_bar.push_back(row);
    }
    add_fields(grid->GetPointData(), grid->GetFieldData(), model, ObjectKind::cable_node, rows);
    add_fields(grid->GetCellData(), grid->GetFieldData(), model, ObjectKind::cable_node, first_of_bar);
    add_time(grid, model.clock);
    return bytes_of(grid);
}

namespace {

template <class Elements>
std::string vtk_members(const Model& model, const Elements& elements, int cell, ObjectKind kind) {
    const auto& nodes = model.structures.member_nodes;
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& position : nodes.position) points->InsertNextPoint(position.data());
    grid->SetPoints(points);
    grid->Allocate(static_cast<vtkIdType>(elements.size()));
    for (const auto& corners : elements.nodes) {
        std::array<vtkIdType, 3> ids{};
        std::copy(corners.begin(), corners.end(), ids.begin());
        grid->InsertNextCell(cell, static_cast<vtkIdType>(corners.size()), ids.data());
    }
    add_fields(grid->GetPointData(), grid->GetFieldData(), model, ObjectKind::structure_node, all_rows(nodes.size()));
    add_fields(grid->GetCellData(), grid->GetFieldData(), model, kind, all_rows(elements.size()));
    add_time(grid, model.clock);
    return bytes_of(grid);
}

} // namespace

std::string vtk_beams(const Model& model) {
    return vtk_members(model, model.structures.beams, VTK_LINE, ObjectKind::beam_element);
}

std::string vtk_liners(const Model& model) {
    return vtk_members(model, model.structures.liners, VTK_TRIANGLE, ObjectKind::liner_element);
}

std::vector<std::string> VtkSeries::write(const Model& model, const std::string& given_name, const OwnValues& own) {
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
    struct File {
        std::string path;
        std::function<std::string()> content;
    };
    std::vector<File> files;
    const auto add_grid = [&](const char* kind, auto&& content) {
        files.push_back({fmt::format("{}_{}_{}.vtu", name, kind, number), content});
    };
    const auto add_series = [&](const std::string& ending, const char* kind, std::size_t first = 0) {
        files.push_back({name + ending, [&times, first, text = fmt::format("{}_{}", stem, kind)] {
                             return series_text(text, times, first);
                         }});
    };
    add_grid("blocks", [&] { return vtk_blocks(model); });
    add_grid("faces", [&] { return vtk_faces(model); });
    add_grid("joints", [&] { return vtk_joints(model, own); });
    add_grid("subcontacts", [&] { return vtk_sub_contacts(model, own); });
    add_series(".pvd", "blocks");
    for (const char* kind : {"faces", "joints", "subcontacts"}) add_series(fmt::format("_{}.pvd", kind), kind);
    // Once there were structures of a kind, each number has its file of them.
    auto first_with = first_with_[name];
    const auto add_structures = [&](const char* kind, bool any, std::string (*grid)(const Model&)) {
        auto first = first_with.find(kind);
        if (first != first_with.end() && first->second >= number) first_with.erase(first), first = first_with.end();
        if (first == first_with.end() && !any) return;
        if (first == first_with.end()) first = first_with.emplace(kind, number).first;
        add_grid(kind, [&model, grid] { return grid(model); });
        add_series(fmt::format("_{}.pvd", kind), kind, first->second);
    };
    add_structures("cables", !model.structures.cables.empty(), vtk_cables);
    add_structures("beams", !model.structures.beams.empty(), vtk_beams);
    add_structures("liners", !model.structures.liners.empty(), vtk_liners);
    files.push_back({name + "_paraview.py", [&] { return paraview_script(stem); }});
    std::vector<std::string> paths;
    for (const auto& file : files) {
        if (before_writing) before_writing(file.path);
        paths.push_back(file.path);
    }
    for (const auto& file : files) write_whole_file(file.path, file.content());
    times_[name] = std::move(times);
    first_with_[name] = std::move(first_with);
    return paths;
}

} // namespace kaya
