// Meshes in the files of VTK: points, cells, and the groups of cells. Private to geometry.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// An array of a file: numbers or texts.
struct VtkArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> numbers;
    std::vector<std::string> texts; ///< in place of numbers
    int line = 0;                   ///< of the file, for messages
};

/// What the data of a cell say about the block that it belongs to.
struct VtkLabel {
    std::string part; ///< cells of different parts are never in one block
    std::string group;
    int region = 0, material = 0; ///< 0: none
    auto operator<=>(const VtkLabel&) const = default;
};

class VtkMesh {
public:
    explicit VtkMesh(std::string name) : file(std::move(name)) {}

    std::string file;
    std::vector<Vec3> points;
    std::vector<int> types; ///< of cells, by the numbers that VTK gives them; 0: left out
    std::map<std::size_t, std::vector<std::vector<int>>> faces; ///< of the cells that are polyhedra: their loops
    std::vector<VtkArray> cell_data;                            ///< those that label cells, with a value for each cell
    std::map<std::string, std::vector<std::string>> names;      ///< lists of texts by the name of their array

    std::span<const int> corners(std::size_t cell) const;
    std::string type_of(std::size_t cell) const; ///< as messages call it

    /// Throws Diagnostic "file, line n: message"; without the line when it is 0.
    [[noreturn]] void fail(int line, const std::string& message, const std::string& hint = {}) const;
    [[noreturn]] void fail_at_cell(std::size_t cell, const std::string& message, const std::string& hint = {}) const;

    /// The points of a piece; their numbers in the piece count from 0.
    void add_points(const VtkArray& coordinates);
    /// Cells of the last piece: the corners of all, and the end of those of each. `types` has one for each cell, or one for all.
    void add_cells(const VtkArray& corners, std::span<const double> ends, std::span<const double> types);
    /// Cells between the points of the last piece, which stand on a grid with that many points along each axis, the first axis fastest:
    /// hexahedra, or quadrilaterals where one axis has one point.
    void add_grid(const std::array<std::size_t, 3>& points_along);
    /// A cell whose faces follow each other: the number of corners of each and its corners.
    void add_polyhedron(std::size_t cell, std::span<const double> face_list);
    /// The array labels cells, leaves out cells, or names labels.
    static bool wanted(std::string_view name);
    /// The values of the last piece are added to the array of that name. Those that mark cells as copies of cells of another piece, or as
    /// hidden, leave these out.
    void add_cell_data(VtkArray array);
    /// Adds another mesh as further pieces.
    void append(const VtkMesh& other);
    /// Fails when a grid of that many points would be far larger than its file of so many bytes.
    void require_size(int line, const std::array<std::size_t, 3>& points_along, std::size_t bytes) const;

    /// The label of each cell. Throws Diagnostic when an array has another number of values.
    std::vector<VtkLabel> labels() const;

private:
    int corner(std::size_t cell, double number) const;

    std::vector<int> corners_; ///< of all cells
    std::vector<std::size_t> ends_;
    std::size_t first_point_ = 0; ///< of the last piece
};

/// Reads a file of either format, whatever its suffix: legacy (text or binary) or XML. Throws Diagnostic with file and line.
VtkMesh read_vtk_mesh(std::string_view bytes, const std::string& file);
VtkMesh read_vtk_legacy(std::string_view bytes, const std::string& file);
VtkMesh read_vtk_xml(std::string_view bytes, const std::string& file);

/// The names of the files of its pieces, when that is what an XML file holds; otherwise none.
std::vector<std::string> vtk_piece_files(std::string_view bytes, const std::string& file);

} // namespace kaya
