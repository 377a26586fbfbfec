// Faces in VTK's files: triangles, quadrilaterals, polygons and strips; those of higher order by their corners.
#include "geometry/read/surface_files.hpp"
#include "geometry/read/vtk_mesh.hpp"

#include <algorithm>
#include <array>

namespace kaya {
namespace {

enum class Outline { loop, pixel, strip };

/// A type of cells: the corners that bound it; 0: all.
struct FaceType {
    int type;
    Outline outline;
    std::size_t corners;
};
constexpr std::array face_types{
    FaceType{5, Outline::loop, 3},  FaceType{6, Outline::strip, 0}, FaceType{7, Outline::loop, 0},
    FaceType{8, Outline::pixel, 4}, FaceType{9, Outline::loop, 4},  FaceType{22, Outline::loop, 3},
    FaceType{23, Outline::loop, 4}, FaceType{28, Outline::loop, 4}, FaceType{30, Outline::loop, 4},
    FaceType{34, Outline::loop, 3}, FaceType{69, Outline::loop, 3}, FaceType{70, Outline::loop, 4},
    FaceType{76, Outline::loop, 3}, FaceType{77, Outline::loop, 4},
};

void add_faces(FaceSoup& soup, const VtkMesh& mesh, std::span<const int> corners, Outline outline) {
    const auto add = [&](std::initializer_list<int> loop) {
        soup.loops.emplace_back();
        for (const int corner : loop) soup.loops.back().push_back(mesh.points[static_cast<std::size_t>(corner)]);
    };
    if (outline == Outline::pixel) return add({corners[0], corners[1], corners[3], corners[2]});
    if (outline == Outline::strip) {
        for (std::size_t k = 2; k < corners.size(); ++k) add({corners[k - 2], corners[k - 1], corners[k]});
        return;
    }
    soup.loops.emplace_back();
    for (const int corner : corners) soup.loops.back().push_back(mesh.points[static_cast<std::size_t>(corner)]);
}

} // namespace

std::vector<FaceSoup> faces_of(const VtkMesh& mesh) {
    const std::vector<VtkLabel> labels = mesh.labels();
    std::map<VtkLabel, std::size_t> soup_of;
    std::vector<FaceSoup> soups;
    for (std::size_t cell = 0; cell < mesh.types.size(); ++cell) {
        const auto type = std::ranges::find(face_types, mesh.types[cell], &FaceType::type);
        if (type == face_types.end()) continue;
        std::span<const int> corners = mesh.corners(cell);
        const std::size_t least = std::max<std::size_t>(type->corners, 3);
        if (corners.size() < least)
            mesh.fail_at_cell(cell, "a " + mesh.type_of(cell) + " has " + std::to_string(corners.size()) + " corners");
        const auto [soup, is_new] = soup_of.try_emplace(labels[cell], soups.size());
        if (is_new) soups.push_back({labels[cell].group, {}});
        add_faces(soups[soup->second], mesh, type->corners == 0 ? corners : corners.first(type->corners),
                  type->outline);
    }
    return soups;
}

std::vector<FaceSoup> read_vtk_surfaces(std::string_view bytes, const std::string& file) {
    return faces_of(read_vtk_mesh(bytes, file));
}

} // namespace kaya
