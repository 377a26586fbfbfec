// Files that VTK writes, in all its encodings, and those that kaya exports, read by VTK.
#include "geometry/grid/file_formats.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include "tests/unit/vtk/read_back.hpp"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <array>
#include <functional>

using namespace kaya;
using namespace kaya::test;

namespace {

void label(vtkDataSet& data, std::initializer_list<int> regions, std::initializer_list<const char*> groups) {
    vtkNew<vtkIntArray> region;
    region->SetName("region");
    for (const int value : regions) region->InsertNextValue(value);
    data.GetCellData()->AddArray(region);
    vtkNew<vtkStringArray> group;
    group->SetName("group");
    for (const char* name : groups) group->InsertNextValue(name);
    data.GetCellData()->AddArray(group);
    vtkNew<vtkDoubleArray> vectors; // which kaya reads over
    vectors->SetName("stress [Pa]");
    vectors->SetNumberOfComponents(3);
    for (std::size_t k = 0; k < regions.size(); ++k) vectors->InsertNextTuple3(1e30, -0.5, 0);
    data.GetCellData()->AddArray(vectors);
}

/// A tetrahedron, a voxel, a hexahedron on it, a wedge, a pyramid and a polyhedron, each away from the others but for the two boxes.
vtkSmartPointer<vtkUnstructuredGrid> every_cell(bool with_polyhedron) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const auto add = [&](int type, std::initializer_list<std::array<double, 3>> corners) {
        std::vector<vtkIdType> ids;
        for (const auto& c : corners) ids.push_back(points->InsertNextPoint(c[0] / 3, c[1], c[2]));
        grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    };
    add(VTK_TETRA, {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    add(VTK_VOXEL, {{9, 0, 0}, {12, 0, 0}, {9, 2, 0}, {12, 2, 0}, {9, 0, 3}, {12, 0, 3}, {9, 2, 3}, {12, 2, 3}});
    const std::array<vtkIdType, 4> base{8, 9, 11, 10};
    std::array<vtkIdType, 8> box{};
    std::copy(base.begin(), base.end(), box.begin());
    for (int k = 0; k < 4; ++k) {
        double p[3];
        points->GetPoint(base[static_cast<std::size_t>(k)], p);
        box[static_cast<std::size_t>(k) + 4] = points->InsertNextPoint(p[0], p[1], 5);
    }
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, box.data());
    add(VTK_WEDGE, {{18, 0, 0}, {21, 0, 0}, {18, 1, 0}, {18, 0, 1}, {21, 0, 1}, {18, 1, 1}});
    add(VTK_PYRAMID, {{27, 0, 0}, {30, 0, 0}, {30, 1, 0}, {27, 1, 0}, {27, 0, 1}});
    if (with_polyhedron) {
        const vtkIdType first = points->GetNumberOfPoints();
        for (const auto& c : {std::array{36., 0., 0.}, {39., 0., 0.}, {36., 1., 0.}, {36., 0., 1.}})
            points->InsertNextPoint(c[0] / 3, c[1], c[2]);
        vtkNew<vtkIdList> faces;
        faces->InsertNextId(4);
        for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
            faces->InsertNextId(3);
            for (const int corner : face) faces->InsertNextId(first + corner);
        }
        grid->InsertNextCell(VTK_POLYHEDRON, faces);
    }
    grid->SetPoints(points);
    if (with_polyhedron) label(*grid, {1, 2, 2, 0, 3, 4}, {"tip", "box", "box", "", "left wall", "tip"});
    else label(*grid, {1, 2, 2, 0, 3}, {"tip", "box", "box", "", "left wall"});
    return grid;
}

double volume_of(const Grid3d& grid, const Grid3d::Block& block) {
    double volume = 0;
    for (const Polyhedron& part : solid_from_surface(surface_of(grid, block)).parts)
        volume += mass_properties(part).volume;
    return volume;
}

void expect_every_cell(const Grid3d& grid, bool with_polyhedron) {
    ASSERT_EQ(grid.blocks.size(), with_polyhedron ? 5U : 4U);
    const std::array<double, 5> volumes{1. / 6, 2 * 5, 1. / 2, 1. / 3, 1. / 6};
    const std::array<const char*, 5> groups{"tip", "box", "", "left wall", "tip"};
    const std::array regions{1, 2, 0, 3, 4};
    for (std::size_t k = 0; k < grid.blocks.size(); ++k) {
        EXPECT_NEAR(volume_of(grid, grid.blocks[k]), volumes[k], 1e-14 * volumes[k]) << k;
        EXPECT_EQ(grid.blocks[k].group, groups[k]);
        EXPECT_EQ(grid.blocks[k].region, regions[k]);
        EXPECT_EQ(grid.blocks[k].zones.empty(), k == 4);
    }
}

template <class Writer> std::string xml_of(vtkDataSet* data, const std::function<void(Writer&)>& options) {
    const ScratchFolder folder;
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName((folder / "a.xml").c_str());
    options(*writer);
    writer->Write();
    return content_of(folder / "a.xml");
}

template <class Writer> std::string legacy_of(vtkDataSet* data, bool binary, int version) {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetWriteToOutputString(true);
    writer->SetFileVersion(version);
    if (binary) writer->SetFileTypeToBinary();
    else writer->SetFileTypeToASCII();
    writer->Write();
    return {writer->GetOutputString(), static_cast<std::size_t>(writer->GetOutputStringLength())};
}

