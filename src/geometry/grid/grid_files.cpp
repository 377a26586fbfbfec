// Files of blocks with faces or zones, by their suffixes.
#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "geometry/grid/grid3d.hpp"
#include "geometry/read/input_text.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace kaya {
namespace {

struct GridFormat {
    std::string_view suffix;
    Grid3d (*read)(std::string_view, const std::string&);
};
constexpr std::array grid_formats{GridFormat{".3dgrid", read_grid3d}, GridFormat{".f3grid", read_f3grid},
                                  GridFormat{".msh", read_msh}, GridFormat{".tess", read_tess}};

const GridFormat* grid_format_of(const std::string& path) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    const auto found = std::ranges::find(grid_formats, suffix, &GridFormat::suffix);
    return found == grid_formats.end() ? nullptr : &*found;
}

} // namespace

bool is_grid_file(const std::string& path) { return grid_format_of(path) != nullptr; }

std::string grid_suffixes() {
    std::vector<std::string_view> suffixes;
    for (const GridFormat& format : grid_formats) suffixes.push_back(format.suffix);
    return fmt::format("{}", fmt::join(suffixes, ", "));
}

Grid3d read_grid3d_file(const std::string& path) { return grid_format_of(path)->read(input_text(path), path); }

} // namespace kaya
