#include "geometry/read/vtk_mesh.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace kaya {
namespace {

struct TypeName {
    int type;
    std::string_view name;
};
constexpr std::array type_names{
    TypeName{5, "triangle"}, TypeName{6, "strip of triangles"}, TypeName{7, "polygon"},
    TypeName{8, "pixel"},    TypeName{9, "quadrilateral"},      TypeName{10, "tetrahedron"},
    TypeName{11, "voxel"},   TypeName{12, "hexahedron"},        TypeName{13, "wedge"},
    TypeName{14, "pyramid"}, TypeName{42, "polyhedron"},
};

/// How an array labels cells.
enum class Role { group, material, region, physical, block, part };

struct LabelName {
    std::string_view name; ///< in lower case
    Role role;
};
/// Several names of one role in the order in which they count. The first role that a file has names the groups; `part` names none.
constexpr std::array label_names{
    LabelName{"group", Role::group},           LabelName{"block_group", Role::group}, // of `vtk write`
    LabelName{"material", Role::material},     LabelName{"block_material", Role::material},
    LabelName{"materialids", Role::material},  LabelName{"region", Role::region},
    LabelName{"block_region", Role::region},   LabelName{"gmsh:physical", Role::physical},
    LabelName{"block", Role::block},           LabelName{"block_id", Role::part},
    LabelName{"gmsh:geometrical", Role::part}, LabelName{"cellentityids", Role::part},
};
constexpr std::string_view list_ending = "_names";

/// Values above 0 mark cells that belong to another piece or are hidden.
bool marks_left_out(std::string_view lower_name) {
    return lower_name == "vtkghosttype" || lower_name == "vtkghostlevels";
}

bool is_whole(double number) { return number == std::floor(number) && std::abs(number) < 1e15; }

int positive(double number) {
    return number >= 1 && number <= std::numeric_limits<int>::max() ? static_cast<int>(number) : 0;
}

} // namespace

std::span<const int> VtkMesh::corners(std::size_t cell) const {
    const std::size_t first = cell == 0 ? 0 : ends_[cell - 1];
    return {corners_.data() + first, ends_[cell] - first};
}

std::string VtkMesh::type_of(std::size_t cell) const {
    const auto known = std::ranges::find(type_names, types[cell], &TypeName::type);
    return known == type_names.end() ? fmt::format("cell of type {}", types[cell]) : std::string(known->name);
}

void VtkMesh::fail(int line, const std::string& message, const std::string& hint) const {
    throw Diagnostic(
        line > 0 ? fmt::format("{}, line {}: {}", file, line, message) : fmt::format("{}: {}", file, message), hint);
}

void VtkMesh::fail_at_cell(std::size_t cell, const std::string& message, const std::string& hint) const {
    throw Diagnostic(fmt::format("{}, cell {}: {}", file, cell, message), hint);
}

void VtkMesh::add_points(const VtkArray& coordinates) {
    first_point_ = points.size();
    const auto& numbers = coordinates.numbers;
    if (points.size() + numbers.size() / 3 >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
        fail(coordinates.line, "there are more points than a model can hold");
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
        points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
        if (!points.back().allFinite())
            fail(coordinates.line, fmt::format("point {} has a coordinate that is not a finite number", k / 3));
    }
}

int VtkMesh::corner(std::size_t cell, double number) const {
    const std::size_t count = points.size() - first_point_;
    if (!(number >= 0) || number >= static_cast<double>(count) || number != std::floor(number))
        fail_at_cell(cell, fmt::format("it has point {}, and there are {} points, counted from 0", number, count));
    return static_cast<int>(first_point_ + static_cast<std::size_t>(number));
}

