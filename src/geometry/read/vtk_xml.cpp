// VTK's XML files of unstructured grids (.vtu), polygonal data (.vtp), structured grids (.vts), rectilinear ones (.vtr) and images (.vti): https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html.
#include "base/base64.hpp"
#include "base/deflate.hpp"
#include "base/lower_case.hpp"
#include "base/lz4_block.hpp"
#include "base/stop_point.hpp"
#include "geometry/read/binary_numbers.hpp"
#include "geometry/read/text_lines.hpp"
#include "geometry/read/vtk_xml_document.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace kaya {
namespace {

struct XmlType {
    std::string_view name;
    NumberType type;
};
constexpr std::array xml_types{
    XmlType{"Int8", {NumberKind::signed_whole, 1}},  XmlType{"UInt8", {NumberKind::unsigned_whole, 1}},
    XmlType{"Int16", {NumberKind::signed_whole, 2}}, XmlType{"UInt16", {NumberKind::unsigned_whole, 2}},
    XmlType{"Int32", {NumberKind::signed_whole, 4}}, XmlType{"UInt32", {NumberKind::unsigned_whole, 4}},
    XmlType{"Int64", {NumberKind::signed_whole, 8}}, XmlType{"UInt64", {NumberKind::unsigned_whole, 8}},
    XmlType{"Float32", {NumberKind::real, 4}},       XmlType{"Float64", {NumberKind::real, 8}},
};

/// Bytes of an array: as they lie in the file, or as base64.
class XmlBytes {
public:
    static XmlBytes raw(std::string_view bytes) { return XmlBytes(bytes, std::nullopt); }
    static XmlBytes coded(std::string_view text) { return XmlBytes({}, Base64Reader(text)); }

    std::optional<std::string> take(std::size_t count) {
        if (coded_) return coded_->take(count);
        if (count > bytes_.size()) return std::nullopt;
        std::string result(bytes_.substr(0, count));
        bytes_.remove_prefix(count);
        return result;
    }

private:
    XmlBytes(std::string_view bytes, std::optional<Base64Reader> coded) : bytes_(bytes), coded_(coded) {}
    std::string_view bytes_;
    std::optional<Base64Reader> coded_;
};

/// The numbers and texts of the arrays of a document.
class XmlData {
public:
    XmlData(const XmlDocument& document, const VtkMesh& mesh, std::size_t file_size)
        : document_(document), mesh_(mesh), file_size_(file_size), bytes_left_(greatest_ratio * file_size) {
        big_ = value_of(document.file, "byte_order") == "BigEndian";
        long_header_ = value_of(document.file, "header_type") == "UInt64";
        const std::string_view compressor = value_of(document.file, "compressor");
        if (compressor == "vtkZLibDataCompressor") unpack_ = inflated;
        else if (compressor == "vtkLZ4DataCompressor") unpack_ = from_lz4;
        else if (!compressor.empty())
            mesh_.fail(0,
                       fmt::format("it is compressed by {}; vtkZLibDataCompressor and vtkLZ4DataCompressor are read",
                                   compressor.substr(0, 40)),
                       "save it with the compressor ZLib or LZ4, or with none");
    }

    VtkArray array(const XmlArray& given) {
        VtkArray result{std::string(value_of(given.attributes, "Name")), 1, {}, {}, given.line};
        if (const auto components = value_of(given.attributes, "NumberOfComponents"); !components.empty())
            result.components = whole(components, given.line, "the number of components");
        const std::string_view type = value_of(given.attributes, "type"), format = value_of(given.attributes, "format");
        const auto known = std::ranges::find(xml_types, type, &XmlType::name);
        const bool is_text = type == "String";
        if (known == xml_types.end() && !is_text)
            mesh_.fail(given.line, fmt::format("'{}' is not a type of numbers", type.substr(0, 30)));
        if (format == "ascii" || format.empty()) {
            result.numbers = numbers_of(given);
            if (!is_text) return result;
            std::string codes;
            for (const double code : result.numbers)
                codes += static_cast<char>(static_cast<int>(std::clamp(code, 0.0, 255.0)));
            result.numbers.clear();
            result.texts = texts_in(codes);
            return result;
        }
        const std::string bytes = bytes_of(given, format);
        if (is_text) {
            result.texts = texts_in(bytes);
            return result;
        }
        const std::size_t size = known->type.bytes;
        if (bytes.size() % size != 0)
            mesh_.fail(given.line, fmt::format("{} bytes are not a whole number of {}", bytes.size(), type));
        result.numbers.reserve(bytes.size() / size);
        for (std::size_t at = 0; at < bytes.size(); at += size)
            result.numbers.push_back(number_at(bytes.data() + at, known->type, big_));
        return result;
    }

