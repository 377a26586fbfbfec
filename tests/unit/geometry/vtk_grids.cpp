// Structured grids of VTK, and files that name the files of their pieces.
#include "geometry/grid/file_formats.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

std::string points_of(int nx, int ny, int nz, auto place) {
    std::string text;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const Vec3 p = place(i, j, k);
                text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
            }
    return text;
}

std::string data_array(const std::string& name, const std::string& numbers, int components = 1) {
    return fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\">\n{}\n</DataArray>\n", name,
                       components, numbers);
}

std::string xml_of(const std::string& kind, const std::string& attributes, const std::string& pieces) {
    return fmt::format("<VTKFile type=\"{0}\">\n<{0} {1}>\n{2}</{0}>\n</VTKFile>\n", kind, attributes, pieces);
}

std::string grid_piece(const std::string& extent, const std::string& inside) {
    return fmt::format("<Piece Extent=\"{}\">\n{}</Piece>\n", extent, inside);
}

const std::string legacy_start = "# vtk DataFile Version 3.0\ntitle\nASCII\n";
/// Regions of the 12 cells of a box of 3 x 2 x 2 cells.
const std::string regions = "1 1 1 1 1 1 2 2 2 2 2 2";

double block_volume(const Grid3d& grid, const Grid3d::Block& block) {
    double volume = 0;
    for (const Polyhedron& part : solid_from_surface(surface_of(grid, block)).parts)
        volume += mass_properties(part).volume;
    return volume;
}

/// Six cells below and six above.
void expect_two_layers(const std::string& text, double volume) {
    const Grid3d grid = read_vtk_blocks(text, "a");
    ASSERT_EQ(grid.blocks.size(), 2U) << text.substr(0, 200);
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_EQ(grid.blocks[b].region, static_cast<int>(b) + 1);
        EXPECT_EQ(grid.blocks[b].zones.size(), 36U);
        EXPECT_NEAR(block_volume(grid, grid.blocks[b]), volume, 1e-13 * volume);
    }
}

std::string refusal_of_text(const std::string& bytes) {
    try {
        if (read_vtk_blocks(bytes, "a.vtk").blocks.empty()) read_vtk_surfaces(bytes, "a.vtk");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

} // namespace

TEST(VtkGrids, EveryKindMakesTheSameBlocks) {
    const std::string places =
        points_of(4, 3, 3, [](int i, int j, int k) { return Vec3(2 * i + 1, 3 * j, 0.5 * k - 1); });
    const std::string in_xml = "<CellData>\n" + data_array("region", regions) + "</CellData>\n",
                      in_legacy = "CELL_DATA 12\nSCALARS region int 1\nLOOKUP_TABLE default\n" + regions + "\n";
    const std::string extent = "5 8 0 2 -1 1"; // not from 0
    const double volume = 6 * 2 * 3 * 0.5;
    expect_two_layers(
        xml_of("StructuredGrid", "WholeExtent=\"" + extent + "\"",
               grid_piece(extent, "<Points>\n" + data_array("Points", places, 3) + "</Points>\n" + in_xml)),
        volume);
    expect_two_layers(
        xml_of("RectilinearGrid", "",
               grid_piece(extent, "<Coordinates>\n" + data_array("", "1 3 5 7") + data_array("", "0 3 6") +
                                      data_array("", "-1 -0.5 0") + "</Coordinates>\n" + in_xml)),
        volume);
    expect_two_layers(xml_of("ImageData", "Origin=\"-9 0 -0.5\" Spacing=\"2 3 0.5\"", grid_piece(extent, in_xml)),
                      volume);
    expect_two_layers(
        legacy_start + "DATASET STRUCTURED_GRID\nDIMENSIONS 4 3 3\nPOINTS 36 double\n" + places + in_legacy, volume);
    expect_two_layers(legacy_start +
                          "DATASET RECTILINEAR_GRID\nDIMENSIONS 4 3 3\nX_COORDINATES 4 float\n1 3 5 7\nY_COORDINATES 3 "
                          "float\n0 3 6\nZ_COORDINATES 3 float\n-1 -0.5 0\n" +
                          in_legacy,
                      volume);
    expect_two_layers(legacy_start + "DATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 3\nORIGIN 1 0 -1\nSPACING 2 3 0.5\n" +
                          in_legacy,
                      volume);
}

/// The points of an image stand where origin, extent, spacing and direction put them.
TEST(VtkGrids, ImagesAreTurned) {
    const Grid3d grid =
        read_vtk_blocks(xml_of("ImageData", "Origin=\"10 20 30\" Spacing=\"1 2 3\" Direction=\"0 -1 0 1 0 0 0 0 1\"",
                               grid_piece("2 3 0 1 0 1", "")),
                        "a");
    ASSERT_EQ(grid.gridpoints.size(), 8U);
    EXPECT_EQ(grid.gridpoints.at(1), Vec3(10, 22, 30));
    EXPECT_EQ(grid.gridpoints.at(2), Vec3(10, 23, 30));
    EXPECT_EQ(grid.gridpoints.at(3), Vec3(8, 22, 30));
    EXPECT_EQ(grid.gridpoints.at(5), Vec3(10, 22, 33));
}

/// Mirrored, sheared and curved grids keep their volume; a grid of one layer of points is a surface.
TEST(VtkGrids, CurvedGridsAndSurfaces) {
    const auto text = [](int nz, auto place) {
        return legacy_start +
               fmt::format("DATASET STRUCTURED_GRID\nDIMENSIONS 4 3 {}\nPOINTS {} double\n", nz, 12 * nz) +
               points_of(4, 3, nz, place);
    };
    for (const double side : {1.0, -1.0}) {
        const Grid3d grid = read_vtk_blocks(
            text(2, [&](int i, int j, int k) { return Vec3(side * i, j + 0.3 * i, k * (1 + 0.25 * i)); }), "a");
        ASSERT_EQ(grid.blocks.size(), 1U);
        EXPECT_NEAR(block_volume(grid, grid.blocks[0]), 2 * (3 + 0.25 * 4.5), 1e-12);
    }
    const std::string hill = text(1, [](int i, int j, int) { return Vec3(i, j, 0.5 * i); });
    EXPECT_TRUE(read_vtk_blocks(hill, "a").blocks.empty());
    const auto soups = read_vtk_surfaces(hill, "a");
    ASSERT_EQ(soups.size(), 1U);
    EXPECT_EQ(soups[0].loops.size(), 6U);
    EXPECT_EQ(soups[0].loops[0], (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0}}));
}

