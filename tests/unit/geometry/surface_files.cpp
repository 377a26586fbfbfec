#include "geometry/grid/file_formats.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"
#include "geometry/polyhedra/random.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

using Reader = std::vector<FaceSoup> (*)(std::string_view, const std::string&);

std::vector<NamedSurface> bodies(Reader read, std::string_view text) {
    return surfaces_of(read(text, "file")).surfaces;
}

std::string message_of(Reader read, std::string_view text) {
    try {
        read(text, "file");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

/// The 12 triangles of a brick.
std::vector<std::array<Vec3, 3>> triangles(const Vec3& low, const Vec3& high) {
    const Polyhedron brick = make_brick(low, high);
    std::vector<std::array<Vec3, 3>> result;
    for (const auto& face : brick.faces)
        for (int i = 1; i < 3; ++i)
            result.push_back({brick.vertices[face.vertices[0]], brick.vertices[face.vertices[i]],
                              brick.vertices[face.vertices[i + 1]]});
    return result;
}

std::string stl_text(const std::string& name, const Vec3& low, const Vec3& high) {
    std::string text = "solid " + name + "\n";
    for (const auto& t : triangles(low, high)) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const Vec3& v : t) text += fmt::format("   vertex {} {} {:e}\n", v.x(), v.y(), v.z());
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

std::string stl_binary(const Vec3& low, const Vec3& high) {
    std::string bytes(80, 's');
    const auto add = [&bytes](const void* data, std::size_t count) {
        bytes.append(static_cast<const char*>(data), count);
    };
    const auto all = triangles(low, high);
    const auto count = static_cast<std::uint32_t>(all.size());
    add(&count, 4);
    for (const auto& t : all) {
        std::array<float, 12> numbers{};
        for (int i = 0; i < 9; ++i) numbers[3 + i] = static_cast<float>(t[i / 3][i % 3]);
        add(numbers.data(), sizeof numbers);
        bytes.append(2, '\0');
    }
    return bytes;
}

const std::string ply_header = "element vertex 4\ncomment four corners\nproperty float x\nproperty float y\n"
                               "property double z\nproperty uchar red\nelement face 4\n"
                               "property list uchar int vertex_indices\nend_header\n";

std::string ply_text() {
    return "ply\nformat ascii 1.0\n" + ply_header +
           "0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

template <class T> void put(std::string& bytes, T value, bool big) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
}

std::string ply_binary(bool big) {
    std::string bytes =
        std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" + ply_header;
    for (int i = 0; i < 4; ++i) {
        put(bytes, i == 1 ? 1.0f : 0.0f, big);
        put(bytes, i == 2 ? 1.0f : 0.0f, big);
        put(bytes, i == 3 ? 1.0 : 0.0, big);
        bytes += '\x09';
    }
    for (const auto& t : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
        bytes += '\x03';
        for (const int v : t) put(bytes, static_cast<std::int32_t>(v), big);
    }
    return bytes;
}

const std::string obj_text = "# two blocks\no left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n"
                             "f 1/1 3/2 2/3\nf 1//1 2//1 4//1\nf 2 3 4\nf 3 1 4\n"
                             "g right side\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\n"
                             "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n";

const std::string vrml_text = "#VRML V2.0 utf8\nTransform { translation 0 0 0 children [\n Shape { geometry "
                              "DEF brick IndexedFaceSet {\n"
                              "  coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] } # corners\n"
                              "  coordIndex [ 0,2,1,-1, 0,1,3,-1, 1,2,3,-1, 2,0,3 ] } } ] }\n";

double volume_of(const NamedSurface& named) {
    const Solid solid = solid_from_surface(named.surface);
    EXPECT_EQ(solid.parts.size(), 1u);
    EXPECT_TRUE(kaya::test::closed(solid.parts[0]));
    return mass_properties(solid.parts[0]).volume;
}

} // namespace

TEST(SurfaceFiles, StlTextWithTwoSolids) {
    const auto surfaces =
        bodies(read_stl, stl_text("pier", {0, 0, 0}, {1, 2, 3}) + stl_text("cap", {0, 0, 3}, {1, 1, 4}));
    ASSERT_EQ(surfaces.size(), 2u);
    EXPECT_EQ(surfaces[0].name, "pier");
    EXPECT_DOUBLE_EQ(volume_of(surfaces[0]), 6);
    EXPECT_DOUBLE_EQ(volume_of(surfaces[1]), 1);
    EXPECT_EQ(solid_from_surface(surfaces[0].surface).parts[0].faces.size(), 6u);
}

TEST(SurfaceFiles, StlBinary) {
    const auto surfaces = bodies(read_stl, stl_binary({0.1, 0.2, 0.3}, {1.1, 2.2, 3.3}));
    ASSERT_EQ(surfaces.size(), 1u);
    EXPECT_NEAR(volume_of(surfaces[0]), 6, 1e-6);
}

TEST(SurfaceFiles, ObjWithObjectsAndGroups) {
    const auto surfaces = bodies(read_obj, obj_text);
    ASSERT_EQ(surfaces.size(), 2u);
    EXPECT_EQ(surfaces[0].name, "left");
    EXPECT_EQ(surfaces[1].name, "right");
    EXPECT_DOUBLE_EQ(volume_of(surfaces[0]), 1.0 / 6);
    EXPECT_DOUBLE_EQ(volume_of(surfaces[1]), 1.0 / 6);
}

TEST(SurfaceFiles, PlyAsTextAndInBothByteOrders) {
    for (const std::string& bytes : {ply_text(), ply_binary(false), ply_binary(true)}) {
        const auto surfaces = bodies(read_ply, bytes);
        ASSERT_EQ(surfaces.size(), 1u);
        EXPECT_DOUBLE_EQ(volume_of(surfaces[0]), 1.0 / 6);
    }
}

TEST(SurfaceFiles, Vrml) {
    const auto surfaces = bodies(read_vrml, vrml_text);
    ASSERT_EQ(surfaces.size(), 1u);
    EXPECT_EQ(surfaces[0].name, "brick");
    EXPECT_DOUBLE_EQ(volume_of(surfaces[0]), 1.0 / 6);
}

TEST(SurfaceFiles, ErrorsNameTheMistakeAndItsPosition) {
    EXPECT_EQ(message_of(read_stl, "solid a\nfacet\nouter loop\nvertex 0 0 x\n"),
              "file, line 4: 'x' is not a number: expected a coordinate");
    EXPECT_EQ(message_of(read_stl, "solid a\nfacet\nouter loop\nvertex 0 0\n"),
              "file, line 5: a coordinate is missing");
    EXPECT_EQ(message_of(read_stl, stl_binary({0, 0, 0}, {1, 1, 1}).substr(0, 300)),
              "file is not a whole STL file: it does not begin with 'solid', and its length is not that of its "
              "number of triangles");
    EXPECT_EQ(message_of(read_obj, "v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
              "file, line 3: vertex 3 is used, and 2 have been defined so far");
    EXPECT_EQ(message_of(read_obj, "v 0 0 0\nf 1 -2 1\n"),
              "file, line 2: vertex -2 is used, and 1 have been defined so far");
    EXPECT_EQ(message_of(read_obj, "v 0 0\nv 0 0 0\n"), "file, line 1: z is missing");
    EXPECT_EQ(message_of(read_obj, "v 0 0 inf\n"), "file, line 1: 'inf' is not a number: expected z");
    EXPECT_EQ(message_of(read_ply, "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n"),
              "file, line 3: 99999999999 elements 'vertex' are more than the file can hold");
    EXPECT_EQ(message_of(read_ply, ply_binary(false).substr(0, 260)), "file ends before all its elements are read");
    EXPECT_EQ(message_of(read_ply, "nothing"), "file is not a PLY file: it has no header from 'ply' to 'end_header'");
    EXPECT_EQ(message_of(read_vrml, "#VRML V2.0\nTransform { translation 1 0 0 }"),
              "file, line 2: the translation of a transform is not applied by this reader");
    EXPECT_EQ(message_of(read_vrml, "#VRML V2.0\ncoordIndex [ 0 1 2 ]"),
              "file, line 2: point 0 is used, and the points are 0 to -1");
    EXPECT_EQ(message_of(read_vrml, "#VRML V2.0\npoint [ 0 0 0"), "file, line 2: the file ends within brackets");
    EXPECT_EQ(message_of(read_vrml, "hello"), "file, line 1: a VRML file begins with '#VRML'");
}

TEST(SurfaceFiles, DamagedFilesEndInAMessageNeverInACrash) {
    const std::vector<std::pair<Reader, std::string>> files{{read_stl, stl_text("a", {0, 0, 0}, {1, 1, 1})},
                                                            {read_stl, stl_binary({0, 0, 0}, {1, 1, 1})},
                                                            {read_obj, obj_text},
                                                            {read_ply, ply_text()},
                                                            {read_ply, ply_binary(false)},
                                                            {read_ply, ply_binary(true)},
                                                            {read_vrml, vrml_text}};
    Random random(77);
    int refused = 0;
    for (const auto& [read, whole] : files)
        for (int trial = 0; trial < 400; ++trial) {
            std::string damaged = whole;
            if (trial % 2)
                damaged.resize(static_cast<std::size_t>(random.uniform() * static_cast<double>(whole.size())));
            for (int i = 0; i < 3 && !damaged.empty(); ++i)
                damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(damaged.size()))] =
                    static_cast<char>(random.bits() & 255);
            try {
                for (const auto& body :
                     surfaces_of(read(damaged, "file"), trial % 3 ? Repair{} : Repair{0.01, 10}).surfaces)
                    solid_from_surface(body.surface, {1e-3, true}, body.cavities);
            } catch (const Diagnostic&) { ++refused; }
        }
    EXPECT_GT(refused, 1000);
}

TEST(SurfaceFiles, AreChosenBySuffix) {
    const test::ScratchFolder folder;
    const auto path = folder / "surface.OBJ";
    test::put(path, obj_text);
    EXPECT_EQ(read_soups(path).size(), 3u); // before the first name, left, right
    EXPECT_EQ(surfaces_of(read_soups(path)).surfaces.size(), 2u);
    test::put(path, "v 0 0 0\n");
    EXPECT_THROW(read_soups(path), Diagnostic);
    std::filesystem::remove(path);
    EXPECT_THROW(read_soups(path), Diagnostic);
    try {
        read_soups("model.dwg");
        FAIL();
    } catch (const Diagnostic& diagnostic) {
        EXPECT_EQ(diagnostic.message, "model.dwg does not have the suffix of a surface file");
        EXPECT_EQ(
            diagnostic.hint,
            "use one of .vtu, .vtk, .vts, .vtr, .vti, .vtp, .pvtu, .pvts, .pvtr, .pvti, .pvtp, .stl, .obj, .ply, .wrl, .vrml, .dxf, .ts, .json");
    }
}
