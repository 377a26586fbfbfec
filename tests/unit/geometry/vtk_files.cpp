// Meshes of VTK: cells of all types, labels, the messages of wrong files, cut off and damaged files. tests/unit/vtk reads what VTK writes.
#include "geometry/grid/file_formats.hpp"

#include "base/base64.hpp"
#include "base/deflate.hpp"
#include "base/diagnostic.hpp"
#include "geometry/polyhedra/random.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lz4.h>

using namespace kaya;

namespace {

const std::string corners = "0 0 0  1 0 0  0 1 0  0 0 1  1 1 1";

std::string legacy(const std::string& cells, const std::string& data = "") {
    return "# vtk DataFile Version 3.0\na \"title\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n" + corners +
           "\n" + cells + data;
}
const std::string two_cells = "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10\n10\n";

std::string xml(const std::string& inside, const std::string& attributes = "") {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"" + attributes +
           ">\n<UnstructuredGrid>\n" + inside + "</UnstructuredGrid>\n</VTKFile>\n";
}

std::string array(const std::string& name, const std::string& numbers, const std::string& type = "Int32") {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n", type, name, numbers);
}

std::string piece(const std::string& data, const std::string& ends = "4 8") {
    return "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<Points>\n" + array("Points", corners, "Float64") +
           "</Points>\n<Cells>\n" + array("connectivity", "0 1 2 3 1 2 3 4") + array("offsets", ends) +
           array("types", "10 10", "UInt8") + "</Cells>\n<CellData>\n" + data + "</CellData>\n</Piece>\n";
}

enum class Packed { no, zlib, lz4 };

std::string packed_by(Packed packed, const std::string& bytes) {
    if (packed == Packed::zlib) return deflated(bytes);
    const int length = static_cast<int>(bytes.size());
    std::string block(static_cast<std::size_t>(LZ4_compressBound(length)), '\0');
    block.resize(static_cast<std::size_t>(
        LZ4_compress_default(bytes.data(), block.data(), length, static_cast<int>(block.size()))));
    return block;
}

/// The same mesh with its numbers in binary: inline or appended, packed or not.
std::string binary_xml(bool appended, Packed packed) {
    std::string data;
    const auto number = [](std::uint32_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
    const auto add = [&](const char* name, const char* type, const std::string& bytes, int components) {
        std::string coded, raw;
        if (packed != Packed::no) {
            const std::string stream = packed_by(packed, bytes);
            const std::string header = number(1) + number(static_cast<std::uint32_t>(bytes.size())) + number(0) +
                                       number(static_cast<std::uint32_t>(stream.size()));
            raw = header + stream;
            coded = base64(header) + base64(stream);
        } else {
            raw = number(static_cast<std::uint32_t>(bytes.size())) + bytes;
            coded = base64(raw);
        }
        const std::string start =
            fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, name, components);
        if (!appended) return fmt::format("{} format=\"binary\">\n{}\n</DataArray>\n", start, coded);
        const std::string element = fmt::format("{} format=\"appended\" offset=\"{}\"/>\n", start, data.size());
        data += raw;
        return element;
    };
    const auto bytes_of = [](const auto& numbers) {
        return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]);
    };
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<std::int32_t> ids{0, 1, 2, 3, 1, 2, 3, 4}, ends{4, 8};
    std::string text = "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<Points>\n";
    text += add("Points", "Float64", bytes_of(points), 3) + "</Points>\n<Cells>\n";
    text += add("connectivity", "Int32", bytes_of(ids), 1) + add("offsets", "Int32", bytes_of(ends), 1);
    text += add("types", "UInt8", "\x0a\x0a", 1) + "</Cells>\n</Piece>\n";
    const std::array compressors{"", " compressor=\"vtkZLibDataCompressor\"", " compressor=\"vtkLZ4DataCompressor\""};
    text = xml(text, compressors[static_cast<std::size_t>(packed)]);
    if (!appended) return text;
    return text.replace(text.find("</VTKFile>"), 0,
                        "<AppendedData encoding=\"raw\">\n_" + data + "\n</AppendedData>\n");
}

double volume_of(const Grid3d& grid) {
    double volume = 0;
    for (const auto& block : grid.blocks)
        for (const Polyhedron& part : solid_from_surface(surface_of(grid, block)).parts)
            volume += mass_properties(part).volume;
    return volume;
}