void VtkMesh::add_cells(const VtkArray& corners, std::span<const double> ends, std::span<const double> cell_types) {
    std::size_t used = 0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const std::size_t cell = types.size();
        if (!(ends[k] >= static_cast<double>(used)) || ends[k] > static_cast<double>(corners.numbers.size()) ||
            ends[k] != std::floor(ends[k]))
            fail_at_cell(cell, fmt::format("its corners end at {}, and those before at {} of {}", ends[k], used,
                                           corners.numbers.size()));
        for (const auto end = static_cast<std::size_t>(ends[k]); used < end; ++used)
            corners_.push_back(corner(cell, corners.numbers[used]));
        ends_.push_back(corners_.size());
        const double type = cell_types.size() == 1 ? cell_types[0] : cell_types[k];
        if (!(type >= 0 && type <= 255) || type != std::floor(type))
            fail_at_cell(cell, fmt::format("{} is not a type of cells", type));
        types.push_back(static_cast<int>(type));
    }
}

void VtkMesh::require_size(int line, const std::array<std::size_t, 3>& along, std::size_t bytes) const {
    const double points = static_cast<double>(along[0]) * static_cast<double>(along[1]) * static_cast<double>(along[2]);
    constexpr double always = 1e6, of_a_byte = 8;
    if (points > always + of_a_byte * static_cast<double>(bytes))
        fail(line,
             fmt::format("{} times {} times {} points are more than the file can hold", along[0], along[1], along[2]));
}

