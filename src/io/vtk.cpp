#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "base/markup_text.hpp"
#include "io/vtk_arrays.hpp"
#include "geometry/grid/vtu_grid.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/structure_rows.hpp"
#include "system/whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <limits>
#include <numeric>
#include <vector>

namespace kaya {

namespace {

void add_time(VtuGrid& grid, const Clock& clock) {
    grid.whole_data.push_back(vtu_array<double>("time", std::array{clock.time}));
    grid.whole_data.push_back(vtu_array<std::int64_t>("cycle", std::array<std::int64_t, 1>{clock.cycle}));
}

/// One polyhedron: its faces as polygons where they are, else as triangles.
void add_rigid_block(VtuGrid& grid, const Model& model, Row block) {
    std::vector<std::vector<Row>> faces;
    const Span span = model.blocks.faces[block];
    for (Row face = span.first; face < span.end(); ++face) {
        if (const auto polygon = face_outline(model, face)) {
            faces.push_back(*polygon);
            continue;
        }
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            const auto& corners = model.triangles.gridpoints[t];
            faces.emplace_back(corners.begin(), corners.end());
        }
    }
    grid.add_polyhedron(faces);
}

std::vector<Row> all_rows(std::size_t count) {
    std::vector<Row> rows(count);
    std::iota(rows.begin(), rows.end(), Row{0});
    return rows;
}

void add_sub_contacts(VtuArrays& target, VtuLists& lists, const Model& model, const std::vector<Row>& rows,
                      const OwnValues& own) {
    add_fields(target, lists, model, ObjectKind::sub_contact, rows);
    add_own_values(target, model, own, rows);
}

/// VTK's order of a symmetric tensor is xx yy zz xy yz xz, ours xx yy zz xy xz yz.
void add_stress(VtuGrid& grid, const Model& model, const std::vector<Row>& zone_of_cell) {
    static constexpr std::array<const char*, 6> names{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    static constexpr std::array<int, 6> component{0, 1, 2, 3, 5, 4};
    std::vector<double> values;
    values.reserve(6 * zone_of_cell.size());
    for (const Row zone : zone_of_cell)
        for (const int k : component)
            values.push_back(zone == no_row ? std::numeric_limits<double>::quiet_NaN() : model.zones.stress[zone][k]);
    grid.cell_data.push_back(
        vtu_array<double>("stress", values, {.unit = "stress", .components = 6, .component_names = names}));
}

template <class Table> std::vector<Vec3> places(const Table& table) {
    return {table.position.begin(), table.position.end()};
}

/// `stem` is the name of the files before _N.vtu, without a folder: they are in the folder of the series, from number `first` on.
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
    VtuGrid grid;
    grid.points = places(model.gridpoints);
    std::vector<Row> block_of_cell, zone_of_cell;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        const Span zones = model.blocks.zones[block];
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            grid.add_cell(VtuCell::tetrahedron, model.zones.gridpoints[zone]);
            block_of_cell.push_back(block);
            zone_of_cell.push_back(zone);
        }
        if (zones.count > 0) continue;
        add_rigid_block(grid, model, block);
        block_of_cell.push_back(block);
        zone_of_cell.push_back(no_row);
    }
    add_fields(grid.point_data, grid.lists, model, ObjectKind::gridpoint, all_rows(grid.points.size()));
    add_stress(grid, model, zone_of_cell);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::zone, zone_of_cell);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::block, block_of_cell, "block_");
    add_time(grid, model.clock);
    return grid.bytes();
}

std::string vtk_faces(const Model& model) {
    VtuGrid grid;
    grid.points = places(model.gridpoints);
    std::vector<Row> face_of_cell, block_of_cell;
    for (Row face = 0; face < static_cast<Row>(model.faces.size()); ++face) {
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            grid.add_cell(VtuCell::triangle, model.triangles.gridpoints[t]);
            face_of_cell.push_back(face);
            block_of_cell.push_back(model.faces.block[face]);
        }
    }
    add_fields(grid.point_data, grid.lists, model, ObjectKind::gridpoint, all_rows(grid.points.size()));
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::face, face_of_cell);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::block, block_of_cell, "block_");
    add_time(grid, model.clock);
    return grid.bytes();
}