std::string message_of(const std::string& bytes) {
    try {
        const Grid3d grid = read_vtk_blocks(bytes, "a.vtk");
        if (grid.blocks.empty()) read_vtk_surfaces(bytes, "a.vtk");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

std::string with(std::string text, const std::string& old, const std::string& other) {
    const std::size_t at = text.find(old);
    if (at == std::string::npos) throw std::logic_error("not in the text: " + old);
    return text.replace(at, old.size(), other);
}

constexpr double two_volumes = 1. / 6 + 1. / 3;

} // namespace

TEST(VtkFiles, ZonesAreTheSameInAllEncodings) {
    std::vector<std::string> texts{legacy(two_cells), xml(piece(""))};
    for (const bool appended : {false, true})
        for (const Packed packed : {Packed::no, Packed::zlib, Packed::lz4})
            texts.push_back(binary_xml(appended, packed));
    for (const std::string& text : texts) {
        const Grid3d grid = read_vtk_blocks(text, "a");
        ASSERT_EQ(grid.blocks.size(), 1U);
        EXPECT_EQ(grid.blocks[0].zones.size(), 2U);
        EXPECT_DOUBLE_EQ(volume_of(grid), two_volumes);
    }
}

TEST(VtkFiles, PiecesAreOneMesh) {
    const Grid3d grid = read_vtk_blocks(xml(piece(array("region", "1 1")) + piece(array("region", "1 2"))), "a");
    ASSERT_EQ(grid.blocks.size(), 3U); // the second piece has its own points
    EXPECT_EQ(grid.blocks[2].region, 2);
    EXPECT_EQ(grid.gridpoints.size(), 10U);
}

TEST(VtkFiles, CellsOfHigherOrderByTheirCorners) {
    std::string text = "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 float\n";
    text += "0 0 0 2 0 0 0 2 0 0 0 2  1 0 0 1 1 0 0 1 0  0 0 1 1 0 1 0 1 1\n";
    text += "CELLS 2 12\n10 0 1 2 3 4 5 6 7 8 9\n0\nCELL_TYPES 2\n24 0\n";
    EXPECT_DOUBLE_EQ(volume_of(read_vtk_blocks(text, "a")), 8. / 6);
    EXPECT_DOUBLE_EQ(volume_of(read_vtk_blocks(with(text, "24 0", "71 0"), "a")), 8. / 6);
    EXPECT_EQ(message_of(with(text, "24 0", "25 0")), "a.vtk, cell 0: a hexahedron of type 25 has 10 nodes");
    EXPECT_EQ(message_of(with(text, "24 0", "41 0")), "a.vtk, cell 0: it is of type 41, which is not read");
}

TEST(VtkFiles, LabelsGiveGroupsRegionsAndMaterials) {
    const auto blocks = [](const std::string& data) { return read_vtk_blocks(legacy(two_cells, data), "a").blocks; };
    const auto region = blocks("CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n3\n0\n");
    ASSERT_EQ(region.size(), 2U);
    EXPECT_EQ(region[0].group, "region-3");
    EXPECT_EQ(region[0].region, 3);
    EXPECT_EQ(region[1].group, "");
    const auto named =
        blocks("CELL_DATA 2\nFIELD FieldData 2\nmaterial 1 2 int\n2 5\ngroup 1 2 string\nleft%20wall\n\n");
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[0].group, "left wall");
    EXPECT_EQ(named[0].material, 2);
    EXPECT_EQ(named[1].group, "");
    EXPECT_EQ(named[1].material, 5);
    EXPECT_EQ(blocks("CELL_DATA 2\nSCALARS block_id int\n1 2\n").size(), 2U);
    EXPECT_EQ(blocks("CELL_DATA 2\nSCALARS material double\nLOOKUP_TABLE default\n0.5 0.25\n").size(), 1U); // a field
    EXPECT_EQ(blocks("CELL_DATA 2\nVECTORS region double\n1 2 3 4 5 6\n").size(), 1U);
    EXPECT_EQ(blocks("POINT_DATA 5\nSCALARS region int\n1 2 3 4 5\n").size(), 1U);
    const auto listed = read_vtk_blocks(
        xml("<FieldData>\n<Array type=\"String\" Name=\"group_names\" format=\"ascii\">97 0 98 32 99 0</Array>\n</FieldData>\n" +
            piece(array("group", "1 -1"))),
        "a");
    ASSERT_EQ(listed.blocks.size(), 2U);
    EXPECT_EQ(listed.blocks[0].group, "b c");
    EXPECT_EQ(listed.blocks[1].group, "");
}