void VtkMesh::add_grid(const std::array<std::size_t, 3>& along) {
    // Steps to the corners of a cell, around its base and then around its top, along the axes that have cells.
    constexpr std::array<std::array<std::size_t, 3>, 8> around{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    constexpr std::array<double, 4> types_of{1, 3, 9, 12}; // vertex, line, quadrilateral, hexahedron
    const std::array<std::size_t, 3> stride{1, along[0], along[0] * along[1]};
    std::vector<std::size_t> axes;
    std::array<std::size_t, 3> cells{1, 1, 1};
    for (std::size_t k = 0; k < 3; ++k) {
        if (along[k] == 0) return;
        if (along[k] == 1) continue;
        axes.push_back(k);
        cells[k] = along[k] - 1;
    }
    const std::size_t corners_of_cell = std::size_t{1} << axes.size();
    VtkArray corners;
    std::vector<double> ends;
    for (std::size_t k = 0; k < cells[2]; ++k)
        for (std::size_t j = 0; j < cells[1]; ++j)
            for (std::size_t i = 0; i < cells[0]; ++i) {
                const std::size_t first = i * stride[0] + j * stride[1] + k * stride[2];
                for (std::size_t c = 0; c < corners_of_cell; ++c) {
                    std::size_t corner = first;
                    for (std::size_t axis = 0; axis < axes.size(); ++axis)
                        corner += around[c][axis] * stride[axes[axis]];
                    corners.numbers.push_back(static_cast<double>(corner));
                }
                ends.push_back(static_cast<double>(corners.numbers.size()));
            }
    add_cells(corners, ends, std::span(&types_of[axes.size()], 1));
}

void VtkMesh::append(const VtkMesh& other) {
    const auto first = static_cast<int>(points.size());
    const std::size_t first_cell = types.size(), first_corner = corners_.size();
    if (points.size() + other.points.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
        fail(0, "there are more points than a model can hold");
    first_point_ = points.size();
    points.insert(points.end(), other.points.begin(), other.points.end());
    types.insert(types.end(), other.types.begin(), other.types.end());
    for (const int corner : other.corners_) corners_.push_back(first + corner);
    for (const std::size_t end : other.ends_) ends_.push_back(first_corner + end);
    for (const auto& [cell, loops] : other.faces) {
        auto& moved = faces[first_cell + cell] = loops;
        for (auto& loop : moved)
            for (int& corner : loop) corner += first;
    }
    for (const VtkArray& array : other.cell_data) add_cell_data(array);
    names.insert(other.names.begin(), other.names.end());
}

void VtkMesh::add_polyhedron(std::size_t cell, std::span<const double> list) {
    auto& loops = faces[cell];
    for (std::size_t at = 0; at < list.size();) {
        const double count = list[at++];
        if (!(count >= 3) || count > static_cast<double>(list.size() - at) || count != std::floor(count))
            fail_at_cell(cell, fmt::format("its face {} has {} corners", loops.size(), count));
        std::vector<int> loop;
        for (const std::size_t end = at + static_cast<std::size_t>(count); at < end; ++at)
            loop.push_back(corner(cell, list[at]));
        loops.push_back(std::move(loop));
    }
}

bool VtkMesh::wanted(std::string_view name) {
    const std::string lower = lower_case(std::string(name));
    const std::string_view stem = lower.ends_with(list_ending)
                                      ? std::string_view(lower).substr(0, lower.size() - list_ending.size())
                                      : std::string_view(lower);
    return marks_left_out(lower) || std::ranges::find(label_names, stem, &LabelName::name) != label_names.end();
}

void VtkMesh::add_cell_data(VtkArray array) {
    if (array.components != 1) return; // not a label
    array.name = lower_case(array.name);
    if (marks_left_out(array.name)) {
        if (array.numbers.size() > types.size())
            fail(array.line,
                 fmt::format("'{}' has {} values for {} cells", array.name, array.numbers.size(), types.size()));
        const std::size_t first = types.size() - array.numbers.size();
        for (std::size_t k = 0; k < array.numbers.size(); ++k)
            if (array.numbers[k] > 0) types[first + k] = 0;
        return;
    }
    const auto known = std::ranges::find(cell_data, array.name, &VtkArray::name);
    if (known == cell_data.end()) {
        cell_data.push_back(std::move(array));
        return;
    }
    known->numbers.insert(known->numbers.end(), array.numbers.begin(), array.numbers.end());
    known->texts.insert(known->texts.end(), array.texts.begin(), array.texts.end());
}

std::vector<VtkLabel> VtkMesh::labels() const {
    std::vector<VtkLabel> labels(types.size());
    bool named = false;
    std::array<bool, 6> seen{};
    for (const LabelName& label : label_names) {
        const auto array = std::ranges::find(cell_data, label.name, &VtkArray::name);
        if (array == cell_data.end() || !std::ranges::all_of(array->numbers, is_whole)) continue;
        const bool is_text = !array->texts.empty();
        const std::size_t count = is_text ? array->texts.size() : array->numbers.size();
        if (count != types.size() || (is_text && !array->numbers.empty()))
            fail(array->line, fmt::format("'{}' has {} values for {} cells", array->name, count, types.size()));
        if (std::exchange(seen[static_cast<std::size_t>(label.role)], true)) continue;
        const auto list = names.find(array->name + std::string(list_ending));
        const bool names_groups = !named && label.role != Role::part;
        named = named || names_groups;
        const double least = label.role == Role::region || label.role == Role::physical ? 1 : 0; // region 0: none
        const auto kind = label.role == Role::physical ? std::string_view("physical") : label.name;
        for (std::size_t cell = 0; cell < labels.size(); ++cell) {
            VtkLabel& result = labels[cell];
            const double number = is_text ? 0 : array->numbers[cell];
            std::string text;
            if (is_text) text = array->texts[cell];
            else if (list == names.end()) text = number >= least ? fmt::format("{}-{}", kind, number) : "";
            else if (number >= 0 && number < static_cast<double>(list->second.size()))
                text = list->second[static_cast<std::size_t>(number)];
            if (label.role == Role::region || label.role == Role::physical) result.region = positive(number);
            if (label.role == Role::material || label.role == Role::physical) result.material = positive(number);
            if (label.role == Role::block || label.role == Role::part)
                result.part += fmt::format("{}/", is_text ? text : fmt::format("{}", number));
            if (names_groups) result.group = std::move(text);
        }
    }
    return labels;
}

VtkMesh read_vtk_mesh(std::string_view bytes, const std::string& file) {
    if (bytes.starts_with("# vtk")) return read_vtk_legacy(bytes, file);
    if (bytes.substr(0, 1000).find('<') != bytes.npos) return read_vtk_xml(bytes, file);
    throw Diagnostic(fmt::format("{} is not a file of VTK: it begins with neither '# vtk DataFile' nor XML", file),
                     "save the mesh as .vtk, .vtu or .vtp again");
}

} // namespace kaya
