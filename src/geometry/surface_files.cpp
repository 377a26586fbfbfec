#include "geometry/surface_files.hpp"

#include "base/diagnostic.hpp"
#include "geometry/input_text.hpp"
#include "base/lower_case.hpp"
#include "geometry/face_soup.hpp"
#include "geometry/surface_checks.hpp"
#include "geometry/words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>

namespace kaya {
namespace {

/// Corners nearer than this share of the size are one; the files have single precision.
constexpr double same_corner = 2e-7;

struct Format {
    std::string_view suffix;
    std::vector<NamedSurface> (*read)(std::string_view, const std::string&);
};
constexpr std::array formats{
    Format{".stl", read_stl},  Format{".obj", read_obj},   Format{".ply", read_ply},
    Format{".wrl", read_vrml}, Format{".vrml", read_vrml},
};

} // namespace

void add_surfaces(const FaceSoup& soup, std::vector<NamedSurface>& surfaces) {
    if (soup.loops.empty()) return;
    std::vector<Vec3> corners;
    for (const auto& loop : soup.loops) corners.insert(corners.end(), loop.begin(), loop.end());
    Surface all = surface_from_loops(soup.loops, same_corner * size_of(corners));
    std::erase_if(all.faces, [](const Surface::Face& face) {
        std::vector<int> sorted = face.vertices;
        std::sort(sorted.begin(), sorted.end());
        return std::unique(sorted.begin(), sorted.end()) - sorted.begin() < 3;
    });
    for (Surface& one : separate(all)) surfaces.push_back({soup.name, std::move(one)});
}

void need_surfaces(const std::vector<NamedSurface>& surfaces, const std::string& file) {
    if (surfaces.empty()) throw Diagnostic(fmt::format("{} holds no faces", file));
}

std::vector<NamedSurface> read_surfaces(const std::string& path) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    const auto format =
        std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.suffix == suffix; });
    if (format == formats.end())
        throw Diagnostic(fmt::format("{} does not have the suffix of a surface file", path),
                         "use .stl, .obj, .ply or .wrl");
    const std::string bytes = input_text(path);
    return format->read(bytes, path);
}

} // namespace kaya
