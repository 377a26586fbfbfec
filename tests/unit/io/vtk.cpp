#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "model/field.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/mechanics/two_bricks.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
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
    EXPECT_THAT(row_of(grid->GetCellData(), "block_region", 1), ElementsAre(7));
    EXPECT_THAT(row_of(grid->GetCellData(), "block_material", 0), ElementsAre(1));
    EXPECT_THAT(row_of(grid->GetCellData(), "block_deformable", 0), ElementsAre(1));
    EXPECT_THAT(row_of(grid->GetCellData(), "block_group", 1), ElementsAre(1));
    EXPECT_THAT(names_in(grid->GetFieldData(), "block_group_names"), ElementsAre("", "base"));
    // A rigid block has no zone.
    EXPECT_THAT(row_of(grid->GetCellData(), "id", 0), ElementsAre(1));
    EXPECT_THAT(row_of(grid->GetCellData(), "id", 1), ElementsAre(-1));
    EXPECT_TRUE(std::isnan(row_of(grid->GetCellData(), "volume", 1)[0]));
    EXPECT_THAT(row_of(grid->GetFieldData(), "time", 0), ElementsAre(0.1));
    EXPECT_THAT(row_of(grid->GetFieldData(), "cycle", 0), ElementsAre(42));
}

TEST(VtkBlocks, StressIsInTheOrderOfVtk) {
    const auto grid = parsed(vtk_blocks(hand_made_model()));
    // xx yy zz xy xz yz of the model are -1 -2 -3 0.1 0.2 0.3.
    EXPECT_THAT(row_of(grid->GetCellData(), "stress", 0), ElementsAre(-1, -2, -3, 0.1, 0.3, 0.2));
    EXPECT_TRUE(std::isnan(row_of(grid->GetCellData(), "stress", 1)[0]));
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

TEST(VtkSubContacts, AVertexForEachWithTheFieldsOfItAndItsContact) {
    const auto grid = parsed(vtk_sub_contacts(hand_made_model()));
    ASSERT_EQ(grid->GetNumberOfCells(), 2);
    EXPECT_EQ(grid->GetCellType(0), VTK_VERTEX);
    EXPECT_EQ(grid->GetPoint(1)[0], 0.5);
    vtkCellData* data = grid->GetCellData();
    EXPECT_THAT(row_of(data, "normal_force", 1), ElementsAre(20));
    EXPECT_THAT(row_of(data, "shear_force_vector", 1), ElementsAre(-3, -4, 0));
    EXPECT_THAT(row_of(data, "normal_stress", 1), ElementsAre(80));
    EXPECT_THAT(row_of(data, "shear_stress", 0), ElementsAre(20));
    EXPECT_THAT(row_of(data, "normal_displacement", 0), ElementsAre(-0.001));
    EXPECT_THAT(row_of(data, "shear_displacement_vector", 0), ElementsAre(3e-3, 4e-3, 0));
    EXPECT_THAT(row_of(data, "normal", 0), ElementsAre(0, 0, 1));
    EXPECT_THAT(row_of(data, "area", 0), ElementsAre(0.25));
    EXPECT_THAT(row_of(data, "state", 1), ElementsAre(2));
    EXPECT_THAT(row_of(data, "contact_joint_set", 0), ElementsAre(2));
    EXPECT_THAT(row_of(data, "contact_id", 0), ElementsAre(1));
    EXPECT_THAT(row_of(data, "id", 1), ElementsAre(2));
    EXPECT_THAT(row_of(data, "block1", 0), ElementsAre(2));
    EXPECT_THAT(row_of(data, "block2", 0), ElementsAre(1));
    EXPECT_THAT(row_of(data, "model", 0), ElementsAre(0));
    EXPECT_THAT(names_in(grid->GetFieldData(), "model_names"), ElementsAre("mohr"));
}

TEST(VtkSubContacts, AContactWithoutModelHasTheEmptyName) {
    Model model = hand_made_model();
    model.contacts.properties[0] = no_row;
    EXPECT_THAT(names_in(parsed(vtk_sub_contacts(model))->GetFieldData(), "model_names"), ElementsAre(""));
}

TEST(VtkArrays, CarryTheKindOfTheirQuantity) {
    const auto unit = [](vtkDataArray* array) {
        return std::string(array->GetInformation()->Get(vtkDataArray::UNITS_LABEL()));
    };
    const auto grid = parsed(vtk_blocks(hand_made_model()));
    EXPECT_EQ(unit(grid->GetPointData()->GetArray("displacement")), "length");
    EXPECT_EQ(unit(grid->GetCellData()->GetArray("stress")), "stress");
    EXPECT_EQ(unit(parsed(vtk_sub_contacts(hand_made_model()))->GetCellData()->GetArray("normal_stiffness")),
              "stress/length");
}

// What a user can list can be seen: each field is an array, or a part of one.
TEST(VtkArrays, EveryFieldOfTheModelIsThere) {
    const Model model = hand_made_model();
    const auto blocks = parsed(vtk_blocks(model)), faces = parsed(vtk_faces(model)),
               subs = parsed(vtk_sub_contacts(model));
    const std::map<ObjectKind, std::pair<vtkFieldData*, std::string>> data{
        {ObjectKind::gridpoint, {blocks->GetPointData(), ""}},
        {ObjectKind::zone, {blocks->GetCellData(), ""}},
        {ObjectKind::block, {blocks->GetCellData(), "block_"}},
        {ObjectKind::face, {faces->GetCellData(), ""}},
        {ObjectKind::sub_contact, {subs->GetCellData(), ""}},
        {ObjectKind::contact, {subs->GetCellData(), "contact_"}}};
    std::string missing;
    for (const Field& field : fields()) {
        const auto found = data.find(field.kind);
        if (found == data.end()) continue;
        const auto& [arrays, prefix] = found->second;
        const std::string name(field.name);
        const std::string whole = name.size() > 2 && name[1] == '_' ? name.substr(2)
                                  : name.size() == 1                ? "position"
                                  : name.ends_with("_stress")       ? "stress"
                                                                    : name;
        const auto has = [&](const std::string& what) { return arrays->HasArray((prefix + what).c_str()) != 0; };
        if (!has(name) && !has(whole) && !has(whole + "_vector")) missing += name + "\n";
    }
    EXPECT_EQ(missing, "");
}

TEST(VtkFaces, ATriangleForEachOfTheModel) {
    const Model model = hand_made_model();
    const auto grid = parsed(vtk_faces(model));
    ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(model.triangles.size()));
    EXPECT_EQ(grid->GetCellType(0), VTK_TRIANGLE);
    EXPECT_THAT(row_of(grid->GetCellData(), "id", 1), ElementsAre(2));
    EXPECT_THAT(row_of(grid->GetCellData(), "block_id", 0), ElementsAre(1));
}

