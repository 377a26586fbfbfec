// VTK's legacy files (.vtk), text and binary: https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html. Binary numbers
// have their highest byte first.
#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "base/stop_point.hpp"
#include "geometry/read/binary_numbers.hpp"
#include "geometry/read/text_lines.hpp"
#include "geometry/read/vtk_mesh.hpp"

#include <array>
#include <fmt/format.h>
#include <optional>

namespace kaya {
namespace {

struct LegacyType {
    std::string_view name;
    NumberType type;
};
constexpr std::array legacy_types{
    LegacyType{"char", {NumberKind::signed_whole, 1}},
    LegacyType{"unsigned_char", {NumberKind::unsigned_whole, 1}},
    LegacyType{"short", {NumberKind::signed_whole, 2}},
    LegacyType{"unsigned_short", {NumberKind::unsigned_whole, 2}},
    LegacyType{"int", {NumberKind::signed_whole, 4}},
    LegacyType{"unsigned_int", {NumberKind::unsigned_whole, 4}},
    LegacyType{"long", {NumberKind::signed_whole, 8}},
    LegacyType{"unsigned_long", {NumberKind::unsigned_whole, 8}},
    LegacyType{"vtkidtype", {NumberKind::signed_whole, 4}},
    LegacyType{"vtktypeint64", {NumberKind::signed_whole, 8}},
    LegacyType{"vtktypeuint64", {NumberKind::unsigned_whole, 8}},
    LegacyType{"vtktypeint32", {NumberKind::signed_whole, 4}},
    LegacyType{"vtktypeuint32", {NumberKind::unsigned_whole, 4}},
    LegacyType{"vtktypeint8", {NumberKind::signed_whole, 1}},
    LegacyType{"vtktypeuint8", {NumberKind::unsigned_whole, 1}},
    LegacyType{"signed_char", {NumberKind::signed_whole, 1}},
    LegacyType{"float", {NumberKind::real, 4}},
    LegacyType{"double", {NumberKind::real, 8}},
};

/// Attributes of points or cells that are read over: components of each value. 0: the line gives them.
struct LegacyData {
    std::string_view word;
    std::size_t components;
};
constexpr std::array legacy_data{
    LegacyData{"vectors", 3},      LegacyData{"normals", 3},    LegacyData{"tensors", 9},
    LegacyData{"tensors6", 6},     LegacyData{"global_ids", 1}, LegacyData{"edge_flags", 1},
    LegacyData{"pedigree_ids", 1}, LegacyData{"scalars", 0},    LegacyData{"texture_coordinates", 0},
};

/// Lists of cells of polygonal data, with the type of all their cells.
struct LegacyCells {
    std::string_view word;
    double type;
};
constexpr std::array legacy_cells{LegacyCells{"vertices", 2}, LegacyCells{"lines", 4}, LegacyCells{"polygons", 7},
                                  LegacyCells{"triangle_strips", 6}};

using Tokens = std::vector<std::string_view>;

/// %20 is a blank.
std::string decoded(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            result += static_cast<char>(code);
            i += 2;
        } else result += text[i];
    }
    return result;
}

class LegacyReader {
public:
    LegacyReader(std::string_view bytes, const std::string& file) : text_(bytes), mesh_(file) {}

    VtkMesh read() {
        header();
        while (const std::optional<Tokens> next = next_line()) {
            const std::string word = lower_case(std::string((*next)[0]));
            if (!section(word, *next) && !data(word, *next))
                fail(fmt::format("a section cannot begin with '{}'", shown((*next)[0])),
                     "sections are POINTS, CELLS, CELL_TYPES, POLYGONS, CELL_DATA and others of VTK's legacy format");
        }
        if (!known_dataset_) fail("the file ends before DATASET");
        close_cells();
        if (is_structured() && !along_done_) fail(fmt::format("the file ends before the points of the {}", kind_));
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& message, const std::string& hint = {}) const {
        mesh_.fail(line_, message, hint);
    }
    static std::string shown(std::string_view word) { return std::string(word.substr(0, 30)); }

    // The text: lines, words of numbers, bytes.

