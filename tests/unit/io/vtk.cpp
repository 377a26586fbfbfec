#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/io/scratch_folder.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace kaya;
using namespace kaya::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& path) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

/// What VTK's own reader makes of the bytes.
vtkSmartPointer<vtkUnstructuredGrid> parsed(const std::string& bytes) {
    const ScratchFolder folder;
    put(folder / "a.vtu", bytes);
    return read_grid(folder / "a.vtu");
}

std::vector<double> row_of(vtkFieldData* data, const char* name, vtkIdType row) {
    vtkDataArray* array = data->GetArray(name);
    if (!array) throw std::runtime_error(std::string("no array ") + name);
    std::vector<double> values;
    for (int k = 0; k < array->GetNumberOfComponents(); ++k) values.push_back(array->GetComponent(row, k));
    return values;
}

std::vector<std::string> names_in(vtkFieldData* data, const char* name) {
    auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
    if (!array) throw std::runtime_error(std::string("no names ") + name);
    std::vector<std::string> names;
    for (vtkIdType k = 0; k < array->GetNumberOfValues(); ++k) names.push_back(array->GetValue(k));
    return names;
}

} // namespace

TEST(VtkBlocks, ZonesAreTetrahedraAndRigidBlocksPolyhedra) {
    const auto grid = parsed(vtk_blocks(hand_made_model()));
    ASSERT_EQ(grid->GetNumberOfCells(), 2);
    ASSERT_EQ(grid->GetNumberOfPoints(), 8);
    EXPECT_EQ(grid->GetCellType(0), VTK_TETRA);
    EXPECT_EQ(grid->GetCellType(1), VTK_POLYHEDRON);
    EXPECT_EQ(grid->GetCell(1)->GetNumberOfFaces(), 4);
    EXPECT_EQ(grid->GetCell(1)->GetNumberOfPoints(), 4);
    EXPECT_EQ(grid->GetPoint(3)[2], 1);
}

TEST(VtkBlocks, DataOfPointsCellsAndTheWhole) {
    Model model = hand_made_model();
    model.gridpoints.displacement[2] = Vec3(1.0 / 3, -2, 1e-300);
    const auto grid = parsed(vtk_blocks(model));
    EXPECT_THAT(row_of(grid->GetPointData(), "displacement", 2), ElementsAre(1.0 / 3, -2, 1e-300));
    EXPECT_THAT(row_of(grid->GetPointData(), "velocity", 3), ElementsAre(1.5, 0, 0));
    EXPECT_THAT(row_of(grid->GetCellData(), "block_id", 1), ElementsAre(2));
    EXPECT_THAT(row_of(grid->GetCellData(), "region", 1), ElementsAre(7));
    EXPECT_THAT(row_of(grid->GetCellData(), "material", 0), ElementsAre(1));
    EXPECT_THAT(row_of(grid->GetCellData(), "deformable", 0), ElementsAre(1));
    EXPECT_THAT(row_of(grid->GetCellData(), "group", 1), ElementsAre(1));
    EXPECT_THAT(names_in(grid->GetFieldData(), "group_names"), ElementsAre("", "base"));
    EXPECT_THAT(row_of(grid->GetFieldData(), "time", 0), ElementsAre(0.1));
    EXPECT_THAT(row_of(grid->GetFieldData(), "cycle", 0), ElementsAre(42));
}

TEST(VtkBlocks, StressIsInTheOrderOfVtk) {
    const auto grid = parsed(vtk_blocks(hand_made_model()));
    // xx yy zz xy xz yz of the model are -1 -2 -3 0.1 0.2 0.3.
    EXPECT_THAT(row_of(grid->GetCellData(), "stress", 0), ElementsAre(-1, -2, -3, 0.1, 0.3, 0.2));
    EXPECT_THAT(row_of(grid->GetCellData(), "stress", 1), ElementsAre(0, 0, 0, 0, 0, 0));
    vtkDataArray* stress = grid->GetCellData()->GetArray("stress");
    EXPECT_STREQ(stress->GetComponentName(4), "YZ");
    EXPECT_STREQ(stress->GetComponentName(5), "XZ");
}