    /// A whole number that is not below 0.
    std::size_t whole(std::string_view text, int line, std::string_view what) const {
        const auto value = number(text);
        if (!value || *value < 0 || *value != std::floor(*value) || *value > 1e15)
            mesh_.fail(line, fmt::format("{} is '{}', and must be a whole number", what, text.substr(0, 30)));
        return static_cast<std::size_t>(*value);
    }

private:
    std::vector<double> numbers_of(const XmlArray& given) const {
        std::vector<double> numbers;
        int line = given.line;
        StopPoints stops;
        for (std::string_view text = given.text; !text.empty();) {
            stops.pass();
            if (text[0] == '\n') ++line;
            if (text[0] == ' ' || text[0] == '\n' || text[0] == '\t' || text[0] == '\r') {
                text.remove_prefix(1);
                continue;
            }
            const std::string_view word = text.substr(0, std::min(text.find_first_of(" \t\r\n"), text.size()));
            const auto value = number(word);
            if (!value) mesh_.fail(line, fmt::format("'{}' is not a number", word.substr(0, 30)));
            numbers.push_back(*value);
            text.remove_prefix(word.size());
        }
        return numbers;
    }

    std::string bytes_of(const XmlArray& given, std::string_view format) {
        if (format == "binary") return unpacked(XmlBytes::coded(given.text), given.line);
        if (format != "appended")
            mesh_.fail(given.line, fmt::format("the format '{}' is not known", format.substr(0, 30)));
        if (document_.appended.data() == nullptr) mesh_.fail(given.line, "the file has no appended data");
        const std::size_t offset = whole(value_of(given.attributes, "offset"), given.line, "the offset");
        if (offset >= document_.appended.size())
            mesh_.fail(given.line,
                       fmt::format("its data begin at {}, and there are {} bytes", offset, document_.appended.size()));
        const std::string_view from = document_.appended.substr(offset);
        if (document_.appended_is_raw) return unpacked(XmlBytes::raw(from), given.line);
        return unpacked(XmlBytes::coded(from.substr(0, from.find('<'))), given.line);
    }

    [[noreturn]] void cut_off(int line) const {
        mesh_.fail(line, "its data are cut off or damaged", "save the mesh again");
    }

    std::size_t header_number(XmlBytes& source, int line) const {
        const NumberType type{NumberKind::unsigned_whole, long_header_ ? std::size_t{8} : std::size_t{4}};
        const auto bytes = source.take(type.bytes);
        const double value = bytes ? number_at(bytes->data(), type, big_) : -1;
        if (!(value >= 0) || value > 1e15) cut_off(line);
        return static_cast<std::size_t>(value);
    }

    /// The number of bytes and the bytes; or the number of blocks, bytes of a block, bytes of the last when it is shorter, those of each
    /// stream, and the streams.
    std::string unpacked(XmlBytes source, int line) {
        const std::size_t first = header_number(source, line);
        if (unpack_ == nullptr) {
            spend(first, line);
            auto bytes = source.take(first);
            if (!bytes) cut_off(line);
            return std::move(*bytes);
        }
        const std::size_t full = header_number(source, line), last = header_number(source, line);
        if (first > file_size_) cut_off(line);
        std::vector<std::size_t> sizes(first);
        for (std::size_t& size : sizes) size = header_number(source, line);
        std::string result;
        for (std::size_t k = 0; k < first; ++k) {
            stop_point();
            const std::size_t size = k + 1 == first && last > 0 ? last : full;
            spend(size, line);
            const auto stream = source.take(sizes[k]);
            const auto bytes = stream ? unpack_(*stream, size) : std::nullopt;
            if (!bytes) cut_off(line);
            result += *bytes;
        }
        return result;
    }

    void spend(std::size_t bytes, int line) {
        if (bytes > bytes_left_) mesh_.fail(line, "the arrays claim more data than the file can hold");
        bytes_left_ -= bytes;
    }