/// Calls visit(bytes) for all encodings of XML files.
template <class Writer> void each_encoding(vtkDataSet* data, const std::function<void(const std::string&)>& visit) {
    for (const auto mode : {Writer::Ascii, Writer::Binary, Writer::Appended})
        for (const auto packed : {Writer::NONE, Writer::ZLIB, Writer::LZ4})
            for (const bool coded : {false, true})
                for (const bool wide : {false, true})
                    for (const bool big : {false, true})
                        visit(xml_of<Writer>(data, [&](Writer& writer) {
                            writer.SetDataMode(mode);
                            writer.SetCompressorType(packed);
                            if (packed != Writer::NONE) writer.SetBlockSize(64);
                            writer.SetEncodeAppendedData(coded);
                            writer.SetHeaderType(wide ? Writer::UInt64 : Writer::UInt32);
                            writer.SetByteOrder(big ? Writer::BigEndian : Writer::LittleEndian);
                        }));
}

} // namespace

TEST(ImportedGrids, XmlInAllEncodings) {
    int count = 0;
    const auto grid = every_cell(true);
    each_encoding<vtkXMLUnstructuredGridWriter>(grid, [&](const std::string& bytes) {
        SCOPED_TRACE(bytes.substr(0, 200));
        expect_every_cell(read_vtk_blocks(bytes, "a.vtu"), true);
        ++count;
    });
    EXPECT_EQ(count, 72);
}

TEST(ImportedGrids, LegacyTextAndBinaryOfBothVersions) {
    for (const bool binary : {false, true})
        for (const int version : {42, 51}) {
            SCOPED_TRACE(testing::Message() << binary << version);
            expect_every_cell(
                read_vtk_blocks(legacy_of<vtkUnstructuredGridWriter>(every_cell(false), binary, version), "a.vtk"),
                false);
            expect_every_cell(
                read_vtk_blocks(legacy_of<vtkUnstructuredGridWriter>(every_cell(true), binary, version), "a.vtk"),
                true);
        }
}

TEST(ImportedGrids, PolygonalDataInAllEncodings) {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    for (const auto& c : {std::array{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
        points->InsertNextPoint(c.data());
    data->SetPoints(points);
    vtkNew<vtkCellArray> polygons, strips, lines;
    for (const auto& face : {std::array<vtkIdType, 3>{0, 2, 1}, {0, 1, 3}}) polygons->InsertNextCell(3, face.data());
    const std::array<vtkIdType, 4> strip{1, 2, 3, 0}; // two triangles
    strips->InsertNextCell(4, strip.data());
    const std::array<vtkIdType, 2> line{0, 3};
    lines->InsertNextCell(2, line.data());
    data->SetPolys(polygons);
    data->SetStrips(strips);
    data->SetLines(lines);
    label(*data, {0, 5, 5, 5}, {"line", "stone 1", "stone 1", "stone 1"});
    const auto expect_stone = [](const std::string& bytes) {
        SCOPED_TRACE(bytes.substr(0, 200));
        const auto soups = read_vtk_surfaces(bytes, "a.vtp");
        ASSERT_EQ(soups.size(), 1U);
        EXPECT_EQ(soups[0].name, "stone 1");
        EXPECT_EQ(soups[0].loops.size(), 4U);
        const SurfaceFile file = surfaces_of(soups);
        ASSERT_EQ(file.surfaces.size(), 1U);
        EXPECT_DOUBLE_EQ(mass_properties(solid_from_surface(file.surfaces[0].surface).parts[0]).volume, 1. / 6);
        EXPECT_TRUE(read_vtk_blocks(bytes, "a.vtp").blocks.empty());
    };
    each_encoding<vtkXMLPolyDataWriter>(data, expect_stone);
    for (const bool binary : {false, true})
        for (const int version : {42, 51}) expect_stone(legacy_of<vtkPolyDataWriter>(data, binary, version));
}

TEST(ImportedGrids, VtkReadsWhatIsExported) {
    const Cut parts = cut(make_brick({0, 0, 0}, {2, 1, 1}), {normal_from_dip(33, 71), {0.9, 0.5, 0.4}}, 6);
    const TetMesh mesh = make_mesh(parts.above, 0.5);
    const Grid3d grid =
        grid_of({{.number = 3, .region = 0, .group = "rock", .shape = &parts.below, .material = 2},
                 {.number = 7, .region = 5, .group = "", .shape = &parts.above, .material = 1, .zones = &mesh}},
                Corners::own);
    const auto read = parsed(write_vtu(grid));
    ASSERT_EQ(read->GetNumberOfCells(), 1 + static_cast<vtkIdType>(mesh.tetrahedra.size()));
    EXPECT_EQ(read->GetCellType(0), VTK_POLYHEDRON);
    EXPECT_EQ(read->GetCellType(1), VTK_TETRA);
    EXPECT_EQ(row_of(read->GetCellData(), "block", 0), std::vector{3.});
    EXPECT_EQ(row_of(read->GetCellData(), "region", 1), std::vector{5.});
    EXPECT_EQ(row_of(read->GetCellData(), "material", 0), std::vector{2.});
    EXPECT_EQ(row_of(read->GetCellData(), "group", 1), std::vector{-1.});
    EXPECT_EQ(names_in(read->GetFieldData(), "group_names"), std::vector<std::string>{"rock"});
}
