// Readers of further formats: what they hold, the messages of wrong files, and damaged files.
#include "geometry/grid/grid3d.hpp"
#include "geometry/read/surface_files.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

// All four shapes of zones with FLAC3D's order of corners: a brick of 1 x 2 x 3, a wedge, a pyramid and a tetrahedron next to it.
const std::string f3grid =
    "* grid\n*GRIDPOINTS\n"
    "G 1 0 0 0\nG 2 1 0 0\nG 3 0 2 0\nG 4 0 0 3\nG 5 1 2 0\nG 6 0 2 3\nG 7 1 0 3\nG 8 1 2 3\n"
    "G 11 5 0 0\nG 12 6 0 0\nG 13 5 2 0\nG 14 5 0 3\nG 15 6 2 0\nG 16 5 2 3\n"
    "G 21 9 0 0\nG 22 10 0 0\nG 23 9 2 0\nG 24 9 0 3\nG 25 10 2 0\n"
    "G 31 0 9 0\nG 32 1 9 0\nG 33 0 10 0\nG 34 0 9 1\n"
    "*ZONES\nZ B8 1 1 2 3 4 5 6 7 8\nZ W6 2 11 12 13 14 15 16\nZ P5 5 21 22 23 24 25\nZ T4 9 31 32 33 34\n"
    "*FACES\nF Q4 1 1 2 5 3\nF T3 2 31 32 33\nFGROUP \"bottom\" SLOT Default\n1 2\n"
    "*ZONE GROUPS\nZGROUP \"block 1\" SLOT 1\n1\n2\n\nZGROUP small\n 5 9\nZGROUP \"again\" SLOT 2\n1 5\n";

const std::string tess =
    "***tess\n **format\n   3.4\n **general\n   3 standard\n **cell\n   2\n  *id\n   1 2\n"
    " **vertex\n   9\n"
    "   1 0 0 0 0\n   2 1 0 0 0\n   3 1 1 0 0\n   4 0 1 0 0\n   5 0 0 1 0\n   6 1 0 1 0\n   7 1 1 1 0\n"
    "   8 0 1 1 0\n   9 0.5 0.5 2 0\n"
    " **edge\n   1\n   1 1 2 0\n"
    " **face\n   10\n"
    "   1 4 1 4 3 2\n     4 1 2 3 4\n     0 0 0 1\n     0 0 0 0 0\n"
    "   2 4 5 6 7 8\n     4 1 2 3 4\n     1 0 0 1\n     0 0 0 0 0\n"
    "   3 4 1 2 6 5\n     4 1 2 3 4\n     0 0 1 0\n     0 0 0 0 0\n"
    "   4 4 2 3 7 6\n     4 1 2 3 4\n     1 1 0 0\n     0 0 0 0 0\n"
    "   5 4 3 4 8 7\n     4 1 2 3 4\n     1 0 1 0\n     0 0 0 0 0\n"
    "   6 4 4 1 5 8\n     4 1 2 3 4\n     0 1 0 0\n     0 0 0 0 0\n"
    "   7 3 5 6 9\n     3 1 2 3\n     0 0 1 0\n     0 0 0 0 0\n"
    "   8 3 6 7 9\n     3 1 2 3\n     0 0 1 0\n     0 0 0 0 0\n"
    "   9 3 7 8 9\n     3 1 2 3\n     0 0 1 0\n     0 0 0 0 0\n"
    "   10 3 8 5 9\n     3 1 2 3\n     0 0 1 0\n     0 0 0 0 0\n"
    " **polyhedron\n   2\n   1 6 1 2 3 4 5 6\n   2 5 -2 7 8 9 10\n***end\n";

const std::string gocad =
    "GOCAD TSurf 1\nHEADER {\nname: fault 7\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Elevation\n"
    "END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\nVRTX 1 0 0 0\nPVRTX 2 1 0 0 0.5\nVRTX 3 0 1 0\nTFACE\n"
    "VRTX 4 0 0 1\nATOM 5 1\nTRGL 1 3 2\nTRGL 5 2 4\nTRGL 2 3 4\nTRGL 3 5 4\nEND\n"
    "GOCAD TSurf 1\nHEADER {\n*name:deep\n}\nZPOSITIVE Depth\nVRTX 1 0 0 0\nVRTX 2 2 0 0\nVRTX 3 0 1 0\n"
    "VRTX 4 0 0 1\nTRGL 1 3 2\nTRGL 1 2 4\nTRGL 2 3 4\nTRGL 3 1 4\nEND\n";