std::string vtk_joints(const Model& model, const OwnValues& own) {
    VtuGrid grid;
    std::vector<Row> contact_of_cell, sub_of_cell, sub_of_point;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        if (model.contacts.sub_contacts[contact].count == 0) continue;
        for (const auto& polygon : joint_polygons(model, contact)) {
            std::vector<Row> corners;
            Vec3 middle = Vec3::Zero();
            for (const Vec3& place : polygon) {
                corners.push_back(static_cast<Row>(grid.points.size()));
                grid.points.push_back(place);
                sub_of_point.push_back(nearest_sub_contact(model, contact, place));
                middle += place / static_cast<double>(polygon.size());
            }
            grid.add_cell(VtuCell::polygon, corners);
            contact_of_cell.push_back(contact);
            sub_of_cell.push_back(nearest_sub_contact(model, contact, middle));
        }
    }
    add_sub_contacts(grid.point_data, grid.lists, model, sub_of_point, own);
    add_sub_contacts(grid.cell_data, grid.lists, model, sub_of_cell, own);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::contact, contact_of_cell, "contact_");
    add_time(grid, model.clock);
    return grid.bytes();
}

std::string vtk_sub_contacts(const Model& model, const OwnValues& own) {
    VtuGrid grid;
    const auto rows = all_rows(model.sub_contacts.size());
    std::vector<Row> contacts;
    for (const Row row : rows) {
        grid.points.push_back(shown_place(model, row));
        grid.add_cell(VtuCell::vertex, std::array{row});
        contacts.push_back(model.sub_contacts.contact[row]);
    }
    add_sub_contacts(grid.cell_data, grid.lists, model, rows, own);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::contact, contacts, "contact_");
    add_time(grid, model.clock);
    return grid.bytes();
}

std::string vtk_cables(const Model& model) {
    const auto& nodes = model.structures.cable_nodes;
    VtuGrid grid;
    grid.points = places(nodes);
    const auto rows = all_rows(nodes.size());
    std::vector<Row> first_of_bar;
    for (const Row row : rows) {
        if (!has_bar(nodes, row)) continue;
        grid.add_cell(VtuCell::line, std::array{row, row + 1});
        first_of_bar.push_back(row);
    }
    add_fields(grid.point_data, grid.lists, model, ObjectKind::cable_node, rows);
    add_fields(grid.cell_data, grid.lists, model, ObjectKind::cable_node, first_of_bar);
    add_time(grid, model.clock);
    return grid.bytes();
}

namespace {

template <class Elements>
std::string vtk_members(const Model& model, const Elements& elements, VtuCell shape, ObjectKind kind) {
    VtuGrid grid;
    grid.points = places(model.structures.member_nodes);
    for (const auto& corners : elements.nodes) grid.add_cell(shape, corners);
    add_fields(grid.point_data, grid.lists, model, ObjectKind::structure_node, all_rows(grid.points.size()));
    add_fields(grid.cell_data, grid.lists, model, kind, all_rows(elements.size()));
    add_time(grid, model.clock);
    return grid.bytes();
}

} // namespace

std::string vtk_beams(const Model& model) {
    return vtk_members(model, model.structures.beams, VtuCell::line, ObjectKind::beam_element);
}

std::string vtk_liners(const Model& model) {
    return vtk_members(model, model.structures.liners, VtuCell::triangle, ObjectKind::liner_element);
}

std::vector<std::string> VtkSeries::write(const Model& model, const std::string& given_name, const OwnValues& own) {
    std::filesystem::path path(given_name);
    if (path.extension() == ".vtu" || path.extension() == ".pvd") path.replace_extension();
    const std::string name = path.string(), stem = path.filename().string();
    if (stem.empty() || stem == "." || stem == "..")
        throw Diagnostic(fmt::format("'{}' is not a name for VTK files", given_name),
                         "name the files without their ending: vtk write shear");

    // The new time is added only when all its files are written.
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
    // From the first write with structures of a kind on, each number has a file of them.
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