    std::string_view rest_of_line() {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        if (end < text_.size()) ++line_;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    static Tokens split(std::string_view line) {
        Tokens words;
        for (std::size_t at = line.find_first_not_of(" \t\r"); at != line.npos;) {
            const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
            words.push_back(line.substr(at, end - at));
            at = line.find_first_not_of(" \t\r", end);
        }
        return words;
    }

    /// The words of the next line that has any; none at the end of the file. The next line is counted when it has been read: messages about
    /// it name it.
    std::optional<Tokens> next_line() {
        stops_.pass();
        while (at_ < text_.size()) {
            if (pending_line_) ++line_, pending_line_ = false;
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            Tokens words = split(text_.substr(at_, end - at_));
            at_ = std::min(end + 1, text_.size());
            pending_line_ = end < text_.size();
            if (!words.empty()) return words;
        }
        return std::nullopt;
    }

    std::string_view next_word() {
        stops_.pass();
        if (pending_line_) ++line_, pending_line_ = false;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '\n') ++line_;
            else if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r') break;
        }
        const std::size_t end = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
        const std::string_view word = text_.substr(at_, end - at_);
        at_ = end;
        return word;
    }

    std::string_view next_bytes(std::size_t count) {
        if (pending_line_) ++line_, pending_line_ = false;
        if (count > text_.size() - at_) fail("the file ends before all its numbers are read", "export it again");
        const std::string_view bytes = text_.substr(at_, count);
        at_ += count;
        line_ += static_cast<int>(std::ranges::count(bytes, '\n'));
        return bytes;
    }

    /// A number of points, cells or values: each takes a bit of the file at least.
    std::size_t count(const Tokens& line, std::size_t word, std::string_view what) const {
        const auto value = word < line.size() ? number(line[word]) : std::nullopt;
        if (!value || *value < 0 || *value != std::floor(*value))
            fail(fmt::format("expected {}, found '{}'", what, word < line.size() ? shown(line[word]) : ""));
        if (*value > 8.0 * static_cast<double>(text_.size()))
            fail(fmt::format("{} is {}, more than the file can hold", what, *value));
        return static_cast<std::size_t>(*value);
    }

    std::string_view word(const Tokens& line, std::size_t k, std::string_view what) const {
        if (k >= line.size()) fail(fmt::format("{} is missing", what));
        return line[k];
    }

    // Arrays.

    VtkArray array(std::string_view type_name, std::size_t tuples, std::size_t components, bool wanted = true) {
        VtkArray result{"", components, {}, {}, line_ + (pending_line_ ? 1 : 0)};
        if (static_cast<double>(tuples) * static_cast<double>(components) > 8.0 * static_cast<double>(text_.size()))
            fail(fmt::format("{} times {} values are more than the file can hold", tuples, components));
        const std::size_t values = tuples * components;
        const std::string type = lower_case(std::string(type_name));
        if (type == "string") return strings(values, std::move(result));
        if (type == "bit" && is_binary_) {
            const std::string_view bits = next_bytes((values + 7) / 8);
            for (std::size_t i = 0; wanted && i < values; ++i)
                result.numbers.push_back(static_cast<unsigned char>(bits[i / 8]) >> (7 - i % 8) & 1);
            return result;
        }
        const auto known = std::ranges::find(legacy_types, type, &LegacyType::name);
        if (known == legacy_types.end() && type != "bit")
            fail(fmt::format("'{}' is not a type of numbers", shown(type_name)));
        if (is_binary_) {
            const std::size_t size = known->type.bytes;
            const std::string_view bytes = next_bytes(values * size);
            for (std::size_t i = 0; wanted && i < values; ++i)
                result.numbers.push_back(number_at(bytes.data() + i * size, known->type, true));
            return result;
        }
        for (std::size_t i = 0; i < values; ++i) {
            const std::string_view text = next_word();
            if (text.empty()) fail(fmt::format("the file ends after {} of {} numbers", i, values), "export it again");
            if (!wanted) continue;
            const auto value = number(text);
            if (!value) fail(fmt::format("'{}' is not a number", shown(text)));
            result.numbers.push_back(*value);
        }
        return result;
    }

    /// A text is a line; in binary files the two highest bits of its length give the number of its bytes.
    VtkArray strings(std::size_t values, VtkArray result) {
        if (pending_line_) ++line_, pending_line_ = false;
        for (std::size_t i = 0; i < values; ++i) {
            stops_.pass();
            if (at_ >= text_.size()) fail(fmt::format("the file ends after {} of {} texts", i, values));
            if (!is_binary_) {
                result.texts.push_back(decoded(rest_of_line()));
                continue;
            }
            const int bytes = 1 << (3 - (static_cast<unsigned char>(text_[at_]) >> 6));
            std::size_t length = 0;
            for (const char c : next_bytes(static_cast<std::size_t>(bytes)))
                length = length << 8 | static_cast<unsigned char>(c);
            length &= ~std::size_t{0} >> (66 - 8 * bytes);
            result.texts.push_back(decoded(next_bytes(length)));
        }
        return result;
    }

    // Sections.

    void header() {
        const auto first = next_line();
        const double version = first && first->size() > 4 ? number((*first)[4]).value_or(0) : 0;
        if (!first || version < 1) fail("the first line has no version", "it is '# vtk DataFile Version' and a number");
        has_offsets_ = version >= 5;
        if (pending_line_) ++line_, pending_line_ = false;
        rest_of_line(); // the title
        const auto storage = next_line();
        const std::string how = storage ? lower_case(std::string((*storage)[0])) : "";
        if (how != "ascii" && how != "binary") fail(fmt::format("expected ASCII or BINARY, found '{}'", shown(how)));
        is_binary_ = how == "binary";
    }

    /// Sections of points and cells.
    bool section(const std::string& name, const Tokens& line) {
        const auto list = std::ranges::find(legacy_cells, name, &LegacyCells::word);
        if (name == "dataset") {
            const std::string kind = lower_case(std::string(word(line, 1, "the kind of data")));
            static constexpr std::array kinds{"unstructured_grid", "polydata", "structured_grid", "rectilinear_grid",
                                              "structured_points"};
            if (std::ranges::find(kinds, kind) == kinds.end())
                fail(
                    fmt::format("the data are a {}; UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_GRID, RECTILINEAR_GRID and "
                                "STRUCTURED_POINTS are read",
                                shown(line[1])),
                    "convert them, for example in ParaView: Append Datasets, then save");
            kind_ = kind;
            known_dataset_ = true;
        } else if (is_structured() && structured(name, line)) {
            return true;
        } else if (name == "points") {
            const std::size_t points = count(line, 1, "the number of points");
            if (is_structured() && points != along_[0] * along_[1] * along_[2])
                fail(fmt::format("there are {} points, and DIMENSIONS are {} {} {}", points, along_[0], along_[1],
                                 along_[2]));
            mesh_.add_points(array(word(line, 2, "the type of coordinates"), points, 3));
            if (is_structured()) end_grid();
        } else if (name == "cells") {
            cells_ = cell_list(line);
        } else if (name == "cell_types") {
            types_ = array("int", count(line, 1, "the number of cells"), 1);
            close_cells();
        } else if (list != legacy_cells.end()) {
            cells_ = cell_list(line);
            types_ = VtkArray{"", 1, {list->type}, {}, 0};
            close_cells();
        } else if (name == "cell_data" || name == "point_data") {
            of_cells_ = name == "cell_data";
            tuples_ = count(line, 1, "the number of values");
        } else return false;
        return true;
    }

    bool is_structured() const { return kind_.starts_with("structured") || kind_ == "rectilinear_grid"; }

    /// Sections of grids whose points are counted along three axes.
    bool structured(const std::string& name, const Tokens& line) {
        static constexpr std::array axes{"x_coordinates", "y_coordinates", "z_coordinates"};
        const auto axis = std::ranges::find(axes, name);
        if (name == "dimensions") {
            for (std::size_t k = 0; k < 3; ++k) along_[k] = count(line, k + 1, "a number of points");
            mesh_.require_size(line_, along_, text_.size());
        } else if (axis != axes.end()) {
            const auto k = static_cast<std::size_t>(axis - axes.begin());
            const std::size_t points = count(line, 1, "the number of coordinates");
            if (points != along_[k])
                fail(fmt::format("there are {} coordinates, and DIMENSIONS are {} {} {}", points, along_[0], along_[1],
                                 along_[2]));
            on_axis_[k] = array(word(line, 2, "the type of coordinates"), points, 1).numbers;
            if (k == 2) add_box_grid();
        } else if (name == "origin" || name == "spacing" || name == "aspect_ratio") {
            auto& into = name == "origin" ? origin_ : spacing_;
            std::array<double, 3> values{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto value = number(word(line, k + 1, "a number"));
                if (!value) fail(fmt::format("'{}' is not a number", shown(line[k + 1])));
                values[k] = *value;
            }
            into = values;
            if (!origin_ || !spacing_) return true;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < along_[k]; ++i)
                    on_axis_[k].push_back((*origin_)[k] + (*spacing_)[k] * static_cast<double>(i));
            add_box_grid();
        } else return false;
        return true;
    }

    /// The points of three axes.
    void add_box_grid() {
        VtkArray places{"", 3, {}, {}, line_};
        for (const double z : on_axis_[2])
            for (const double y : on_axis_[1])
                for (const double x : on_axis_[0]) places.numbers.insert(places.numbers.end(), {x, y, z});
        mesh_.add_points(places);
        end_grid();
    }
    void end_grid() {
        if (along_done_) fail("the points are given twice");
        mesh_.add_grid(along_);
        along_done_ = true;
    }

    struct Cells {
        VtkArray corners;
        std::vector<double> ends;
    };

    /// Since version 5 the ends and the corners are arrays; before, each cell has its number of corners and the corners.
    Cells cell_list(const Tokens& line) {
        const std::size_t first = count(line, 1, "the number of cells"),
                          second = count(line, 2, "the size of the list");
        if (!has_offsets_) {
            VtkArray all = array("int", second, 1);
            Cells cells{{"", 1, {}, {}, all.line}, {}};
            std::size_t at = 0;
            for (std::size_t cell = 0; cell < first; ++cell) {
                const double corners = at < all.numbers.size() ? all.numbers[at] : -1;
                if (!(corners >= 0) || corners > static_cast<double>(all.numbers.size() - at - 1) ||
                    corners != std::floor(corners))
                    mesh_.fail_at_cell(cell, fmt::format("it has {} corners, and the list ends before", corners));
                const auto begin = all.numbers.begin() + static_cast<std::ptrdiff_t>(++at);
                at += static_cast<std::size_t>(corners);
                cells.corners.numbers.insert(cells.corners.numbers.end(), begin,
                                             begin + static_cast<std::ptrdiff_t>(corners));
                cells.ends.push_back(static_cast<double>(cells.corners.numbers.size()));
            }
            return cells;
        }
        const auto named = [&](std::string_view name, std::size_t values) {
            const auto found = next_line();
            if (!found || lower_case(std::string((*found)[0])) != name)
                fail(fmt::format("expected {}, found '{}'", name, found ? shown((*found)[0]) : ""));
            return array(word(*found, 1, "the type of numbers"), values, 1);
        };
        VtkArray ends = named("offsets", first);
        if (!ends.numbers.empty()) ends.numbers.erase(ends.numbers.begin()); // the first cell begins at 0
        VtkArray corners = named("connectivity", second);
        return {std::move(corners), std::move(ends.numbers)};
    }

    /// Gives the last list of cells to the mesh.
    void close_cells() {
        if (!cells_) return;
        if (!types_) fail("the cells have no CELL_TYPES");
        if (types_->numbers.size() != 1 && types_->numbers.size() != cells_->ends.size())
            fail(fmt::format("there are {} types for {} cells", types_->numbers.size(), cells_->ends.size()));
        constexpr double polyhedron = 42;
        const std::size_t first = mesh_.types.size();
        std::vector<std::pair<std::size_t, std::vector<double>>> faces;
        if (std::ranges::find(types_->numbers, polyhedron) != types_->numbers.end()) faces = take_faces(first);
        mesh_.add_cells(cells_->corners, cells_->ends, types_->numbers);
        for (const auto& [cell, list] : faces) mesh_.add_polyhedron(cell, list);
        cells_.reset();
        types_.reset();
    }

    /// The corners of a polyhedron are its list of faces, after their number.
    std::vector<std::pair<std::size_t, std::vector<double>>> take_faces(std::size_t first) {
        std::vector<std::pair<std::size_t, std::vector<double>>> faces;
        std::vector<double> rest, ends;
        std::size_t at = 0;
        const auto& all = cells_->corners.numbers;
        for (std::size_t k = 0; k < cells_->ends.size(); ++k) {
            const double type = types_->numbers.size() == 1 ? types_->numbers[0] : types_->numbers[k];
            if (!(cells_->ends[k] >= static_cast<double>(at)) || cells_->ends[k] > static_cast<double>(all.size()))
                mesh_.fail_at_cell(first + k, "its corners end before they begin");
            const auto end = static_cast<std::size_t>(cells_->ends[k]);
            const auto from = all.begin() + static_cast<std::ptrdiff_t>(at),
                       to = all.begin() + static_cast<std::ptrdiff_t>(end);
            if (type != 42) rest.insert(rest.end(), from, to);
            else if (from != to) faces.emplace_back(first + k, std::vector<double>(from + 1, to));
            ends.push_back(static_cast<double>(rest.size()));
            at = end;
        }
        cells_->corners.numbers = std::move(rest);
        cells_->ends = std::move(ends);
        return faces;
    }

    /// Data of points, cells and the whole.
    bool data(const std::string& name, const Tokens& line) {
        const auto attribute = std::ranges::find(legacy_data, name, &LegacyData::word);
        if (attribute != legacy_data.end()) {
            scalars_or_others(*attribute, name, line);
        } else if (name == "field") {
            for (std::size_t left = count(line, 2, "the number of arrays"); left > 0;) {
                const auto next = next_line();
                if (!next) fail("the file ends before all arrays of a FIELD are read");
                if (lower_case(std::string((*next)[0])) == "metadata") {
                    skip_metadata();
                    continue;
                }
                const std::size_t components = count(*next, 1, "the number of components"),
                                  tuples = count(*next, 2, "the number of values");
                keep(decoded((*next)[0]), components, tuples, word(*next, 3, "the type of numbers"));
                --left;
            }
        } else if (name == "color_scalars") {
            array(is_binary_ ? "unsigned_char" : "float", tuples_, count(line, 2, "the number of components"), false);
        } else if (name == "lookup_table") {
            array(is_binary_ ? "unsigned_char" : "float", count(line, 2, "the number of colours"), 4, false);
        } else if (name == "metadata") {
            skip_metadata();
        } else return false;
        return true;
    }

    void scalars_or_others(const LegacyData& attribute, const std::string& name, const Tokens& line) {
        std::size_t components = attribute.components;
        std::size_t type = 2;
        if (name == "scalars") {
            components = line.size() > 3 ? count(line, 3, "the number of components") : 1;
            std::size_t at = at_;
            if (lower_case(std::string(text_.substr(at, 12))) == "lookup_table") next_line();
        } else if (name == "texture_coordinates") {
            components = count(line, 2, "the number of components");
            type = 3;
        }
        keep(decoded(word(line, 1, "the name of the data")), components, tuples_,
             word(line, type, "the type of numbers"));
    }

    void skip_metadata() {
        if (pending_line_) ++line_, pending_line_ = false;
        while (at_ < text_.size() && !split(rest_of_line()).empty()) stops_.pass();
    }

    void keep(const std::string& name, std::size_t components, std::size_t tuples, std::string_view type) {
        const bool wanted = VtkMesh::wanted(name) && components == 1;
        VtkArray values = array(type, tuples, components, wanted);
        if (!wanted) return;
        values.name = name;
        if (of_cells_.value_or(false)) mesh_.add_cell_data(std::move(values));
        else if (!of_cells_) mesh_.names[lower_case(name)] = std::move(values.texts);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    bool pending_line_ = false; ///< the line that was read last has ended
    StopPoints stops_;
    VtkMesh mesh_;
    bool is_binary_ = false, has_offsets_ = false, known_dataset_ = false;
    std::string kind_;                   ///< of the data, in lower case
    std::array<std::size_t, 3> along_{}; ///< of a structured grid: points along each axis
    std::array<std::vector<double>, 3> on_axis_;
    std::optional<std::array<double, 3>> origin_, spacing_;
    bool along_done_ = false; ///< the points and cells of that grid are in the mesh
    std::optional<Cells> cells_;
    std::optional<VtkArray> types_;
    std::optional<bool> of_cells_; ///< none before the data of points and cells: those of the whole
    std::size_t tuples_ = 0;       ///< of points or cells
};

} // namespace

VtkMesh read_vtk_legacy(std::string_view bytes, const std::string& file) { return LegacyReader(bytes, file).read(); }

} // namespace kaya
