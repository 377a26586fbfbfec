#include "geometry/grid/vtu_grid.hpp"

#include "base/markup_text.hpp"
#include "base/parallel.hpp"
#include "base/deflate.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <numeric>
#include <set>

namespace kaya {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say that their numbers are little-endian");

constexpr std::size_t block_size = 1U << 18; // bytes before compression

std::string_view bytes_of(const auto& numbers) {
    return {reinterpret_cast<const char*>(std::data(numbers)), std::size(numbers) * sizeof(*std::data(numbers))};
}

/// Numbers of 32 bits: number of blocks, bytes of a block, bytes of the last block when it is not full (else 0), compressed bytes of
/// each block. Then the blocks.
std::string compressed_blocks(std::string_view bytes) {
    std::vector<std::string> blocks((bytes.size() + block_size - 1) / block_size);
    for_chunks(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) blocks[k] = deflated(bytes.substr(k * block_size, block_size));
    });
    std::vector<std::uint32_t> header{static_cast<std::uint32_t>(blocks.size()), block_size,
                                      static_cast<std::uint32_t>(bytes.size() % block_size)};
    for (const auto& block : blocks) header.push_back(static_cast<std::uint32_t>(block.size()));
    return std::accumulate(blocks.begin(), blocks.end(), std::string(bytes_of(header)));
}

VtuArray text_array(std::string name, std::span<const std::string> texts) {
    std::string bytes; // each text ends with a zero
    for (const auto& text : texts) bytes += text + '\0';
    return {std::move(name), texts.size(), "type=\"String\"", {}, compressed_blocks(bytes)};
}

template <class Number> constexpr const char* type_name = nullptr;
template <> constexpr const char* type_name<double> = "Float64";
template <> constexpr const char* type_name<std::int64_t> = "Int64";
template <> constexpr const char* type_name<std::int32_t> = "Int32";
template <> constexpr const char* type_name<std::uint8_t> = "UInt8";

/// The XML elements of a file, followed by its data.
struct Document {
    std::string text, data;

    void add(const VtuArray& array, bool counted) {
        const char* element = array.attributes.starts_with("type=\"String\"") ? "Array" : "DataArray";
        text += fmt::format("<{} {} Name=\"{}\"", element, array.attributes, markup_text(array.name));
        // The piece has the numbers of points and cells.
        if (counted) text += fmt::format(" NumberOfTuples=\"{}\"", array.tuples);
        text += fmt::format(" format=\"appended\" offset=\"{}\">{}</{}>\n", data.size(), array.content, element);
        data += array.data;
    }

    void add(const char* section, std::span<const VtuArray> arrays, bool counted = false) {
        text += fmt::format("<{}>\n", section);
        for (const auto& array : arrays) add(array, counted);
        text += fmt::format("</{}>\n", section);
    }
};

} // namespace

template <class Number>
VtuArray vtu_array(std::string name, std::span<const Number> numbers, const VtuMeaning& meaning) {
    VtuArray array{std::move(name),
                   numbers.size() / meaning.components,
                   fmt::format("type=\"{}\"", type_name<Number>),
                   {},
                   compressed_blocks(bytes_of(numbers))};
    if (meaning.components > 1) array.attributes += fmt::format(" NumberOfComponents=\"{}\"", meaning.components);
    for (std::size_t k = 0; k < meaning.component_names.size(); ++k)
        array.attributes += fmt::format(" ComponentName{}=\"{}\"", k, meaning.component_names[k]);
    if (!meaning.unit.empty())
        array.content =
            fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>",
                        markup_text(meaning.unit));
    return array;
}
template VtuArray vtu_array(std::string, std::span<const double>, const VtuMeaning&);
template VtuArray vtu_array(std::string, std::span<const std::int64_t>, const VtuMeaning&);
template VtuArray vtu_array(std::string, std::span<const std::int32_t>, const VtuMeaning&);
template VtuArray vtu_array(std::string, std::span<const std::uint8_t>, const VtuMeaning&);

VtuArray vtu_vectors(std::string name, std::span<const Vec3> vectors, std::string_view unit) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const double* first = vectors.empty() ? nullptr : vectors.front().data();
    return vtu_array(std::move(name), std::span(first, 3 * vectors.size()), {.unit = unit, .components = 3});
}

bool VtuArrays::has(std::string_view name) const { return std::ranges::find(*this, name, &VtuArray::name) != end(); }

void VtuGrid::add_cell(VtuCell shape, std::span<const Row> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(static_cast<std::int64_t>(corners_.size()));
    shapes_.push_back(static_cast<std::uint8_t>(shape));
    if (!face_ends_.empty()) face_ends_.push_back(-1);
}

void VtuGrid::add_polyhedron(std::span<const std::vector<Row>> faces) {
    std::vector<Row> corners; // each once, in the order in which the faces have them
    std::set<Row> known;
    faces_.push_back(static_cast<std::int64_t>(faces.size()));
    for (const auto& face : faces) {
        faces_.push_back(static_cast<std::int64_t>(face.size()));
        faces_.insert(faces_.end(), face.begin(), face.end());
        for (const Row corner : face)
            if (known.insert(corner).second) corners.push_back(corner);
    }
    add_cell(VtuCell::polyhedron, corners);
    face_ends_.resize(shapes_.size(), -1);
    face_ends_.back() = static_cast<std::int64_t>(faces_.size());
}

std::string VtuGrid::bytes() const {
    using Whole = std::span<const std::int64_t>;
    std::vector<VtuArray> cells{vtu_array("connectivity", Whole(corners_)), vtu_array("offsets", Whole(ends_)),
                                vtu_array("types", std::span<const std::uint8_t>(shapes_))};
    if (!face_ends_.empty()) {
        cells.push_back(vtu_array("faces", Whole(faces_)));
        cells.push_back(vtu_array("faceoffsets", Whole(face_ends_)));
    }
    std::vector<VtuArray> whole = whole_data;
    for (const auto& [name, texts] : lists) whole.push_back(text_array(name, texts));
    Document document;
    document.text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
        "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n";
    document.add("FieldData", whole, true);
    document.text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points.size(), shapes_.size());
    document.add("PointData", point_data);
    document.add("CellData", cell_data);
    document.add("Points", std::vector{vtu_vectors("Points", points)});
    document.add("Cells", cells);
    document.text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    return document.text + document.data + "\n</AppendedData>\n</VTKFile>\n";
}

} // namespace kaya