TEST(VtkGrids, CopiesAndHiddenCellsAreLeftOut) {
    const std::string image = "Origin=\"0 0 0\" Spacing=\"1 1 1\"";
    const Grid3d grid = read_vtk_blocks(
        xml_of("ImageData", image,
               grid_piece("0 3 0 1 0 1", "<CellData>\n" + data_array("vtkGhostType", "0 0 1") + "</CellData>\n")),
        "a");
    ASSERT_EQ(grid.blocks.size(), 1U);
    EXPECT_NEAR(block_volume(grid, grid.blocks[0]), 2, 1e-14);
    EXPECT_EQ(refusal_of_text(xml_of(
                  "ImageData", image,
                  grid_piece("0 3 0 1 0 1", "<CellData>\n" + data_array("vtkGhostType", "1 1 1") + "</CellData>\n"))),
              "a.vtk: there is no cell and no face in it");
}

TEST(VtkGrids, WrongGridsAreLocated) {
    const std::string image = "Origin=\"0 0 0\" Spacing=\"1 1 1\"";
    EXPECT_EQ(refusal_of_text(xml_of("ImageData", image, grid_piece("0 3 0 1 0", ""))),
              "a.vtk, line 3: Extent is '0 3 0 1 0', and must be 6 numbers");
    EXPECT_EQ(refusal_of_text(xml_of("ImageData", image, grid_piece("0 3.5 0 1 0 1", ""))),
              "a.vtk, line 3: the extent from 0 to 3.5 is not a range of whole numbers");
    EXPECT_EQ(refusal_of_text(xml_of("ImageData", "Origin=\"0 0 0\"", grid_piece("0 1 0 1 0 1", ""))),
              "a.vtk, line 3: Spacing is '', and must be 3 numbers");
    EXPECT_EQ(refusal_of_text(xml_of("ImageData", image, grid_piece("0 9999 0 9999 0 9999", ""))),
              "a.vtk, line 3: 10000 times 10000 times 10000 points are more than the file can hold");
    EXPECT_EQ(refusal_of_text(
                  xml_of("RectilinearGrid", "",
                         grid_piece("0 1 0 1 0 1", "<Coordinates>\n" + data_array("", "0 1") + "</Coordinates>\n"))),
              "a.vtk, line 3: there are 1 arrays of Coordinates, and three axes");
    EXPECT_EQ(
        refusal_of_text(xml_of("StructuredGrid", "",
                               grid_piece("0 1 0 1 0 1", "<Points>\n" + data_array("", "0 1 2", 3) + "</Points>\n"))),
        "a.vtk, line 5: there are 3 numbers, and the coordinates of the points need 24");
    EXPECT_EQ(refusal_of_text(xml_of("HyperTreeGrid", "", "")),
              "a.vtk, line 2: the data are a <HyperTreeGrid>; UnstructuredGrid, PolyData, StructuredGrid, "
              "RectilinearGrid, ImageData are read");
    EXPECT_EQ(refusal_of_text(legacy_start + "DATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 7 float\n"),
              "a.vtk, line 6: there are 7 points, and DIMENSIONS are 2 2 2");
    EXPECT_EQ(refusal_of_text(legacy_start + "DATASET STRUCTURED_POINTS\nDIMENSIONS 300 300 300\n"),
              "a.vtk, line 5: 300 times 300 times 300 points are more than the file can hold");
    EXPECT_EQ(refusal_of_text(legacy_start + "DATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 0 0\n"),
              "a.vtk, line 6: the file ends before the points of the structured_points");
    EXPECT_EQ(
        refusal_of_text(legacy_start + "DATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\nX_COORDINATES 3 float\n0 1 2\n"),
        "a.vtk, line 6: there are 3 coordinates, and DIMENSIONS are 2 2 2");
}

