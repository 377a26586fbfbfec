#include "io/vtk.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using namespace kaya::test;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(VtkSeries, EveryWriteGetsANumberAndTheSeriesListsItsTime) {
    const ScratchFolder folder;
    Model model = hand_made_model();
    VtkSeries series;
    EXPECT_THAT(series.write(model, folder / "a&b"),
                ElementsAre(folder / "a&b_blocks_0.vtu", folder / "a&b_faces_0.vtu", folder / "a&b_joints_0.vtu",
                            folder / "a&b_subcontacts_0.vtu", folder / "a&b.pvd", folder / "a&b_faces.pvd",
                            folder / "a&b_joints.pvd", folder / "a&b_subcontacts.pvd", folder / "a&b_paraview.py"));
    model.clock.time = 0.30000000000000004;
    series.write(model, folder / "a&b.pvd"); // the suffix is removed: the same series
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
