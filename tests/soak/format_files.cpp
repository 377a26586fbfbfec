#include "format_files.hpp"

#include "base/base64.hpp"
#include "geometry/grid/file_formats.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <string>

namespace kaya::soak {

namespace {

constexpr const char* f3grid = R"(* a brick of zones and a tetrahedron
G 1 0 0 0
G 2 1 0 0
G 3 0 1 0
G 4 0 0 1
G 5 1 1 0
G 6 0 1 1
G 7 1 0 1
G 8 1 1 1
G 9 0 0 2
Z B8 1 1 2 3 4 5 6 7 8
Z T4 2 4 7 6 9
F Q4 1 1 2 5 3
FGROUP "floor" SLOT Default
1
ZGROUP "rock" SLOT 1
1
ZGROUP "tip" SLOT 1
2
)";

constexpr const char* tess = R"(***tess
 **format
   3.4
 **general
   3 standard
 **vertex
   4
   1 0 0 0 0
   2 1 0 0 0
   3 0 1 0 0
   4 0 0 1 0
 **face
   4
   1 3 1 3 2
     3 1 2 3
     0 0 0 1
     0 0 0 0 0
   2 3 1 2 4
     3 1 2 3
     0 0 1 0
     0 0 0 0 0
   3 3 2 3 4
     3 1 2 3
     1 1 1 1
     0 0 0 0 0
   4 3 3 1 4
     3 1 2 3
     0 1 0 0
     0 0 0 0 0
 **polyhedron
   1
   1 4 1 2 -3 4
***end
)";

constexpr const char* gocad = R"(GOCAD TSurf 1
HEADER {
name: fault
}
ZPOSITIVE Elevation
TFACE
VRTX 1 0 0 0
PVRTX 2 1 0 0 0.5
VRTX 3 0 1 0
VRTX 4 0 0 1
ATOM 5 1
TRGL 1 3 2
TRGL 5 2 4
TRGL 2 3 4
TRGL 3 5 4
END
)";

constexpr const char* compas = R"({"data": {"node": {"0": {"block": {"name": "key", "data": {
 "vertex": {"0": {"x": 0, "y": 0, "z": 0}, "1": {"x": 1, "y": 0, "z": 0},
            "2": {"x": 0, "y": 1, "z": 0}, "3": {"x": 0, "y": 0, "z": 1}},
 "face": {"0": [0, 2, 1], "1": [0, 1, 3], "2": [1, 2, 3], "3": [2, 0, 3]}}}}}}}
)";

/// A tetrahedron of 3DFACEs.
std::string dxf() {
    constexpr int corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    std::string text = "0\nSECTION\n2\nENTITIES\n";
    for (const auto& face : faces) {
        text += "0\n3DFACE\n8\nstones\n";
        for (int k = 0; k < 4; ++k)
            for (int axis = 0; axis < 3; ++axis)
                text += std::to_string(10 * (axis + 1) + k) + "\n" +
                        std::to_string(corners[face[k < 3 ? k : 2]][axis]) + "\n";
    }
    return text + "0\nENDSEC\n0\nEOF\n";
}

constexpr const char* vtk = R"(# vtk DataFile Version 3.0
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 2 10
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 2
10
10
CELL_DATA 2
SCALARS region int 1
LOOKUP_TABLE default
1
2
FIELD FieldData 1
group 1 2 string
left%20wall
right
)";

constexpr const char* vtp = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" byte_order="LittleEndian">
<PolyData>
<Piece NumberOfPoints="4" NumberOfPolys="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 2 1 0 1 3 1 2 3 2 0 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray>
</Polys>
<CellData><Array type="String" Name="group" format="ascii">97 0 97 0 97 0 97 0</Array></CellData>
</Piece>
</PolyData>
</VTKFile>
)";

/// Numbers with their highest byte first.
std::string big_endian(std::initializer_list<double> reals, std::initializer_list<std::int32_t> whole) {
    std::string bytes;
    const auto add = [&](const auto number) {
        const auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
        bytes.append(raw.rbegin(), raw.rend());
    };
    for (const double number : reals) add(number);
    for (const std::int32_t number : whole) add(number);
    return bytes;
}

std::string vtk_binary() {
    return "# vtk DataFile Version 3.0\n\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" +
           big_endian({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {}) + "\nCELLS 1 5\n" + big_endian({}, {4, 0, 1, 2, 3}) +
           "\nCELL_TYPES 1\n" + big_endian({}, {10}) + "\n";
}

/// A tetrahedron as a polyhedron, and one as a zone, as kaya exports them: packed and appended.
std::string vtu() {
    Grid3d grid;
    grid.gridpoints = {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {0, 1, 0}}, {4, {0, 0, 1}}, {5, {1, 1, 1}}};
    grid.faces = {{1, {1, 3, 2}}, {2, {1, 2, 4}}, {3, {2, 3, 4}}, {4, {3, 1, 4}}};
    grid.zones = {{1, {2, 3, 4, 5}}};
    grid.blocks = {{1, 2, {1, 2, 3, 4}, {}, "wall", 1}, {2, 0, {}, {1}, "", 1}};
    return write_vtu(grid);
}

/// The same with base64 in place of appended data.
std::string vtu_coded() {
    const auto array = [](const char* type, const char* name, const std::string& bytes) {
        const auto size = static_cast<std::int32_t>(bytes.size());
        const auto raw = std::bit_cast<std::array<char, sizeof size>>(size);
        const std::string header(raw.rbegin(), raw.rend());
        return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" format=\"binary\">" +
               base64(header + bytes) + "</DataArray>\n";
    };
    return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\">\n<UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>" +
           array("Float64", "Points", big_endian({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {})) + "</Points>\n<Cells>" +
           array("Int32", "connectivity", big_endian({}, {0, 1, 2, 3})) +
           array("Int32", "offsets", big_endian({}, {4})) + array("UInt8", "types", "\x0a") +
           "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

} // namespace

std::vector<Sample> format_files() {
    return {{"zones.f3grid", f3grid}, {"cells.tess", tess},      {"fault.ts", gocad},         {"stones.dxf", dxf()},
            {"blocks.json", compas},  {"mesh.vtk", vtk},         {"coded.vtk", vtk_binary()}, {"stone.vtp", vtp},
            {"packed.vtu", vtu()},    {"coded.vtu", vtu_coded()}};
}

} // namespace kaya::soak
