// Polygon files: a header with the layout, then vertices and faces as text or binary.
#include "base/diagnostic.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace kaya {
namespace {

enum class Kind { signed_whole, unsigned_whole, real };

struct NumberType {
    std::string_view name, other_name;
    Kind kind;
    std::size_t bytes;
};
constexpr std::array number_types{
    NumberType{"char", "int8", Kind::signed_whole, 1},   NumberType{"uchar", "uint8", Kind::unsigned_whole, 1},
    NumberType{"short", "int16", Kind::signed_whole, 2}, NumberType{"ushort", "uint16", Kind::unsigned_whole, 2},
    NumberType{"int", "int32", Kind::signed_whole, 4},   NumberType{"uint", "uint32", Kind::unsigned_whole, 4},
    NumberType{"float", "float32", Kind::real, 4},       NumberType{"double", "float64", Kind::real, 8},
};

struct Property {
    std::string name;
    const NumberType* type = nullptr;
    const NumberType* count_type = nullptr; ///< of lists only
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Storage { text, little, big };

struct Header {
    Storage storage = Storage::text;
    std::vector<Element> elements;
    std::size_t bytes = 0; ///< length of the header
};

const NumberType* type_called(Words& words) {
    const std::string_view name = words.next_in_line();
    for (const NumberType& type : number_types)
        if (name == type.name || name == type.other_name) return &type;
    words.fail(fmt::format("'{}' is not a type of number", name.substr(0, 30)));
}

Header read_header(std::string_view bytes, const std::string& file) {
    static constexpr std::string_view end_mark = "end_header";
    const std::size_t end = bytes.find(end_mark);
    if (bytes.substr(0, 3) != "ply" || end == std::string_view::npos)
        throw Diagnostic(fmt::format("{} is not a PLY file: it has no header from 'ply' to 'end_header'", file));
    Header header;
    const std::size_t line_end = bytes.find('\n', end);
    header.bytes = line_end == std::string_view::npos ? bytes.size() : line_end + 1;
    Words words(bytes.substr(0, end), file, "", "");
    words.expect("ply");
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (word == "format") {
            const std::string_view storage = words.next_in_line();
            if (storage == "ascii") header.storage = Storage::text;
            else if (storage == "binary_little_endian") header.storage = Storage::little;
            else if (storage == "binary_big_endian") header.storage = Storage::big;
            else words.fail(fmt::format("the format '{}' is not known", storage.substr(0, 30)));
        } else if (word == "element") {
            Element element;
            element.name = words.next_in_line();
            const long long count = words.integer_in_line("the number of elements");
            // Every element takes at least one byte, so a larger count is wrong.
            if (count < 0 || static_cast<unsigned long long>(count) > bytes.size())
                words.fail(
                    fmt::format("{} elements '{}' are more than the file can hold", count, element.name.substr(0, 30)));
            element.count = static_cast<std::size_t>(count);
            header.elements.push_back(std::move(element));
        } else if (word == "property") {
            if (header.elements.empty()) words.fail("a property stands before the first element");
            Property property;
            if (same_word(words.peek(), "list")) {
                words.next_in_line();
                property.count_type = type_called(words);
            }
            property.type = type_called(words);
            property.name = words.next_in_line();
            header.elements.back().properties.push_back(std::move(property));
        }
        words.skip_line();
    }
    return header;
}

/// The numbers of the body in order, for either encoding.
class Body {
public:
    Body(std::string_view bytes, const Header& header, const std::string& file)
        : bytes_(bytes.substr(header.bytes)), storage_(header.storage), file_(file), words_(bytes_, file, "", "") {}

    double number(const NumberType& type) {
        if (storage_ == Storage::text) return words_.number("a number");
        if (bytes_.size() - at_ < type.bytes)
            throw Diagnostic(fmt::format("{} ends before all its elements are read", file_), "export it again");
        std::array<unsigned char, 8> raw{};
        for (std::size_t i = 0; i < type.bytes; ++i)
            raw[storage_ == Storage::big ? type.bytes - 1 - i : i] = static_cast<unsigned char>(bytes_[at_ + i]);
        at_ += type.bytes;
        if (type.kind == Kind::real) {
            double wide = 0;
            float narrow = 0;
            if (type.bytes == 8) std::memcpy(&wide, raw.data(), 8);
            else std::memcpy(&narrow, raw.data(), 4);
            const double value = type.bytes == 8 ? wide : narrow;
            if (!std::isfinite(value))
                throw Diagnostic(fmt::format("{} has a coordinate that is not a finite number", file_));
            return value;
        }
        std::uint64_t whole = 0;
        std::memcpy(&whole, raw.data(), 8);
        const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
        if (type.kind == Kind::signed_whole && (whole & sign))
            return static_cast<double>(whole) - 2 * static_cast<double>(sign);
        return static_cast<double>(whole);
    }

private:
    std::string_view bytes_;
    Storage storage_;
    const std::string& file_;
    Words words_;
    std::size_t at_ = 0;
};

Vec3 read_vertex(Body& body, const Element& element) {
    Vec3 vertex = Vec3::Zero();
    for (const Property& property : element.properties) {
        const double value = body.number(*property.type);
        if (property.name == "x") vertex.x() = value;
        if (property.name == "y") vertex.y() = value;
        if (property.name == "z") vertex.z() = value;
    }
    return vertex;
}

std::vector<double> read_list(Body& body, const Property& property, const std::string& file) {
    const double count = body.number(*property.count_type);
    if (!(count >= 0) || count > 1e6 || count != std::floor(count))
        throw Diagnostic(fmt::format("{} has a face of {} corners", file, count));
    std::vector<double> list(static_cast<std::size_t>(count));
    for (double& value : list) value = body.number(*property.type);
    return list;
}

std::vector<Vec3> loop_of(const std::vector<double>& numbers, const std::vector<Vec3>& vertices,
                          const std::string& file) {
    std::vector<Vec3> loop;
    for (const double number : numbers) {
        if (!(number >= 0) || number >= static_cast<double>(vertices.size()) || number != std::floor(number))
            throw Diagnostic(fmt::format("{} has a face with vertex {}, and the vertices are 0 to {}", file, number,
                                         static_cast<long long>(vertices.size()) - 1));
        loop.push_back(vertices[static_cast<std::size_t>(number)]);
    }
    return loop;
}

} // namespace

std::vector<FaceSoup> read_ply(std::string_view bytes, const std::string& file) {
    const Header header = read_header(bytes, file);
    Body body(bytes, header, file);
    std::vector<Vec3> vertices;
    FaceSoup soup;
    for (const Element& element : header.elements) {
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
        for (const Property& property : element.properties)
            if (is_vertex && property.count_type)
                throw Diagnostic(fmt::format("{}: a vertex has the list '{}'", file, property.name.substr(0, 30)),
                                 "export vertices with coordinates only");
        if (element.properties.empty()) continue;
        for (std::size_t i = 0; i < element.count; ++i) {
            if (is_vertex) {
                vertices.push_back(read_vertex(body, element));
                continue;
            }
            for (const Property& property : element.properties) {
                if (!property.count_type) {
                    body.number(*property.type);
                    continue;
                }
                const std::vector<double> list = read_list(body, property, file);
                if (is_face && (property.name == "vertex_indices" || property.name == "vertex_index"))
                    soup.loops.push_back(loop_of(list, vertices, file));
            }
        }
    }
    return {std::move(soup)};
}

} // namespace kaya