    /// Each text ends with a zero.
    static std::vector<std::string> texts_in(std::string_view bytes) {
        std::vector<std::string> texts;
        while (!bytes.empty()) {
            const std::size_t end = std::min(bytes.find('\0'), bytes.size());
            texts.emplace_back(bytes.substr(0, end));
            bytes.remove_prefix(std::min(end + 1, bytes.size()));
        }
        return texts;
    }

    const XmlDocument& document_;
    const VtkMesh& mesh_;
    /// Of all data to the file: meshes stay below 50, a stream of zeros reaches 1,000, and arrays may name the same data.
    static constexpr std::size_t greatest_ratio = 256;
    std::size_t file_size_, bytes_left_;
    bool big_ = false, long_header_ = false;
    std::optional<std::string> (*unpack_)(std::string_view stream, std::size_t size) = nullptr; ///< of packed arrays
};

/// Lists of cells of polygonal data in the order in which cells are numbered, with their type.
struct XmlCells {
    std::string_view section, count;
    double type;
};
constexpr std::array xml_cells{XmlCells{"Verts", "NumberOfVerts", 2}, XmlCells{"Lines", "NumberOfLines", 4},
                               XmlCells{"Polys", "NumberOfPolys", 7}, XmlCells{"Strips", "NumberOfStrips", 6}};

class XmlPieceReader {
public:
    XmlPieceReader(const XmlPiece& piece, XmlData& data, VtkMesh& mesh) : piece_(piece), data_(data), mesh_(mesh) {}

    void read(const XmlDocument& document, std::size_t file_size) {
        const bool is_structured = document.kind != "UnstructuredGrid" && document.kind != "PolyData";
        if (!is_structured) points();
        const std::size_t first = mesh_.types.size();
        if (is_structured) structured(document, file_size);
        else if (document.kind == "UnstructuredGrid") cells("Cells", "NumberOfCells", {});
        else
            for (const XmlCells& list : xml_cells)
                if (find(list.section, "connectivity") != nullptr) cells(list.section, list.count, list.type);
        for (const XmlArray& array : piece_.arrays)
            if (array.section == "CellData") cell_data(array, mesh_.types.size() - first);
    }

private:
    const XmlArray* find(std::string_view section, std::string_view name) const {
        const auto found = std::ranges::find_if(piece_.arrays, [&](const XmlArray& array) {
            return array.section == section && (name.empty() || value_of(array.attributes, "Name") == name);
        });
        return found == piece_.arrays.end() ? nullptr : &*found;
    }

    VtkArray needed(std::string_view section, std::string_view name) const {
        const XmlArray* array = find(section, name);
        if (array == nullptr)
            mesh_.fail(piece_.line, fmt::format("{} of the Piece has no {}", section, name.empty() ? "array" : name));
        return data_.array(*array);
    }

    std::size_t count(std::string_view name) const {
        const auto text = value_of(piece_.attributes, name);
        return text.empty() ? 0 : data_.whole(text, piece_.line, name);
    }

    void require_count(const VtkArray& array, std::size_t wanted, std::string_view what) const {
        if (array.numbers.size() != wanted)
            mesh_.fail(array.line,
                       fmt::format("there are {} numbers, and {} need {}", array.numbers.size(), what, wanted));
    }

    void points() {
        const std::size_t wanted = count("NumberOfPoints");
        if (wanted == 0 && find("Points", "") == nullptr) return;
        const VtkArray coordinates = needed("Points", "");
        require_count(coordinates, 3 * wanted, "the coordinates of the points");
        mesh_.add_points(coordinates);
    }

    using Along = std::array<std::size_t, 3>;

    /// Numbers of an attribute, with blanks between them.
    template <std::size_t Count>
    std::array<double, Count> numbers_in(const XmlAttributes& attributes, std::string_view name, int line) const {
        const std::string_view text = value_of(attributes, name);
        const auto words = words_of(text);
        std::array<double, Count> numbers{};
        for (std::size_t k = 0; k < Count; ++k) {
            const auto value = words.size() == Count ? number(words[k]) : std::nullopt;
            if (!value)
                mesh_.fail(line, fmt::format("{} is '{}', and must be {} numbers", name, text.substr(0, 60), Count));
            numbers[k] = *value;
        }
        return numbers;
    }

