#include "scenes.hpp"

#include "format_files.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

constexpr std::array models{
    // Rigid blocks.
    R"(poly brick 0 1 0 1 0 1
poly brick 0 1 0 1 1 2
poly brick 1 2 0 1 0 1
)",
    // With zones, and water.
    R"(poly brick 0 1 0 1 0 1
poly brick 0 1 0 1 1 2
poly tet 0 0 2  1 0 2  0 1 2  0 0 3
gen edge 0.7 range z 0 1
zone model mohr-coulomb
)",
    // Cut by joints, some of them joined.
    R"(poly brick 0 2 0 1 0 2
jset dip 35 dd 90 origin 1 0.5 1
jset dip 80 dd 270 spacing 0.6 num 2 org 1 0.5 1 join
)",
    // Structures.
    R"(poly brick 0 1 0 1 0 1
poly brick 0 1 0 1 1 2
structure property 1 area 1e-4 young 2e11 kbond 1e7 sbond 1e4
structure cable 0.5 0.5 1.8 0.5 0.5 0.2 segments 4
structure property 2 area 1e-3 young 2e11 density 7800 moi-y 1e-7 moi-z 1e-7 plastic-moment 1e3
structure beam 0.2 0.5 1.8 0.5 0.5 0.2 3 0.5 0.2 segments 4 property 2 anchor all
structure property 3 thickness 0.05 young 2e10 density 2400 kn 1e9 ks 1e8 tension 1e3
structure liner property 3 edge 0.6 range y -0.01 0.01
)",
    // Blocks of files, and a joint model in Lua.
    R"(import block.stl
import block.msh
poly brick 0 1 0 1 -1 0
)",
};

constexpr const char* conditions = R"(prop mat 1 dens 2000 bulk 1e8 shear 6e7
fix range z 0 0.9
gravity 0 0 -10
hist unbal
hist zdis 0.5 0.5 1.5
range name low z 0 1
range name upper z 1 3
group block joints range z 0 1
table 1 0 0 1 1
mark region 2 range z 1 3
def twice(a)
  twice = 2 * a
end
def here
  here = b_z(block_head)
end
set @v = 2 @load = 5e3
)";

constexpr std::array laws{
    "jmodel model mohr\njmodel jkn 1e8 jks 1e8 jfric 30\n",
    "jmodel model elastic jkn 1e8 jks 5e7\n",
    "jmodel model barton-bandis\njmodel jkn 1e8 jks 1e8 resfriction 20 jrco 8 jcso 100 sigmac 150 lo 0.1 ln 0.2\n",
    "jmodel model nonlinear\njmodel jkn 1e7 jks 1e7 jen 0.5 jes 0.3 fric 30\n",
    "jmodel model ./slip.lua\njmodel kn 1e8 ks 1e8 friction 20\n",
};

constexpr std::array<std::array<double, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 4> triangles{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

std::string tetrahedron(const std::string& head, const char* corner, const std::string& middle, const char* triangle,
                        int first, const std::string& end) {
    std::string text = head;
    for (const auto& p : corners) text += fmt::format(fmt::runtime(corner), p[0], p[1], p[2]);
    text += middle;
    for (const auto& t : triangles)
        text += fmt::format(fmt::runtime(triangle), t[0] + first, t[1] + first, t[2] + first);
    return text + end;
}

std::string stl_text() {
    std::string text = "solid block\n";
    for (const auto& t : triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int v : t) text += fmt::format("vertex {} {} {}\n", corners[v][0], corners[v][1], corners[v][2]);
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid block\n";
}

template <class Number> void put(std::string& bytes, Number value, bool big_endian = false) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(bytes.end() - sizeof value, bytes.end());
}

std::string stl_binary() {
    std::string bytes(80, ' ');
    put(bytes, static_cast<std::uint32_t>(triangles.size()));
    for (const auto& t : triangles) {
        for (int k = 0; k < 3; ++k) put(bytes, 0.0f);
        for (const int v : t)
            for (const double x : corners[v]) put(bytes, static_cast<float>(x));
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

constexpr const char* ply_elements = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                                     "element face 4\nproperty list uchar int vertex_indices\nend_header\n";

std::string ply_binary(bool big_endian) {
    std::string bytes =
        fmt::format("ply\nformat binary_{}_endian 1.0\n{}", big_endian ? "big" : "little", ply_elements);
    for (const auto& p : corners)
        for (const double x : p) put(bytes, static_cast<float>(x), big_endian);
    for (const auto& t : triangles) {
        put(bytes, std::uint8_t{3});
        for (const int v : t) put(bytes, static_cast<std::int32_t>(v), big_endian);
    }
    return bytes;
}

// Concave: two blocks, joined.
constexpr const char* step = R"(o step
g rock
v 0 0 0
v 2 0 0
v 2 0 1
v 1 0 1
v 1 0 2
v 0 0 2
v 0 1 0
v 2 1 0
v 2 1 1
v 1 1 1
v 1 1 2
v 0 1 2
f 1 2 3 4 5 6
f -1 -2 -3 -4 -5 -6
f 1 7 8 2
f 2 8 9 3
f 3/1/1 9/1/1 10/1/1 4/1/1
f 4 10 11 5
f 5 11 12 6
f 6 12 7 1
)";

constexpr const char* msh_new = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "rock mass"
$EndPhysicalNames
$Entities
0 0 0 1
5 0 0 0 1 1 1 1 7 0
$EndEntities
$Nodes
1 5 1 5
3 5 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
1 2 1 2
3 5 4 2
1 1 2 3 4
2 2 3 4 5
$EndElements
)";