/// A tetrahedron of 3DFACEs, and one as a polyface mesh.
std::string dxf() {
    const std::array<Vec3, 4> p{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    constexpr std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    std::string text = "999\nby hand\n0\nSECTION\n2\nENTITIES\n";
    for (const auto& f : faces) {
        text += "  0\n3DFACE\n  8\nstone 1\n";
        for (int k = 0; k < 4; ++k) {
            const Vec3& v = p[static_cast<std::size_t>(f[static_cast<std::size_t>(std::min(k, 2))])];
            text += fmt::format(" {}\n{}\n {}\n{}\n {}\n{}\n", 10 + k, v.x(), 20 + k, v.y(), 30 + k, v.z());
        }
    }
    text += "0\nPOLYLINE\n8\nstone 2\n66\n1\n70\n64\n71\n4\n72\n4\n";
    for (const Vec3& v : p)
        text += fmt::format("0\nVERTEX\n8\nstone 2\n10\n{}\n20\n{}\n30\n{}\n70\n192\n", 5 + v.x(), v.y(), v.z());
    for (const auto& f : faces)
        text += fmt::format("0\nVERTEX\n8\nstone 2\n10\n0\n20\n0\n30\n0\n70\n128\n71\n{}\n72\n{}\n73\n{}\n", f[0] + 1,
                            -(f[1] + 1), f[2] + 1);
    return text + "0\nSEQEND\n0\nENDSEC\n0\nEOF\n";
}

const std::string compas = R"({"dtype": "compas_assembly/Assembly", "data": {"graph": {"node": {
 "0": {"block": {"dtype": "compas.datastructures/Mesh", "name": "keystone", "data": {
  "vertex": {"0": {"x": 0, "y": 0, "z": 0}, "1": {"x": 1.0, "y": 0, "z": 0}, "2": {"x": 0, "y": 1e0, "z": 0}, "7": {"z": 1, "x": 0, "y": 0}},
  "face": {"0": [0, 2, 1], "1": [0, 1, 7], "2": [1, 2, 7], "3": [2, 0, 7]}, "max_face": 3}}},
 "1": {"block": {"name": "plain \"one\"", "vertices": [[0, 0, 5], [2, 0, 5], [0, 1, 5], [0, 0, 6]],
  "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], "flag": true, "none": null}}}}}}
)";

double volume_of(const Grid3d& grid) {
    double volume = 0;
    for (const auto& block : grid.blocks)
        for (const Polyhedron& part : solid_from_surface(surface_of(grid, block)).parts)
            volume += mass_properties(part).volume;
    return volume;
}

double volume_of(const NamedSurface& body) {
    double volume = 0;
    for (const Polyhedron& part : solid_from_surface(body.surface).parts) volume += mass_properties(part).volume;
    return volume;
}

template <class Read> std::string message_of(Read read, std::string_view text) {
    try {
        read(text, "file");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

/// The text with its first `old` in other words.
std::string with(std::string text, const std::string& old, const std::string& other) {
    const std::size_t at = text.find(old);
    if (at == std::string::npos) throw std::logic_error("not in the text: " + old);
    return text.replace(at, old.size(), other);
}

} // namespace

TEST(Formats, F3gridZonesOfAllShapes) {
    const Grid3d grid = read_f3grid(f3grid, "file");
    ASSERT_EQ(grid.blocks.size(), 4u);
    EXPECT_EQ(grid.blocks[0].group, "block 1");
    EXPECT_EQ(grid.blocks[0].zones.size(), 6u);
    EXPECT_EQ(grid.blocks[1].group, "block 1");
    EXPECT_EQ(grid.blocks[1].zones.size(), 3u);
    EXPECT_EQ(grid.blocks[2].group, "small");
    EXPECT_EQ(grid.blocks[2].zones.size(), 2u);
    EXPECT_EQ(grid.blocks[3].zones.size(), 1u);
    EXPECT_DOUBLE_EQ(volume_of(grid), 6 + 3 + 2 + 1.0 / 6);
    for (const auto& block : grid.blocks) {
        const Solid solid = solid_from_surface(surface_of(grid, block));
        ASSERT_EQ(solid.parts.size(), 1u);
        EXPECT_EQ(zones_of(grid, block, solid.parts[0]).tetrahedra.size(), block.zones.size());
    }
    EXPECT_EQ(message_of(read_f3grid, with(f3grid, "Z T4", "Z T5")), "file, line 30: 'T5' is not a shape of zones");
    EXPECT_EQ(message_of(read_f3grid, with(f3grid, "31 32 33 34\n*F", "31 32 33 39\n*F")),
              "file, line 30: zone 9 has gridpoint 39, which has not been defined above");
    EXPECT_EQ(message_of(read_f3grid, with(f3grid, "31 32 33 34\n*F", "31 32 33\n*F")),
              "file, line 30: the number of a gridpoint is missing");
    EXPECT_EQ(message_of(read_f3grid, with(f3grid, "31 32 33 34\n*F", "31 32 33 33\n*F")),
              "file, line 30: tetrahedron 9 has no volume");
    EXPECT_EQ(message_of(read_f3grid, with(f3grid, " 5 9\n", " 5 8\n")),
              "file, line 42: zone 8 has not been defined above");
    EXPECT_EQ(message_of(read_f3grid, "G 1 0 0 0\nH 3\n"), "file, line 2: a line cannot begin with 'H'");
    EXPECT_EQ(message_of(read_f3grid, "G 1 0 0 0\nG 1 0 0 1\n"), "file, line 2: gridpoint 1 is defined twice");
    EXPECT_EQ(message_of(read_f3grid, "G 1 0 0 0\n"), "file holds no zones");
}

TEST(Formats, TessellationsOfNeper) {
    const Grid3d grid = read_tess(tess, "file");
    ASSERT_EQ(grid.blocks.size(), 2u);
    EXPECT_DOUBLE_EQ(volume_of(grid), 1 + 1.0 / 3);
    EXPECT_EQ(message_of(read_tess, with(tess, "3 standard", "2 standard")),
              "file, line 5: the tessellation has 2 dimensions");
    EXPECT_EQ(message_of(read_tess, with(tess, "-2 7 8", "-2 7 11")),
              "file, line 69: polyhedron 2 has face 11, which is not there");
    EXPECT_EQ(message_of(read_tess, with(tess, "4 1 4 3 2", "4 1 4 3 12")),
              "file, line 26: face 1 has vertex 12, which is not there");
    EXPECT_EQ(message_of(read_tess, "***tess\n***end\n"), "file holds no polyhedra");
    EXPECT_EQ(message_of(read_tess, "hello"), "file, line 1: expected '***tess', found 'hello'");
}

TEST(Formats, SurfacesOfGocad) {
    const auto bodies = surfaces_of(read_gocad(gocad, "file")).surfaces;
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].name, "fault 7");
    EXPECT_DOUBLE_EQ(volume_of(bodies[0]), 1.0 / 6);
    EXPECT_DOUBLE_EQ(volume_of(bodies[1]), 1.0 / 3);
    EXPECT_EQ(bodies[1].surface.vertices[3].z(), -1);
    EXPECT_EQ(message_of(read_gocad, with(gocad, "TRGL 5 2 4", "TRGL 5 2 9")),
              "file, line 16: vertex 9 has not been defined above");
    EXPECT_EQ(message_of(read_gocad, with(gocad, "TSurf", "PLine")), "file, line 1: the object is a 'PLine'");
    EXPECT_EQ(message_of(read_gocad, gocad.substr(0, 200)), "file, line 14: the file ends before 'END'");
}

TEST(Formats, FacesAndMeshesOfDrawings) {
    const auto bodies = surfaces_of(read_dxf(dxf(), "file")).surfaces;
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].name, "stone 1");
    EXPECT_EQ(bodies[1].name, "stone 2");
    for (const NamedSurface& body : bodies) EXPECT_DOUBLE_EQ(volume_of(body), 1.0 / 6);
    EXPECT_EQ(message_of(read_dxf, with(dxf(), "3DFACE\n  8", "3DFACE\n  x")), "file, line 9: 'x' is not a group code");
    EXPECT_EQ(message_of(read_dxf, with(dxf(), "72\n-3", "72\n-9")),
              "file, line 180: a face has vertex 9, and 4 have been defined so far");
    EXPECT_EQ(message_of(read_dxf, dxf().substr(0, dxf().size() - 20)).substr(0, 10), "file, line");
    // A mesh of rows and columns that is closed around: a prism with three sides, and its ends.
    std::string mesh = "0\nPOLYLINE\n8\n0\n70\n48\n71\n2\n72\n3\n";
    for (const double z : {0.0, 2.0})
        for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {0, 1}})
            mesh += fmt::format("0\nVERTEX\n10\n{}\n20\n{}\n30\n{}\n", x, y, z);
    mesh += "0\nSEQEND\n";
    for (const double z : {0.0, 2.0})
        mesh +=
            fmt::format("0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n{0}\n11\n1\n21\n0\n31\n{0}\n12\n0\n22\n1\n32\n{0}\n", z);
    const auto prism = surfaces_of(read_dxf(mesh + "0\nEOF\n", "file")).surfaces;
    ASSERT_EQ(prism.size(), 1u);
    EXPECT_DOUBLE_EQ(volume_of(prism[0]), 1);
}

