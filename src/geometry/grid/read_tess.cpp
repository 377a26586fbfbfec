// Tessellations of Neper (.tess): vertices, faces, polyhedra. The sections are those of Neper's reference manual, appendix "File and
// directory formats".
#include "base/diagnostic.hpp"
#include "geometry/grid/grid3d.hpp"
#include "geometry/read/words.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace kaya {
namespace {

class TessReader {
public:
    TessReader(std::string_view text, const std::string& file) : words_(text, file, "", "#"), file_(file) {}

    Grid3d read() {
        words_.expect("***tess");
        for (std::string_view word = words_.next(); !word.empty() && word != "***end"; word = words_.next()) {
            if (word == "**general") general();
            else if (word == "**vertex") vertices();
            else if (word == "**face") faces();
            else if (word == "**polyhedron") polyhedra();
        }
        if (grid_.blocks.empty())
            throw Diagnostic(fmt::format("{} holds no polyhedra", file_), "make a tessellation in three dimensions");
        return std::move(grid_);
    }

private:
    void general() {
        const long long dimension = words_.integer("the dimension");
        if (dimension != 3)
            words_.fail(fmt::format("the tessellation has {} dimensions", dimension), "only those of 3 are read");
    }

    int identity(std::string_view what) { return words_.identity(words_.integer(what), what); }

    void vertices() {
        for (long long left = words_.count("the number of vertices"); left > 0; --left) {
            const int number = identity("the number of a vertex");
            const Vec3 place = words_.point("a coordinate");
            words_.skip_line(); // its state
            if (!grid_.gridpoints.emplace(number, place).second)
                words_.fail(fmt::format("vertex {} is defined twice", number));
        }
    }

    void faces() {
        for (long long left = words_.count("the number of faces"); left > 0; --left) {
            const int number = identity("the number of a face");
            const long long corners = words_.count("the number of vertices of a face");
            if (corners < 3) words_.fail(fmt::format("face {} has {} vertices", number, corners), "at least 3");
            std::vector<int> loop;
            for (long long k = 0; k < corners; ++k) {
                loop.push_back(identity("the number of a vertex"));
                if (!grid_.gridpoints.contains(loop.back()))
                    words_.fail(fmt::format("face {} has vertex {}, which is not there", number, loop.back()));
            }
            for (long long edges = words_.count("the number of edges of a face"); edges > 0; --edges)
                words_.integer("the number of an edge");
            for (int k = 0; k < 4; ++k) words_.number("a coefficient of the plane");
            words_.integer("the state of a face");
            words_.integer("the point of a face");
            for (int k = 0; k < 3; ++k) words_.number("a coordinate");
            if (!grid_.faces.emplace(number, std::move(loop)).second)
                words_.fail(fmt::format("face {} is defined twice", number));
        }
    }

    void polyhedra() {
        for (long long left = words_.count("the number of polyhedra"); left > 0; --left) {
            Grid3d::Block block;
            block.number = identity("the number of a polyhedron");
            for (long long faces = words_.count("the number of faces of a polyhedron"); faces > 0; --faces) {
                const long long face = std::llabs(words_.integer("the number of a face")); // the sign is its direction
                if (face > std::numeric_limits<int>::max() || !grid_.faces.contains(static_cast<int>(face)))
                    words_.fail(fmt::format("polyhedron {} has face {}, which is not there", block.number, face));
                block.faces.push_back(static_cast<int>(face));
            }
            grid_.blocks.push_back(std::move(block));
        }
    }

    Words words_;
    std::string file_;
    Grid3d grid_;
};

} // namespace

Grid3d read_tess(std::string_view text, const std::string& file) { return TessReader(text, file).read(); }

} // namespace kaya
