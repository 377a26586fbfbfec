// Every right example of the command tables runs, in a small model that has the objects of the examples.
#include "commands/session/session.hpp"
#include "lang/commands/language.hpp"
#include "lang/interp/binder.hpp"
#include "lang/modern/language.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <unistd.h>

namespace kaya {
namespace {

namespace fs = std::filesystem;

/// Seven bricks with groups, materials, tables, histories, functions and variables of FISH.
constexpr const char* setting = R"(
poly brick 0 1 0 1 0 1 region 1 mat 1
poly brick 1 2 0 1 0 1 region 2 mat 2
poly brick 0 1 0 1 1 2 region 3
poly brick 0 2 0 1 -1 0 region 4
poly brick 50 51 0 1 0 1 region 5
poly brick 52 53 0 1 0 1 region 6
poly brick 54 55 0 1 0 1 region 7
group block ball range region 5
group block block range region 6
group block tunnel range region 7
group block wall range region 1
group block roof range region 3
group block column range region 4
group block arch range region 2
structure property 1 area 1e-4 young 2e11
structure cable 0.5 0.5 1.5 0.5 0.5 0.5 segments 2
range name nothing x 5
range name top z 0.9 1.1
range name bottom z -1 0
prop mat 1 dens 2000 k 1e9 g 1e9
prop mat 2 dens 2000 k 1e9 g 1e9
prop jmat 1 jkn 1e9 jks 1e9 jfric 30
prop jmat 2 jkn 1e9 jks 1e9 jfric 30
prop jmat 3 jkn 1e9 jks 1e9 jfric 30
fix region 4
table 1 0 0 1 1
table 3 0 0 1 1
def f
  f = 1.0
end
def sstav
  sstav = 1.0
end
def watch
  seen = 1
end
def build_wall
  built = 1
end
def place(i, j)
  place = i + j
end
def wave
  wave = 1.0
end
def set_all
  n = 2
  v = 0.0
  x = 1
  nstav = 0.0
  load = 0.0
  size = 1.0
  name = 'part'
  g = vector(0,0,-10)
  stiffness = 2.0
  a = vector(10,0,0)
  b = vector(11,0,0)
  c = vector(10,1,0)
  d = vector(10,0,1)
  v1 = vector(20,0,0)
  v2 = vector(21,0,0)
  v3 = vector(20,0,1)
  w1 = vector(20,1,0)
  w2 = vector(21,1,0)
  w3 = vector(20,1,1)
end
@set_all
hist xdis 0 0 1 unbal time zdis 0 0 1 ydis 0 0 1
)";

class ExamplesTest : public testing::Test {
protected:
    ExamplesTest() : before_(fs::current_path()) { fs::current_path(folder_.path()); }
    ~ExamplesTest() override { fs::current_path(before_); }