TEST(Formats, MeshesOfCompas) {
    const auto bodies = surfaces_of(read_compas(compas, "file")).surfaces;
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].name, "keystone");
    EXPECT_EQ(bodies[1].name, "plain \"one\"");
    EXPECT_DOUBLE_EQ(volume_of(bodies[0]), 1.0 / 6);
    EXPECT_DOUBLE_EQ(volume_of(bodies[1]), 1.0 / 3);
    EXPECT_EQ(message_of(read_compas, with(compas, "[2, 0, 7]", "[2, 0, 6]")),
              "file, line 4: a face has vertex 6, which is not there");
    EXPECT_EQ(message_of(read_compas, with(compas, "\"y\": 1e0", "\"y\": one")), "file, line 3: 'one' is not a value");
    EXPECT_EQ(message_of(read_compas, with(compas, "\"y\": 1e0, ", "")), "file, line 3: a vertex has no y");
    EXPECT_EQ(message_of(read_compas, compas.substr(0, 300)).substr(0, 29), "file, line 4: the file ends b");
    EXPECT_EQ(message_of(read_compas, "{}"), "file holds no meshes");
    EXPECT_EQ(message_of(read_compas, std::string(5000, '[')), "file, line 1: the data are nested too deeply");
}

/// Each file cut at every place, and with changed words, is read or refused.
TEST(Formats, DamagedFilesEndInAMessageNeverInACrash) {
    const auto grid = [](Grid3d (*read)(std::string_view, const std::string&)) {
        return [read](std::string_view text) { volume_of(read(text, "file")); };
    };
    const auto soup = [](std::vector<FaceSoup> (*read)(std::string_view, const std::string&)) {
        return [read](std::string_view text) {
            for (const NamedSurface& body : surfaces_of(read(text, "file"), {0.01, 10}).surfaces)
                solid_from_surface(body.surface, {1e-3, true}, body.cavities);
        };
    };
    const std::vector<std::pair<std::function<void(std::string_view)>, std::string>> files{{grid(read_f3grid), f3grid},
                                                                                           {grid(read_tess), tess},
                                                                                           {soup(read_gocad), gocad},
                                                                                           {soup(read_dxf), dxf()},
                                                                                           {soup(read_compas), compas}};
    const std::string strange[] = {"-1", "0",  "99999999999999999999", "2147483648", "1e300", "\"", "x", "", "{",
                                   "[",  "nan"};
    Random random(50);
    for (const auto& file : files) {
        const auto& read = file.first;
        const auto& whole = file.second;
        int refused = 0;
        const auto attempt = [&](const std::string& text) {
            try {
                read(text);
            } catch (const Diagnostic&) { ++refused; }
        };
        for (std::size_t size = 0; size < whole.size(); ++size) attempt(whole.substr(0, size));
        EXPECT_GT(refused, static_cast<int>(0.5 * static_cast<double>(whole.size())));
        for (int i = 0; i < 1000; ++i) {
            std::string text = whole;
            for (int k = 0; k < 2; ++k) {
                const std::size_t at = random.bits() % text.size();
                const std::size_t from = text.find_last_of(" \n", at), to = text.find_first_of(" \n", at);
                if (from == std::string::npos || to == std::string::npos || to <= from) continue;
                text.replace(from + 1, to - from - 1, strange[random.bits() % std::size(strange)]);
            }
            attempt(text);
        }
    }
}
