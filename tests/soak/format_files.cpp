#include "format_files.hpp"

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

} // namespace

std::vector<Sample> format_files() {
    return {{"zones.f3grid", f3grid},
            {"cells.tess", tess},
            {"fault.ts", gocad},
            {"stones.dxf", dxf()},
            {"blocks.json", compas}};
}

} // namespace kaya::soak