    /// A grid whose points are counted along three axes from the extent of its piece.
    void structured(const XmlDocument& document, std::size_t file_size) {
        const auto extent = numbers_in<6>(piece_.attributes, "Extent", piece_.line);
        Along along{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double points = extent[2 * k + 1] - extent[2 * k] + 1;
            if (points != std::floor(points) || !(points < 1e9))
                mesh_.fail(piece_.line, fmt::format("the extent from {} to {} is not a range of whole numbers",
                                                    extent[2 * k], extent[2 * k + 1]));
            if (points < 1) return; // an empty piece
            along[k] = static_cast<std::size_t>(points);
        }
        mesh_.require_size(piece_.line, along, file_size);
        VtkArray places;
        if (document.kind == "StructuredGrid") {
            places = needed("Points", "");
            require_count(places, 3 * along[0] * along[1] * along[2], "the coordinates of the points");
        } else {
            places = document.kind == "ImageData" ? image(document, extent, along) : rectilinear(along);
        }
        mesh_.add_points(places);
        mesh_.add_grid(along);
    }

    /// Calls place(i, j, k) for the coordinates of each point.
    static VtkArray each_point(const Along& along, int line, auto place) {
        VtkArray places{"", 3, {}, {}, line};
        for (std::size_t k = 0; k < along[2]; ++k)
            for (std::size_t j = 0; j < along[1]; ++j)
                for (std::size_t i = 0; i < along[0]; ++i)
                    for (const double x : place(i, j, k)) places.numbers.push_back(x);
        return places;
    }

    VtkArray rectilinear(const Along& along) const {
        std::vector<VtkArray> axes;
        for (const XmlArray& array : piece_.arrays)
            if (array.section == "Coordinates") axes.push_back(data_.array(array));
        if (axes.size() != 3)
            mesh_.fail(piece_.line, fmt::format("there are {} arrays of Coordinates, and three axes", axes.size()));
        for (std::size_t k = 0; k < 3; ++k) require_count(axes[k], along[k], "the coordinates of an axis");
        return each_point(along, piece_.line, [&](std::size_t i, std::size_t j, std::size_t k) {
            return std::array{axes[0].numbers[i], axes[1].numbers[j], axes[2].numbers[k]};
        });
    }