    static void write(const char* name, const std::string& text) { std::ofstream(name) << text; }

private:
    test::ScratchFolder folder_;
    fs::path before_;
};

/// Input files of the examples, in the current folder.
void write_inputs(const std::function<void(const char*, const std::string&)>& write) {
    for (const char* name : {"wall.dat", "second part.3dd", "part"}) write(name, "list time\n");
    write("ore.stl",
          "solid ore\nfacet normal 0 0 1\nouter loop\nvertex -100 -100 0.4\nvertex 100 -100 0.5\nvertex 0 200 0.5\n"
          "endloop\nendfacet\nendsolid ore\n");
    write("hill.xyz", "-100 -100 0.4\n100 -100 0.5\n100 100 0.6\n-100 100 0.5\n");
    write("quake.tab", "quake\n3 0.1\n0\n1\n0\n");
    const std::string tetrahedron = "v 10 0 0\nv 11 0 0\nv 10 1 0\nv 10 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    for (const char* name : {"stones.obj", "dome.obj"}) write(name, tetrahedron);
    write("scan.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                      "10 0 0\n11 0 0\n10 1 0\n10 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    write(
        "rock.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 10 0 0\n2 11 0 0\n3 10 1 0\n4 10 0 1\n$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n");
    write(
        "rock.vtu",
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray "
        "type=\"Float64\">10 0 0 11 0 0 10 1 0 10 0 1</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">0 1 2 "
        "3</DataArray><DataArray type=\"Int32\" Name=\"offsets\">4</DataArray><DataArray type=\"UInt8\" "
        "Name=\"types\">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
    const auto facet = [](const char* a, const char* b, const char* c) {
        return fmt::format("facet normal 0 0 0\nouter loop\nvertex {}\nvertex {}\nvertex {}\nendloop\nendfacet\n", a, b,
                           c);
    };
    const char *o = "10 0 0", *x = "11 0 0", *y = "10 1 0", *z = "10 0 1";
    write("vault.stl",
          "solid vault\n" + facet(o, y, x) + facet(o, x, z) + facet(o, z, y) + facet(x, y, z) + "endsolid vault\n");
    write("fault.stl", "solid fault\n" + facet(o, y, x) + "endsolid fault\n");
    write(
        "fault.dxf",
        "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n");
    write("shear.csv", "normal_stress,shear_displacement\n1,0\n1,0.001\n");
    write("average.lua", "average = 1\n");
    write("faults.txt", "x y z dip dd size\n0 0 0.5 30 90 4\n");
    write("planes.txt", "dip dd\n30 90\n85 210\n");
    write("sizes.txt", "2\n3.5\n");
}

/// Additional lines that an example needs.
std::string before(std::string_view example) {
    if (example.find("jcso") != std::string_view::npos) return "jmodel model barton-bandis\n";
    if (example.starts_with("limit")) // a separate slope
        return "delete\npoly brick 20 30 0 1 20 25\npoly prism a (30,0,20) (30,0,25) (50,0,35) (50,0,20) b (30,1,20) (30,1,25) (50,1,35) (50,1,20)\n"
               "poly brick 50 70 0 1 20 35\nprop mat 1 density 2000 bcoh 3e3 bfric 19.6\ngravity 0 0 -10\n";
    if (example.starts_with("ini s")) return "gen edge 1\n"; // rigid blocks have no stress
    if (example.starts_with("insitu topo")) return "gravity 0 0 -9.81\n";
    if (example.find("remove watch") != std::string_view::npos) return "fish callback add watch\n";
    if (example.find("jrco") != std::string_view::npos) return "jmodel load barton-bandis\n";
    if (example.starts_with("import wall.3dgrid")) return "export wall.3dgrid\n";
    if (example.starts_with("block contact material-table") && example.find("table add") == std::string_view::npos)
        return "block contact material-table add property friction 30 range position-z 0 9\n";
    if (example.starts_with("geometry export"))
        return "geometry set 'fault'\ngeometry polygon create by-positions (0,0,0) (1,0,0) (1,1,0)\n";
    if (example.starts_with("geometry ")) return "geometry set 'fault'\n";
    if (example.find("cut geometry") != example.npos)
        return "geometry set 'fault'\ngeometry polygon create by-positions (-9,-9,0.4) (9,-9,0.4) (9,9,0.4) (-9,9,0.4)\n";
    if (example.find("frequencies") != example.npos || example.find("dynamic eigen") != example.npos)
        return "new\npoly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 density 2000\nfix range z 0 1\njmodel model mohr\njmodel jkn 1e9 jks 1e9\n";
    if (example.find("extrapolate") != example.npos || example.find("associated") != example.npos)
        return "new\npoly brick 0 1 0 1 0 1\ngen edge 1\nchange cons 2\nprop mat 1 density 2000 young 1e8 prat 0.2 bcoh 2e4 bten 1e9\n"
               "gravity 0 0 -10\nset small on\ndamp local\nbound xvel 0 yvel 0 zvel 0 range z 0\n";
    if (example.find("@drive") != example.npos) return "set @drive = 0\napply xvel 1 hist @drive range region 1\n";
    if (example.starts_with("solve control"))
        return "gravity 0 0 -10\nset @push = 0\napply xload 10 hist @push range region 1\n";
    if (example.starts_with("range delete")) return "range name low z 0 1\n";
    if (example.starts_with("fracture ") && example.find("create") == example.npos)
        return "geometry set 'wall'\ngeometry polygon create by-positions (-9,0,-9) (9,0,-9) (9,0,9) (-9,0,9)\n"
               "fracture create position 0 0 0.5 size 1 dfn 'faults'\nfracture create position 0 0 0.5 size 1\n"
               "fracture template create 'a' size exponential 2\nfracture template create 'set-1' size exponential 2\n";
    if (example.find("cut dfn") != example.npos)
        return "fracture create position 0 0 0.5 size 1 dfn 'faults'\nfracture create position 0 0 0.5 size 1\n";
    if (example.find("vs step") != std::string_view::npos)
        return "block history name 'crown' velocity-z position 0 0 1\n";
    return {};
}

/// Joined blocks are rigid, and only rigid blocks rotate.
bool of_rigid_blocks(std::string_view example) {
    return example.starts_with("join") || example.find("rzvel") != example.npos ||
           example.find("frequencies") != example.npos || example.find("dynamic eigen") != example.npos ||
           example.find("xrvel") != example.npos;
}

/// Runs every right example of a dialect; returns their number.
int run_examples(const lang::Language& dialect) {
    const Options options = [] {
        Options o;
        o.threads = 1;
        o.quiet = true;
        o.joint_folders = {KAYA_TEST_JOINTS};
        return o;
    }();
    std::FILE* nowhere = std::tmpfile();
    int count = 0;
    lang::for_each_command(dialect, [&](const lang::CommandSpec& command) {
        for (const auto& example : command.right) {
            SCOPED_TRACE(command.name() + ": " + std::string(example.text));
            // What an example needs follows from its classic words.
            const std::string_view words = example.classic.empty() ? example.text : example.classic;
            Session session(options, nowhere, nowhere);
            const auto run = [&](const std::string& text) { session.deck.interpreter.run_text(text, "example"); };
            try {
                run(setting);
                if (!of_rigid_blocks(words)) run("gen edge 1 range region 3\n");
                run("save settled\nsave 'two words'\n" + before(words));
                run(std::string(example.text));
                ++count;
            } catch (const Diagnostic& problem) { ADD_FAILURE() << render(problem); }
        }
    });
    std::fclose(nowhere);
    return count;
}

TEST_F(ExamplesTest, RightExamplesRun) {
    write_inputs(write);
    EXPECT_GT(run_examples(lang::classic()), 150);
}

TEST_F(ExamplesTest, RightModernExamplesRun) {
    write_inputs(write);
    EXPECT_GT(run_examples(lang::modern()), 200);
}

} // namespace
} // namespace kaya
