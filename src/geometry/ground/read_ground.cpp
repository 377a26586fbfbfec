// Ground surfaces from files.
#include "geometry/ground/ground.hpp"

#include "base/diagnostic.hpp"
#include "geometry/read/input_text.hpp"
#include "base/lower_case.hpp"
#include "geometry/ground/pit.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/read/text_lines.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace kaya {

namespace {

constexpr std::size_t most_points = 20'000'000;

} // namespace

Ground ground_from_points(std::string_view text, const std::string& file) {
    std::vector<std::vector<Vec3>> lines(1);
    std::size_t points = 0;
    bool grouped = false;
    each_line(text, [&](int line, std::string_view content) {
        const auto words = words_of(content);
        if (words.empty()) {
            grouped = grouped || !lines.back().empty();
            if (!lines.back().empty()) lines.emplace_back();
            return;
        }
        if (words.front().front() == '#' || words.front().front() == '*') return;
        std::array<std::optional<double>, 3> values;
        for (std::size_t k = 0; k < 3 && k < words.size(); ++k) values[k] = number(words[k]);
        const bool right = words.size() >= 3 && values[0] && values[1] && values[2];
        if (!right && points == 0 && std::isalpha(static_cast<unsigned char>(words.front().front())))
            return; // headings
        if (!right)
            throw Diagnostic(fmt::format("{}:{}: a point of a surface is three numbers: x y z", file, line),
                             "lines of words may stand at the top, and lines that begin with #");
        if (++points > most_points)
            throw Diagnostic(fmt::format("{} has more than {} points", file, most_points), "thin it out");
        lines.back().emplace_back(*values[0], *values[1], *values[2]);
    });
    if (points < 3) throw Diagnostic(fmt::format("{} has {} points, and a surface needs three or more", file, points));
    if (!grouped) { // without blank lines they are points
        std::vector<std::vector<Vec3>> single;
        for (const Vec3& point : lines.front()) single.push_back({point});
        lines = std::move(single);
    }
    try {
        return Ground::of_points(lines);
    } catch (Diagnostic& wrong) {
        wrong.message = fmt::format("{}: {}", file, wrong.message);
        throw;
    }
}

// ncols, nrows, xllcorner or xllcenter, yll..., cellsize, NODATA_value; then rows from north to south.
Ground ground_from_grid(std::string_view text, const std::string& file) {
    std::map<std::string, double> header;
    std::vector<double> heights;
    each_line(text, [&](int line, std::string_view content) {
        const auto words = words_of(content);
        if (words.empty()) return;
        if (std::isalpha(static_cast<unsigned char>(words.front().front())) && heights.empty()) {
            const std::string name = lower_case(words.front());
            const auto value = words.size() == 2 ? number(words[1]) : std::nullopt;
            if (!value) throw Diagnostic(fmt::format("{}:{}: '{}' must have one number", file, line, name));
            header[name] = *value;
            return;
        }
        for (const auto word : words) {
            const auto value = number(word);
            if (!value) throw Diagnostic(fmt::format("{}:{}: '{}' is not a height", file, line, word));
            heights.push_back(*value);
        }
    });
    const auto need = [&](const char* name) {
        const auto found = header.find(name);
        if (found == header.end())
            throw Diagnostic(fmt::format("{}: the header has no {}", file, name),
                             "a grid begins with ncols, nrows, xllcorner, yllcorner and cellsize");
        return found->second;
    };
    const double columns = need("ncols"), rows = need("nrows"), size = need("cellsize");
    if (!(columns >= 2 && rows >= 2 && columns * rows <= static_cast<double>(most_points)) || !(size > 0) ||
        columns != std::floor(columns) || rows != std::floor(rows))
        throw Diagnostic(
            fmt::format("{}: {:g} columns, {:g} rows and cells of {:g} make no grid", file, columns, rows, size));
    const auto n = static_cast<std::size_t>(columns), m = static_cast<std::size_t>(rows);
    if (heights.size() != n * m)
        throw Diagnostic(fmt::format("{} has {} heights, and its header says {}", file, heights.size(), n * m));
    // Heights are at the centres of cells.
    const double x0 = header.contains("xllcenter") ? header["xllcenter"] : need("xllcorner") + 0.5 * size;
    const double y0 = header.contains("yllcenter") ? header["yllcenter"] : need("yllcorner") + 0.5 * size;
    const double none = header.contains("nodata_value") ? header["nodata_value"] : -9999;
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t row = 0; row < m; ++row)
        for (std::size_t column = 0; column < n; ++column)
            corners.emplace_back(x0 + size * static_cast<double>(column), y0 + size * static_cast<double>(m - 1 - row),
                                 heights[row * n + column]);
    for (std::size_t row = 0; row + 1 < m; ++row)
        for (std::size_t column = 0; column + 1 < n; ++column) {
            const std::size_t a = row * n + column;
            const std::array<std::size_t, 4> around{a, a + 1, a + n, a + n + 1};
            if (std::ranges::any_of(around, [&](std::size_t i) { return heights[i] == none; })) continue;
            const auto id = [](std::size_t i) { return static_cast<int>(i); };
            triangles.push_back({id(a), id(a + n), id(a + 1)});
            triangles.push_back({id(a + 1), id(a + n), id(a + n + 1)});
        }
    try {
        return {std::move(corners), std::move(triangles)};
    } catch (Diagnostic& wrong) {
        wrong.message = fmt::format("{}: {}", file, wrong.message);
        throw;
    }
}

Ground read_ground(const std::string& path) {
    if (const FileFormat* format = file_format(path); format != nullptr && format->surfaces != nullptr) {
        std::vector<Vec3> corners;
        std::vector<std::array<int, 3>> triangles;
        std::vector<Surface> surfaces;
        for (const FaceSoup& soup : read_soups(path))
            for (Surface& one : separate(welded(soup))) surfaces.push_back(std::move(one));
        for (const Surface& surface : surfaces) {
            const int first = static_cast<int>(corners.size());
            corners.insert(corners.end(), surface.vertices.begin(), surface.vertices.end());
            for (const auto& face : surface.faces)
                for (std::size_t k = 2; k < face.vertices.size(); ++k)
                    triangles.push_back(
                        {first + face.vertices[0], first + face.vertices[k - 1], first + face.vertices[k]});
        }
        return {std::move(corners), std::move(triangles)};
    }
    const std::string text = input_text(path);
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    if (suffix == ".pit") return ground_from_pit(text, path);
    return suffix == ".asc" ? ground_from_grid(text, path) : ground_from_points(text, path);
}

} // namespace kaya