TEST(VtkBlocks, TrianglesOfAFaceBecomeOnePolygonWhereTheyMakeOne) {
    // Face 4 (the top of the rigid block) gets a second triangle: a quadrilateral 4 5 6 7.
    Model model = hand_made_model();
    model.triangles.gather({0, 1, 2, 3, 4, 4, 5, 6, 7});
    model.triangles.gridpoints[4] = {4, 5, 6};
    model.triangles.gridpoints[5] = {4, 6, 7};
    model.faces.triangles[4] = {4, 2};
    for (Row face = 5; face < 8; ++face) model.faces.triangles[face] = {face + 1, 1};
    auto grid = parsed(vtk_blocks(model));
    ASSERT_EQ(grid->GetCell(1)->GetNumberOfFaces(), 4);
    EXPECT_EQ(grid->GetCell(1)->GetFace(0)->GetNumberOfPoints(), 4);
    EXPECT_EQ(grid->GetCell(1)->GetFace(1)->GetNumberOfPoints(), 3);
    // Two triangles that meet in a corner only are no polygon and stay triangles.
    model.triangles.gridpoints[5] = {4, 7, 3};
    grid = parsed(vtk_blocks(model));
    EXPECT_EQ(grid->GetCell(1)->GetNumberOfFaces(), 5);
}

TEST(VtkJoints, AVertexForEachSubContactWithItsData) {
    const auto grid = parsed(vtk_joints(hand_made_model()));
    ASSERT_EQ(grid->GetNumberOfCells(), 2);
    EXPECT_EQ(grid->GetCellType(0), VTK_VERTEX);
    EXPECT_EQ(grid->GetPoint(1)[0], 0.5);
    vtkCellData* data = grid->GetCellData();
    EXPECT_THAT(row_of(data, "force_normal", 1), ElementsAre(20));
    EXPECT_THAT(row_of(data, "force_shear", 1), ElementsAre(-3, -4, 0));
    EXPECT_THAT(row_of(data, "stress_normal", 1), ElementsAre(80));
    EXPECT_THAT(row_of(data, "stress_shear", 0), ElementsAre(20));
    EXPECT_THAT(row_of(data, "disp_normal", 0), ElementsAre(-0.001));
    EXPECT_THAT(row_of(data, "disp_shear", 0), ElementsAre(3e-3, 4e-3, 0));
    EXPECT_THAT(row_of(data, "normal", 0), ElementsAre(0, 0, 1));
    EXPECT_THAT(row_of(data, "area", 0), ElementsAre(0.25));
    EXPECT_THAT(row_of(data, "state", 1), ElementsAre(2));
    EXPECT_THAT(row_of(data, "joint_set", 0), ElementsAre(2));
    EXPECT_THAT(row_of(data, "contact_id", 0), ElementsAre(1));
    EXPECT_THAT(row_of(data, "subcontact_id", 1), ElementsAre(2));
    EXPECT_THAT(row_of(data, "block1", 0), ElementsAre(2));
    EXPECT_THAT(row_of(data, "block2", 0), ElementsAre(1));
    EXPECT_THAT(row_of(data, "jmodel", 0), ElementsAre(0));
    EXPECT_THAT(names_in(grid->GetFieldData(), "jmodel_names"), ElementsAre("mohr"));
}

TEST(VtkJoints, AContactWithoutModelAndANameUsedTwice) {
    Model model = hand_made_model();
    model.joint_properties.push_back({"mohr", 4, {}, ""});
    model.joint_properties.push_back({"elastic", 4, {}, ""});
    model.contacts.properties[0] = 2;
    auto grid = parsed(vtk_joints(model));
    EXPECT_THAT(names_in(grid->GetFieldData(), "jmodel_names"), ElementsAre("mohr", "elastic"));
    EXPECT_THAT(row_of(grid->GetCellData(), "jmodel", 0), ElementsAre(1));
    model.contacts.properties[0] = no_row;
    grid = parsed(vtk_joints(model));
    EXPECT_THAT(row_of(grid->GetCellData(), "jmodel", 0), ElementsAre(-1));
}