// Two bricks, one shifted on the other: the joint is where both are.
TEST(VtkJoints, PolygonsCoverTheCommonPartOfTheFaces) {
    Bench bench;
    bench.brick({0, 0, 0}, {1, 1, 1}), bench.brick({0.25, 0, 1}, {1.25, 1, 2});
    bench.joint("elastic", {{"jkn", 1e9}, {"jks", 5e8}});
    const auto grid = parsed(vtk_joints(bench.model));
    ASSERT_GT(grid->GetNumberOfCells(), 0);
    EXPECT_EQ(grid->GetCellType(0), VTK_POLYGON);
    double area = 0;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) { // in the plane z = 1
        vtkPoints* corners = grid->GetCell(cell)->GetPoints();
        double doubled = 0;
        for (vtkIdType k = 0, count = corners->GetNumberOfPoints(); k < count; ++k) {
            std::array<double, 3> a{}, b{};
            corners->GetPoint(k, a.data()), corners->GetPoint((k + 1) % count, b.data());
            doubled += a[0] * b[1] - a[1] * b[0];
        }
        area += std::abs(doubled) / 2;
    }
    EXPECT_NEAR(area, 0.75, 1e-12);
    double bounds[6];
    grid->GetBounds(bounds);
    EXPECT_NEAR(bounds[0], 0.25, 1e-12);
    EXPECT_NEAR(bounds[1], 1, 1e-12);
    EXPECT_NEAR(bounds[5], 1, 1e-12);
    EXPECT_THAT(row_of(grid->GetCellData(), "contact_area", 0), ElementsAre(testing::DoubleNear(0.75, 1e-12)));
    EXPECT_EQ(grid->GetPointData()->GetArray("normal_stress")->GetNumberOfTuples(), grid->GetNumberOfPoints());
}

TEST(Vtk, AnEmptyModelGivesEmptyGrids) {
    const Model empty;
    EXPECT_EQ(parsed(vtk_blocks(empty))->GetNumberOfCells(), 0);
    EXPECT_EQ(parsed(vtk_joints(empty))->GetNumberOfCells(), 0);
    EXPECT_EQ(parsed(vtk_faces(empty))->GetNumberOfCells(), 0);
    EXPECT_EQ(parsed(vtk_sub_contacts(empty))->GetNumberOfCells(), 0);
}

TEST(VtkSeries, EveryWriteGetsANumberAndTheSeriesListsItsTime) {
    const ScratchFolder folder;
    Model model = hand_made_model();
    VtkSeries series;
    EXPECT_THAT(series.write(model, folder / "a&b"),
                ElementsAre(folder / "a&b_blocks_0.vtu", folder / "a&b_faces_0.vtu", folder / "a&b_joints_0.vtu",
                            folder / "a&b_subcontacts_0.vtu", folder / "a&b.pvd", folder / "a&b_faces.pvd",
                            folder / "a&b_joints.pvd", folder / "a&b_subcontacts.pvd", folder / "a&b_paraview.py"));
    model.clock.time = 0.30000000000000004;
    series.write(model, folder / "a&b.pvd"); // the ending is left out: the same series
    series.write(model, folder / "other");
    EXPECT_EQ(folder.file_count(), 22u);
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
    EXPECT_EQ(folder.file_count(), 9u);
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
