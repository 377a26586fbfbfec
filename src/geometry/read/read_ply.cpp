// Polygon files: a header with the layout, then vertices and faces as text or binary. Faces with the property `block` belong to the object of
// that number; "comment group N NAME" names its group.
#include "base/diagnostic.hpp"
#include "geometry/read/binary_numbers.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/read/text_lines.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace kaya {
namespace {

struct NamedType {
    std::string_view name, other_name;
    NumberType type;
};

constexpr std::array number_types{
    NamedType{"char", "int8", {NumberKind::signed_whole, 1}},
    NamedType{"uchar", "uint8", {NumberKind::unsigned_whole, 1}},
    NamedType{"short", "int16", {NumberKind::signed_whole, 2}},
    NamedType{"ushort", "uint16", {NumberKind::unsigned_whole, 2}},
    NamedType{"int", "int32", {NumberKind::signed_whole, 4}},
    NamedType{"uint", "uint32", {NumberKind::unsigned_whole, 4}},
    NamedType{"float", "float32", {NumberKind::real, 4}},
    NamedType{"double", "float64", {NumberKind::real, 8}},
};

struct Property {
    std::string name;
    const NamedType* type = nullptr;
    const NamedType* count_type = nullptr; ///< of lists only
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
    std::map<long long, std::string> groups; ///< of objects
    std::size_t bytes = 0;                   ///< length of the header
};

const NamedType* type_called(Words& words) {
    const std::string_view name = words.next_in_line();
    for (const NamedType& type : number_types)
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
        } else if (word == "comment" && same_word(words.peek(), "group")) {
            words.next_in_line();
            const std::string_view object = words.next_in_line();
            if (const auto value = number(object)) header.groups[std::llround(*value)] = words.next_in_line();
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

    double number(const NamedType& named) {
        if (storage_ == Storage::text) return words_.number("a number");
        const NumberType& type = named.type;
        if (bytes_.size() - at_ < type.bytes)
            throw Diagnostic(fmt::format("{} ends before all its elements are read", file_), "export it again");
        const double value = number_at(bytes_.data() + at_, type, storage_ == Storage::big);
        at_ += type.bytes;
        if (!std::isfinite(value))
            throw Diagnostic(fmt::format("{} has a coordinate that is not a finite number", file_));
        return value;
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
    std::map<long long, FaceSoup> objects;
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
            long long object = 0;
            std::vector<std::vector<Vec3>> loops;
            for (const Property& property : element.properties) {
                if (!property.count_type) {
                    const double value = body.number(*property.type);
                    if (property.name == "block") object = std::llround(value);
                    continue;
                }
                const std::vector<double> list = read_list(body, property, file);
                if (is_face && (property.name == "vertex_indices" || property.name == "vertex_index"))
                    loops.push_back(loop_of(list, vertices, file));
            }
            if (loops.empty()) continue;
            auto& all = objects[object].loops;
            std::ranges::move(loops, std::back_inserter(all));
        }
    }
    std::vector<FaceSoup> soups;
    for (auto& [object, soup] : objects) {
        if (const auto group = header.groups.find(object); group != header.groups.end()) soup.name = group->second;
        soups.push_back(std::move(soup));
    }
    return soups;
}

} // namespace kaya
