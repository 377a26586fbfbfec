#include "io/vtk.hpp"

#include "model/fields/field.hpp"
#include "tests/unit/mechanics/two_bricks.hpp"
#include "tests/unit/model/hand_made.hpp"
#include "tests/unit/vtk/read_back.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using namespace kaya::test;
using testing::ElementsAre;

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
    // Two triangles with only one common corner are not a polygon and remain triangles.
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
    const auto grid = parsed(vtk_blocks(hand_made_model()));
    EXPECT_EQ(unit_of(grid->GetPointData()->GetArray("displacement")), "length");
    EXPECT_EQ(unit_of(grid->GetCellData()->GetArray("stress")), "stress");
    EXPECT_EQ(unit_of(parsed(vtk_sub_contacts(hand_made_model()))->GetCellData()->GetArray("normal_stiffness")),
              "stress/length");
}

// Every listed field is an array, or a part of one.
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
        const auto& arrays = found->second.first;
        const std::string& prefix = found->second.second;
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

// Two bricks, one shifted on the other: the joint is their common part.
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
