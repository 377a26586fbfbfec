#include "geometry/grid/file_formats.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "geometry/grid/vtk_contents.hpp"
#include "geometry/read/input_text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace kaya {
namespace {

constexpr std::array file_formats{
    FileFormat{".3dgrid", read_grid3d, nullptr, write_grid3d, FileFormat::Holds::grid},
    FileFormat{".f3grid", read_f3grid, nullptr, write_f3grid, FileFormat::Holds::zones},
    FileFormat{".msh", read_msh, nullptr, write_msh, FileFormat::Holds::zones},
    FileFormat{".tess", read_tess},
    FileFormat{".vtu", read_vtk_blocks, read_vtk_surfaces, write_vtu, FileFormat::Holds::zones},
    FileFormat{".vtk", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".vts", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".vtr", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".vti", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".vtp", nullptr, read_vtk_surfaces},
    FileFormat{".pvtu", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".pvts", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".pvtr", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".pvti", read_vtk_blocks, read_vtk_surfaces},
    FileFormat{".pvtp", nullptr, read_vtk_surfaces},
    FileFormat{".stl", nullptr, read_stl, write_stl},
    FileFormat{".obj", nullptr, read_obj, write_obj},
    FileFormat{".ply", nullptr, read_ply, write_ply},
    FileFormat{".wrl", nullptr, read_vrml},
    FileFormat{".vrml", nullptr, read_vrml},
    FileFormat{".dxf", nullptr, read_dxf},
    FileFormat{".ts", nullptr, read_gocad},
    FileFormat{".json", nullptr, read_compas, write_compas},
};

std::string suffixes_where(auto holds) {
    std::vector<std::string_view> suffixes;
    for (const FileFormat& format : file_formats)
        if (holds(format)) suffixes.push_back(format.suffix);
    return fmt::format("{}", fmt::join(suffixes, ", "));
}

bool is_vtk(const FileFormat& format) { return format.surfaces == read_vtk_surfaces; }

/// The place of a piece, which is in the folder of the file that names it or below.
std::string place_of_piece(const std::string& path, const std::string& piece) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path());
    const fs::path inside = fs::weakly_canonical(folder / piece).lexically_relative(folder);
    if (inside.empty() || *inside.begin() == "..")
        throw Diagnostic(fmt::format("{}: its piece '{}' is in another folder", path, piece),
                         "put the files of the pieces beside the file that names them");
    return (fs::path(path).parent_path() / inside).string();
}

/// The mesh of a file, or those in the files of its pieces.
VtkMesh mesh_in(const std::string& path) {
    const std::string bytes = input_text(path);
    const std::vector<std::string> pieces = vtk_piece_files(bytes, path);
    if (pieces.empty()) return read_vtk_mesh(bytes, path);
    VtkMesh mesh(path);
    for (const std::string& piece : pieces) {
        const std::string place = place_of_piece(path, piece);
        mesh.append(read_vtk_mesh(input_text(place), place));
    }
    return mesh;
}

} // namespace

const FileFormat* file_format(const std::string& path) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    const auto found = std::ranges::find(file_formats, suffix, &FileFormat::suffix);
    return found == file_formats.end() ? nullptr : &*found;
}

std::string suffixes_read() {
    return suffixes_where([](const FileFormat& format) { return format.blocks || format.surfaces; });
}

std::string suffixes_written() {
    return suffixes_where([](const FileFormat& format) { return format.write; });
}

std::string surface_suffixes_read() {
    return suffixes_where([](const FileFormat& format) { return format.surfaces; });
}

std::string surface_suffixes_written() {
    return suffixes_where(
        [](const FileFormat& format) { return format.write && format.holds == FileFormat::Holds::surfaces; });
}

FileContents read_contents(const std::string& path) {
    const FileFormat* format = file_format(path);
    if (format == nullptr)
        throw Diagnostic(fmt::format("{} does not have the suffix of a file that is read", path),
                         fmt::format("use one of {}", suffixes_read()));
    if (format->blocks == nullptr) return {{}, read_soups(path)};
    if (!is_vtk(*format)) return {format->blocks(input_text(path), path), {}};
    const VtkMesh mesh = mesh_in(path);
    FileContents contents{blocks_of(mesh), {}};
    if (contents.grid.blocks.empty()) contents.soups = faces_of(mesh);
    return contents;
}

std::vector<FaceSoup> read_soups(const std::string& path) {
    const FileFormat* format = file_format(path);
    if (format == nullptr || format->surfaces == nullptr)
        throw Diagnostic(fmt::format("{} does not have the suffix of a surface file", path),
                         fmt::format("use one of {}", surface_suffixes_read()));
    std::vector<FaceSoup> soups = is_vtk(*format) ? faces_of(mesh_in(path)) : format->surfaces(input_text(path), path);
    if (std::ranges::all_of(soups, [](const FaceSoup& soup) { return soup.loops.empty(); }))
        throw Diagnostic(fmt::format("{} holds no faces", path));
    return soups;
}

} // namespace kaya