constexpr const char* msh_old = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
$EndNodes
$Elements
1
1 5 2 7 3 1 2 3 4 5 6 7 8
$EndElements
)";

constexpr const char* grid = R"(* two blocks, one of them with a zone
TOL 1e-6
G 1 0 0 0
G 2 1 0 0
G 3 0 1 0
G 4 0 0 1
G 5 0 0 -1
F 1 1 3 2
F 2 1 2 4
F 3 2 3 4
F 4 1 4 3
Z 1 1 2 3 5
B 1 2 F 1 2 3 4
B 2 1 Z 1
JS 3 1-2
BGROUP upper 1
)";

constexpr const char* lua_model = R"(local function run(s, p, h)
    s.normal_force = math.max(0, s.normal_force - p.kn * s.area * s.normal_disp_inc)
    local k = p.ks * s.area
    s.shear_force_x = s.shear_force_x - k * s.shear_disp_inc_x
    s.shear_force_y = s.shear_force_y - k * s.shear_disp_inc_y
    s.shear_force_z = s.shear_force_z - k * s.shear_disp_inc_z
    local shear = math.sqrt(s.shear_force_x ^ 2 + s.shear_force_y ^ 2 + s.shear_force_z ^ 2)
    local limit = s.normal_force * math.tan(math.rad(p.friction))
    s.state = 0
    if shear > limit then
        h.slip = h.slip + (shear - limit) / k
        local scale = limit / shear
        s.shear_force_x, s.shear_force_y = s.shear_force_x * scale, s.shear_force_y * scale
        s.shear_force_z = s.shear_force_z * scale
        s.state = 1
    end
end
return {
    name = "slip",
    title = "friction",
    version = "1.0",
    properties = {
        {"kn", "jkn", unit = "stress/length", minimum = 0, help = "normal"},
        {"ks", "jks", unit = "stress/length", minimum = 0, help = "shear"},
        {"friction", "fric jfriction", unit = "angle", initial = 0, minimum = 0, maximum = 89},
    },
    history = {"slip"},
    states = {"slips"},
    run = run,
    stiffness = function(p) return p.kn, p.ks end,
}
)";

constexpr const char* pit = R"(# a pit from its toe, with a ramp
bench 15
benches 2
angle 65
berm 8
ramp 20 0.1 from 200 0 clockwise
toe
100 100 240
500 100 240
500 400 240
100 400 240
)";

} // namespace

std::string scene(Chance& c) {
    if (c.heads(0.05)) return {};
    return std::string(c.of(models)) + conditions + c.of(laws);
}

std::string cycles(Chance& c) {
    switch (c.below(8)) {
    case 0: return "solve cycles 20\n";
    case 1: return "solve ratio 1e-2 cycles 10\n";
    case 2: return fmt::format("step {}\n", 1 + c.below(5));
    default: return fmt::format("cycle {}\n", 1 + c.below(20));
    }
}

const std::vector<Sample>& samples() {
    static const std::vector<Sample> all = [] {
        std::vector<Sample> result = format_files();
        const std::vector<Sample> others{
            {"block.stl", stl_text()},
            {"coded.stl", stl_binary()},
            {"stone.obj", tetrahedron("o one\n", "v {} {} {}\n", "", "f {} {} {}\n", 1, "")},
            {"block.ply", tetrahedron(std::string("ply\nformat ascii 1.0\n") + ply_elements, "{} {} {}\n", "",
                                      "3 {} {} {}\n", 0, "")},
            {"step.obj", step},
            {"coded.ply", ply_binary(false)},
            {"turned.ply", ply_binary(true)},
            {"block.wrl", tetrahedron("#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [\n",
                                      "{} {} {},\n", "] } coordIndex [\n", "{}, {}, {}, -1,\n", 0, "] } }\n")},
            {"block.msh", msh_new},
            {"old.msh", msh_old},
            {"block.3dgrid", grid},
            {"crest.pit", pit},
            {"ground.xyz", "# rings\n0 0 2\n10 0 3\n10 8 3\n0 8 2\n0 0 2\n\n3 2 1\n7 2 1\n7 6 1\n3 6 1\n3 2 1\n"},
            {"ground.asc", "ncols 4\nnrows 3\nxllcorner -1\nyllcenter 0\ncellsize 4\nNODATA_value -9999\n"
                           "2 3 2 1\n1 2 3 2\n2 2 -9999 1\n"},
            {"waves.tab", "quake\n4 0.01\n1\n2\n-1\n0.5\n"},
            {"pairs.tab", "pairs\n3 0\n0 1\n1 2\n2 -1\n"},
            {"slip.lua", lua_model},
        };
        result.insert(result.end(), others.begin(), others.end()); // slip.lua is the last
        return result;
    }();
    return all;
}

} // namespace kaya::soak