    /// The direction is a matrix by rows, none if it is not given.
    VtkArray image(const XmlDocument& document, const std::array<double, 6>& extent, const Along& along) const {
        const auto origin = numbers_in<3>(document.data, "Origin", piece_.line),
                   spacing = numbers_in<3>(document.data, "Spacing", piece_.line);
        std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};
        if (!value_of(document.data, "Direction").empty())
            direction = numbers_in<9>(document.data, "Direction", piece_.line);
        return each_point(along, piece_.line, [&](std::size_t i, std::size_t j, std::size_t k) {
            const std::array steps{spacing[0] * (extent[0] + static_cast<double>(i)),
                                   spacing[1] * (extent[2] + static_cast<double>(j)),
                                   spacing[2] * (extent[4] + static_cast<double>(k))};
            std::array<double, 3> place = origin;
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t axis = 0; axis < 3; ++axis) place[row] += direction[3 * row + axis] * steps[axis];
            return place;
        });
    }

    void cells(std::string_view section, std::string_view number, std::optional<double> type) {
        const std::size_t wanted = count(number);
        if (wanted == 0) return;
        const VtkArray corners = needed(section, "connectivity"), ends = needed(section, "offsets");
        require_count(ends, wanted, "the cells");
        VtkArray types;
        if (type) types.numbers = {*type};
        else {
            types = needed(section, "types");
            require_count(types, wanted, "the cells");
        }
        const std::size_t first = mesh_.types.size();
        mesh_.add_cells(corners, ends.numbers, types.numbers);
        if (!type && find(section, "faces") != nullptr) polyhedra(first, wanted);
        if (!type && find(section, "polyhedron_to_faces") != nullptr) new_polyhedra(first, wanted);
    }

    /// A list of numbers and the place where it ends.
    std::size_t ordered(double end, std::size_t begin, std::size_t size, std::size_t cell) const {
        if (!(end >= static_cast<double>(begin)) || end > static_cast<double>(size) || end != std::floor(end))
            mesh_.fail_at_cell(cell, fmt::format("its faces end at {}, after {} and before {}", end, begin, size));
        return static_cast<std::size_t>(end);
    }

    /// Of each polyhedron the number of its faces, and of each face the number of its corners and the corners; the end of each, -1 for
    /// cells of other types.
    void polyhedra(std::size_t first, std::size_t cells) {
        const VtkArray list = needed("Cells", "faces"), ends = needed("Cells", "faceoffsets");
        require_count(ends, cells, "the polyhedra");
        std::size_t at = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            if (ends.numbers[k] < 0) continue;
            const std::size_t end = ordered(ends.numbers[k], at, list.numbers.size(), first + k);
            if (end > at) mesh_.add_polyhedron(first + k, std::span(list.numbers).subspan(at + 1, end - at - 1));
            at = end;
        }
    }

    /// Since VTK 9.4: the corners of all faces, the end of those of each, the faces of all polyhedra, the end of those of each.
    void new_polyhedra(std::size_t first, std::size_t cells) {
        const VtkArray corners = needed("Cells", "face_connectivity"), face_ends = needed("Cells", "face_offsets"),
                       faces = needed("Cells", "polyhedron_to_faces"), ends = needed("Cells", "polyhedron_offsets");
        require_count(ends, cells, "the polyhedra");
        std::size_t at = 0, used = 0;
        for (std::size_t k = 0; k < cells; ++k) {
            std::vector<double> list;
            for (const std::size_t end = ordered(ends.numbers[k], at, faces.numbers.size(), first + k); at < end;
                 ++at) {
                const double face = faces.numbers[at];
                if (!(face >= 0) || face >= static_cast<double>(face_ends.numbers.size()) || face != std::floor(face))
                    mesh_.fail_at_cell(first + k,
                                       fmt::format("it has face {}, and there are {}", face, face_ends.numbers.size()));
                const auto f = static_cast<std::size_t>(face);
                const std::size_t begin =
                    f == 0 ? 0 : ordered(face_ends.numbers[f - 1], 0, corners.numbers.size(), first + k);
                const std::size_t stop = ordered(face_ends.numbers[f], begin, corners.numbers.size(), first + k);
                if ((used += stop - begin) > 2 * corners.numbers.size())
                    mesh_.fail_at_cell(first + k, "a face belongs to more than two polyhedra");
                list.push_back(static_cast<double>(stop - begin));
                for (std::size_t i = begin; i < stop; ++i) list.push_back(corners.numbers[i]);
            }
            if (!list.empty()) mesh_.add_polyhedron(first + k, list);
        }
    }

    void cell_data(const XmlArray& given, std::size_t cells) {
        VtkArray array = data_.array(given);
        if (array.components != 1) return;
        const std::size_t values = array.texts.empty() ? array.numbers.size() : array.texts.size();
        if (values != cells)
            mesh_.fail(array.line, fmt::format("'{}' has {} values for {} cells", array.name, values, cells));
        mesh_.add_cell_data(std::move(array));
    }

    const XmlPiece& piece_;
    XmlData& data_;
    VtkMesh& mesh_;
};

} // namespace

namespace {

bool is_of_pieces(const XmlDocument& document) { return document.kind.starts_with('P') && document.kind != "PolyData"; }

} // namespace

VtkMesh read_vtk_xml(std::string_view bytes, const std::string& file) {
    VtkMesh mesh(file);
    const XmlDocument document = read_xml_document(bytes, mesh);
    if (is_of_pieces(document))
        mesh.fail(0, fmt::format("the data are a <{}> again", document.kind),
                  "a piece is a file with points and cells");
    XmlData data(document, mesh, bytes.size());
    for (const XmlArray& list : document.whole) {
        VtkArray array = data.array(list);
        mesh.names[lower_case(array.name)] = std::move(array.texts);
    }
    for (const XmlPiece& piece : document.pieces) XmlPieceReader(piece, data, mesh).read(document, bytes.size());
    return mesh;
}

std::vector<std::string> vtk_piece_files(std::string_view bytes, const std::string& file) {
    std::vector<std::string> files;
    if (bytes.starts_with("# vtk") || bytes.substr(0, 1000).find('<') == bytes.npos) return files;
    const VtkMesh mesh(file);
    const XmlDocument document = read_xml_document(bytes, mesh);
    if (!is_of_pieces(document)) return files;
    for (const XmlPiece& piece : document.pieces) {
        files.emplace_back(value_of(piece.attributes, "Source"));
        if (files.back().empty()) mesh.fail(piece.line, "a Piece has no Source", "save the mesh again");
    }
    if (files.empty()) mesh.fail(0, "it has no pieces", "save the mesh again");
    return files;
}

} // namespace kaya