namespace {

void put_text(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string of_pieces(std::initializer_list<const char*> sources) {
    std::string pieces;
    for (const char* source : sources) pieces += fmt::format("<Piece Source=\"{}\"/>\n", source);
    return "<VTKFile type=\"PImageData\">\n<PImageData>\n" + pieces + "</PImageData>\n</VTKFile>\n";
}

std::string refusal_of_file(const std::string& path) {
    try {
        read_contents(path);
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "read";
}

} // namespace

TEST(VtkGrids, PiecesInOtherFilesAreOneMesh) {
    const test::ScratchFolder folder;
    const auto image = [](const char* extent, const char* region) {
        return xml_of("ImageData", "Origin=\"0 0 0\" Spacing=\"1 1 1\"",
                      grid_piece(extent, "<CellData>\n" + data_array("region", region) + "</CellData>\n"));
    };
    std::filesystem::create_directory(folder / "all");
    put_text(folder / "all/one.vti", image("0 2 0 1 0 1", "1 1"));
    put_text(folder / "all/two.vti", image("2 3 0 1 0 1", "2"));
    put_text(folder / "all.pvti", of_pieces({"all/one.vti", "all/two.vti"}));
    const FileContents contents = read_contents(folder / "all.pvti");
    ASSERT_EQ(contents.grid.blocks.size(), 2U);
    EXPECT_TRUE(contents.soups.empty());
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_EQ(contents.grid.blocks[b].region, static_cast<int>(b) + 1);
        EXPECT_NEAR(block_volume(contents.grid, contents.grid.blocks[b]), b == 0 ? 2 : 1, 1e-14);
    }
    // Surfaces of pieces.
    const auto patch = [](double x) {
        return legacy_start +
               fmt::format("DATASET POLYDATA\nPOINTS 3 double\n{0} 0 0 {1} 0 0 {1} 1 0\nPOLYGONS 1 4\n3 0 1 2\n", x,
                           x + 1);
    };
    put_text(folder / "left.vtk", patch(0));
    put_text(folder / "right.vtk", patch(1));
    put_text(
        folder / "both.pvtp",
        "<VTKFile type=\"PPolyData\"><PPolyData><Piece Source=\"left.vtk\"/><Piece Source=\"right.vtk\"/></PPolyData></VTKFile>");
    const auto soups = read_soups(folder / "both.pvtp");
    ASSERT_EQ(soups.size(), 1U);
    ASSERT_EQ(soups[0].loops.size(), 2U);
    EXPECT_EQ(soups[0].loops[1][1], Vec3(2, 0, 0));
}

TEST(VtkGrids, PiecesStayInTheirFolder) {
    const test::ScratchFolder folder;
    std::filesystem::create_directory(folder / "inner");
    put_text(folder / "outside.vti", "");
    const std::string path = folder / "inner/all.pvti";
    const auto refused = [&](const char* source) {
        put_text(path, of_pieces({source}));
        return refusal_of_file(path);
    };
    for (const char* source : {"../outside.vti", "/etc/passwd", "x/../../outside.vti", ".."})
        EXPECT_EQ(refused(source), fmt::format("{}: its piece '{}' is in another folder", path, source));
    std::filesystem::create_symlink(folder / "outside.vti", folder / "inner/link.vti");
    EXPECT_EQ(refused("link.vti"), fmt::format("{}: its piece 'link.vti' is in another folder", path));
    EXPECT_TRUE(refused("none.vti").ends_with("none.vti cannot be opened: No such file or directory"));
    EXPECT_EQ(refused("all.pvti"), path + ": the data are a <PImageData> again");
    put_text(path, of_pieces({""}));
    EXPECT_EQ(refusal_of_file(path), path + ", line 3: a Piece has no Source");
    put_text(path, of_pieces({}));
    EXPECT_EQ(refusal_of_file(path), path + ": it has no pieces");
}

/// A file that holds a surface alone is read for its faces too, and a file of blocks is not.
TEST(VtkGrids, ContentsAreBlocksOrSurfaces) {
    const test::ScratchFolder folder;
    put_text(folder / "face.vtk",
             legacy_start + "DATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n");
    const FileContents face = read_contents(folder / "face.vtk");
    EXPECT_TRUE(face.grid.blocks.empty());
    EXPECT_EQ(face.soups.size(), 1U);
    put_text(folder / "a.xyz", "0 0 0\n");
    EXPECT_EQ(refusal_of_file(folder / "a.xyz"),
              (folder / "a.xyz") + " does not have the suffix of a file that is read");
}