TEST(VtkFiles, PolyhedraInTheLayoutOfVtk94) {
    const std::string points = "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>\n" +
                               array("Points", "0 0 0 1 0 0 0 1 0 0 0 1", "Float32") + "</Points>\n<Cells>\n" +
                               array("connectivity", "0 1 2 3") + array("offsets", "4") + array("types", "42");
    const std::string text =
        xml(points + array("face_connectivity", "0 2 1 0 1 3 1 2 3 2 0 3") + array("face_offsets", "3 6 9 12") +
            array("polyhedron_to_faces", "0 1 2 3") + array("polyhedron_offsets", "4") + "</Cells>\n</Piece>\n");
    const Grid3d grid = read_vtk_blocks(text, "a");
    ASSERT_EQ(grid.blocks.size(), 1U);
    EXPECT_EQ(grid.blocks[0].faces.size(), 4U);
    EXPECT_DOUBLE_EQ(volume_of(grid), 1. / 6);
    EXPECT_EQ(message_of(with(text, ">\n0 1 2 3\n</DataArray>\n<DataArray type=\"Int32\" Name=\"polyhedron_offsets",
                              ">\n0 1 2 9\n</DataArray>\n<DataArray type=\"Int32\" Name=\"polyhedron_offsets")),
              "a.vtk, cell 0: it has face 9, and there are 4");
    EXPECT_EQ(message_of(xml(points + "</Cells>\n</Piece>\n")), "a.vtk, cell 0: a polyhedron has no faces");
}

TEST(VtkFiles, MessagesNameLineOrCell) {
    EXPECT_EQ(message_of("nothing"), "a.vtk is not a file of VTK: it begins with neither '# vtk DataFile' nor XML");
    EXPECT_EQ(message_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n"),
              "a.vtk, line 4: the file ends before the points of the structured_grid");
    EXPECT_EQ(message_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET FIELD\n"),
              "a.vtk, line 4: the data are a FIELD; UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_GRID, RECTILINEAR_GRID and "
              "STRUCTURED_POINTS are read");
    EXPECT_EQ(message_of(with(legacy(two_cells), "1 1 1", "1 1 one")), "a.vtk, line 6: 'one' is not a number");
    EXPECT_EQ(message_of(with(legacy(two_cells), "POINTS 5", "POINTS 5e9")),
              "a.vtk, line 5: the number of points is 5000000000, more than the file can hold");
    EXPECT_EQ(message_of(with(legacy(two_cells), "1 2 3 4\n", "1 2 3 5\n")),
              "a.vtk, cell 1: it has point 5, and there are 5 points, counted from 0");
    EXPECT_EQ(message_of(with(legacy(two_cells), "4 1 2 3 4", "9 1 2 3 4")),
              "a.vtk, cell 1: it has 9 corners, and the list ends before");
    EXPECT_EQ(message_of(with(legacy(two_cells), "4 1 2 3 4", "4 1 2 3 3")), "a.vtk: tetrahedron 1 has no volume");
    EXPECT_EQ(message_of(legacy(two_cells, "SOMETHING 3\n")),
              "a.vtk, line 13: a section cannot begin with 'SOMETHING'");
    EXPECT_EQ(message_of(legacy(two_cells, "CELL_DATA 2\nSCALARS region int\n1\n")),
              "a.vtk, line 16: the file ends after 1 of 2 numbers");
    EXPECT_EQ(message_of(legacy("")), "a.vtk: there is no cell and no face in it");
    EXPECT_EQ(
        message_of(xml(piece(""), " compressor=\"vtkLZMADataCompressor\"")),
        "a.vtk: it is compressed by vtkLZMADataCompressor; vtkZLibDataCompressor and vtkLZ4DataCompressor are read");
    EXPECT_EQ(message_of(xml(piece("", "4 x"))), "a.vtk, line 15: 'x' is not a number");
    EXPECT_EQ(message_of(xml(piece("", "4"))), "a.vtk, line 14: there are 1 numbers, and the cells need 2");
    EXPECT_EQ(message_of(xml(piece(array("region", "1 2 3")))), "a.vtk, line 22: 'region' has 3 values for 2 cells");
    EXPECT_EQ(message_of(with(xml(piece("")), "</Cells>", "</Cell>")), "a.vtk, line 20: mismatched tag");
    EXPECT_EQ(message_of("<!DOCTYPE a [<!ENTITY b \"c\">]>\n<VTKFile/>"),
              "a.vtk, line 1: a file of VTK has no DOCTYPE");
    EXPECT_EQ(message_of("<html/>"), "a.vtk, line 1: the file begins with <html>, not with <VTKFile>");
    EXPECT_EQ(message_of(with(xml(piece("")), "offsets", "region")),
              "a.vtk, line 4: Cells of the Piece has no offsets");
}