TEST(Vtk, AnEmptyModelGivesEmptyGrids) {
    const Model empty;
    EXPECT_EQ(parsed(vtk_blocks(empty))->GetNumberOfCells(), 0);
    EXPECT_EQ(parsed(vtk_joints(empty))->GetNumberOfCells(), 0);
}

TEST(VtkSeries, EveryWriteGetsANumberAndTheSeriesListsItsTime) {
    const ScratchFolder folder;
    Model model = hand_made_model();
    VtkSeries series;
    EXPECT_THAT(series.write(model, folder / "a&b"),
                ElementsAre(folder / "a&b_blocks_0.vtu", folder / "a&b_joints_0.vtu", folder / "a&b.pvd",
                            folder / "a&b_joints.pvd"));
    model.clock.time = 0.30000000000000004;
    series.write(model, folder / "a&b.pvd"); // the ending is left out: the same series
    series.write(model, folder / "other");
    EXPECT_EQ(folder.file_count(), 10u);
    EXPECT_EQ(content_of(folder / "a&b_joints.pvd"),
              "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
              "  <Collection>\n"
              "    <DataSet timestep=\"0.1\" group=\"\" part=\"0\" file=\"a&amp;b_joints_0.vtu\"/>\n"
              "    <DataSet timestep=\"0.30000000000000004\" group=\"\" part=\"0\" file=\"a&amp;b_joints_1.vtu\"/>\n"
              "  </Collection>\n"
              "</VTKFile>\n");
    EXPECT_THAT(content_of(folder / "a&b.pvd"), HasSubstr("file=\"a&amp;b_blocks_1.vtu\""));
    EXPECT_EQ(read_grid(folder / "a&b_blocks_1.vtu")->GetNumberOfCells(), 2);
    EXPECT_THAT(content_of(folder / "other.pvd"), testing::Not(HasSubstr("other_blocks_1")));
}

TEST(VtkSeries, ARunThatUsesTheNameAgainBeginsTheSeriesAnew) {
    const ScratchFolder folder;
    const Model model = hand_made_model();
    VtkSeries first;
    first.write(model, folder / "a");
    first.write(model, folder / "a");
    VtkSeries second;
    second.write(model, folder / "a");
    EXPECT_THAT(content_of(folder / "a.pvd"), testing::Not(HasSubstr("a_blocks_1")));
}

TEST(VtkSeries, AFullDiskLeavesTheSeriesFromBefore) {
    const ScratchFolder folder;
    Model model = hand_made_model();
    VtkSeries series;
    series.write(model, folder / "a");
    const std::string before = content_of(folder / "a.pvd");
    {
        const SmallDisk disk(1000);
        EXPECT_THROW(series.write(model, folder / "a"), Diagnostic);
    }
    EXPECT_EQ(content_of(folder / "a.pvd"), before);
    EXPECT_EQ(folder.file_count(), 4u);
    series.write(model, folder / "a");
    EXPECT_THAT(content_of(folder / "a.pvd"), HasSubstr("a_blocks_1.vtu"));
}

TEST(VtkSeries, NamesThatAreNone) {
    VtkSeries series;
    for (const auto* name : {"", ".", "folder/", ".."})
        EXPECT_THROW(series.write(hand_made_model(), name), Diagnostic) << name;
    const ScratchFolder folder;
    try {
        series.write(hand_made_model(), folder / "no/a");
        FAIL();
    } catch (const Diagnostic& d) {
        EXPECT_EQ(d.hint, "make the folder first");
        EXPECT_EQ(d.fault, Fault::run);
    }
}
