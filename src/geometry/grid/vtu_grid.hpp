// Unstructured grids as files of VTK's XML format (.vtu), which ParaView reads. The numbers are appended as raw bytes in blocks
// that zlib has compressed.
#pragma once

#include "base/id.hpp"
#include "base/vector.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Shapes of cells by the numbers that the format gives them.
enum class VtuCell : std::uint8_t {
    vertex = 1,
    line = 3,
    triangle = 5,
    polygon = 7,
    tetrahedron = 10,
    polyhedron = 42
};

/// A named array, with its values in the form of the file.
struct VtuArray {
    std::string name;
    std::size_t tuples = 0;
    std::string attributes; ///< of its XML element, without number of tuples and offset
    std::string content;    ///< of its XML element: the quantity that the values measure
    std::string data;
};

/// How the values of an array are read.
struct VtuMeaning {
    std::string_view unit = {}; ///< "length", "stress"; empty: none is written
    std::size_t components = 1; ///< values of one tuple
    std::span<const char* const> component_names = {};
};

/// The numbers of a tuple follow each other.
template <class Number>
VtuArray vtu_array(std::string name, std::span<const Number> numbers, const VtuMeaning& meaning = {});
extern template VtuArray vtu_array(std::string, std::span<const double>, const VtuMeaning&);
extern template VtuArray vtu_array(std::string, std::span<const std::int64_t>, const VtuMeaning&);
extern template VtuArray vtu_array(std::string, std::span<const std::int32_t>, const VtuMeaning&);
extern template VtuArray vtu_array(std::string, std::span<const std::uint8_t>, const VtuMeaning&);
VtuArray vtu_vectors(std::string name, std::span<const Vec3> vectors, std::string_view unit = {});

/// The arrays that describe the points, the cells or the whole grid.
struct VtuArrays : std::vector<VtuArray> {
    bool has(std::string_view name) const;
};

/// The format has no texts of points and cells: they have places in a list that belongs to the whole grid.
using VtuLists = std::map<std::string, std::vector<std::string>>;

class VtuGrid {
public:
    std::vector<Vec3> points;
    VtuArrays point_data, cell_data, whole_data;
    VtuLists lists; ///< by name

    void add_cell(VtuCell shape, std::span<const Row> corners);
    /// Each face is the list of its points in order.
    void add_polyhedron(std::span<const std::vector<Row>> faces);
    /// The file as bytes.
    std::string bytes() const;

private:
    std::vector<std::int64_t> corners_, ends_; ///< of all cells, and the end of those of each cell
    std::vector<std::uint8_t> shapes_;
    std::vector<std::int64_t>
        faces_; ///< of polyhedra: number of faces, and for each its number of points and its points
    std::vector<std::int64_t> face_ends_; ///< of each cell in faces_, from the first polyhedron on; -1: no polyhedron
};

} // namespace kaya