TEST(VtkFiles, ClaimsBeyondTheFileTakeNoMemory) {
    // A stream that says that it stands for gigabytes, and arrays that all name the same data.
    for (const Packed packed : {Packed::zlib, Packed::lz4}) {
        const std::string text = binary_xml(true, packed);
        const std::size_t data = text.find("\n_") + 2;
        const auto claims = [&](std::size_t at, std::uint32_t number) {
            std::string claim = text;
            std::memcpy(claim.data() + data + at, &number, sizeof number);
            return message_of(claim);
        };
        constexpr std::uint32_t huge = 0xfffffff0, more_than_a_stream = 100'000; // which the file could hold
        const std::string damaged = "a.vtk, line 6: its data are cut off or damaged";
        EXPECT_EQ(claims(0, huge), damaged);
        EXPECT_EQ(claims(4, huge), "a.vtk, line 6: the arrays claim more data than the file can hold");
        EXPECT_EQ(claims(4, more_than_a_stream), damaged);
        EXPECT_EQ(claims(4, 121), damaged); // of 120 bytes
        EXPECT_EQ(claims(12, huge), damaged);
        EXPECT_EQ(claims(12, 10), damaged);
    }
    EXPECT_EQ(message_of(xml(piece(array("region", "1 2") + array("region", "1 2")))),
              "a.vtk, line 25: CellData has two arrays 'region'");
    std::string deep;
    for (int k = 0; k < 10000; ++k) deep += "<a>";
    EXPECT_EQ(message_of(xml(deep)), "a.vtk, line 4: the elements are nested too deeply");
}

TEST(VtkFiles, CutOffAndDamagedFilesEndInAMessageNeverInACrash) {
    const std::vector<std::string> files{
        legacy(two_cells, "CELL_DATA 2\nFIELD FieldData 2\nmaterial 1 2 int\n2 5\ngroup 1 2 string\nleft%20wall\n\n"),
        xml(piece(array("region", "1 2"))),
        binary_xml(false, Packed::no),
        binary_xml(false, Packed::zlib),
        binary_xml(false, Packed::lz4),
        binary_xml(true, Packed::no),
        binary_xml(true, Packed::zlib),
        binary_xml(true, Packed::lz4)};
    Random random(71);
    int refused = 0;
    const auto read = [&](const std::string& bytes) {
        try {
            const Grid3d grid = read_vtk_blocks(bytes, "a");
            for (const auto& block : grid.blocks) {
                const Solid solid = solid_from_surface(surface_of(grid, block));
                if (!block.zones.empty() && solid.parts.size() == 1) zones_of(grid, block, solid.parts[0]);
            }
            read_vtk_surfaces(bytes, "a");
        } catch (const Diagnostic&) { ++refused; }
    };
    for (int trial = 0; trial < 1000; ++trial) {
        const std::string& file = files[static_cast<std::size_t>(trial) % files.size()];
        read(file.substr(0, static_cast<std::size_t>(random.uniform() * static_cast<double>(file.size()))));
    }
    EXPECT_GT(refused, 900);
    refused = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        std::string damaged = files[static_cast<std::size_t>(trial) % files.size()];
        for (int i = 0; i < 2; ++i)
            damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(damaged.size()))] =
                static_cast<char>(random.bits() & 255);
        read(damaged);
    }
    EXPECT_GT(refused, 1500);
}
