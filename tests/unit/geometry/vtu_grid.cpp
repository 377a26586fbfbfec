// The blocks of a .vtu file as the format requires; tests/unit/vtk reads them with VTK, if installed.
#include "geometry/grid/vtu_grid.hpp"

#include "base/deflate.hpp"
#include "base/pattern.hpp"

#include <gtest/gtest.h>

#include <cstring>

using namespace kaya;

namespace {

/// The bytes of the array NAME, from its blocks at its offset.
std::string array_in(const std::string& file, const std::string& name) {
    const auto found = Pattern(" Name=\"" + name + "\"[^>]* offset=\"([0-9]+)\"").all(file, 1);
    if (found.empty()) throw std::runtime_error("no array " + name);
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const char* at = file.data() + file.find(mark) + mark.size() + std::stoul(found.front());
    const auto number = [&at] {
        std::uint32_t value = 0;
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
        return value;
    };
    const std::uint32_t count = number(), full = number(), rest = number();
    std::vector<std::uint32_t> sizes(count);
    for (auto& size : sizes) size = number();
    std::string bytes;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t length = k + 1 == count && rest > 0 ? rest : full;
        const auto part = inflated({at, sizes[k]}, length);
        EXPECT_TRUE(part.has_value());
        at += sizes[k];
        bytes += part.value_or("");
    }
    return bytes;
}

template <class Number> std::vector<Number> numbers_in(const std::string& file, const std::string& name) {
    const std::string bytes = array_in(file, name);
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

} // namespace

TEST(VtuGrid, BlocksHoldArraysOfAnyLength) {
    constexpr std::size_t full = (1U << 18) / sizeof(double);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, full - 1, full, full + 1, 3 * full, 3 * full + 5}) {
        std::vector<double> values(count);
        for (std::size_t k = 0; k < count; ++k) values[k] = 1.0 / (1.0 + static_cast<double>(k));
        VtuGrid grid;
        grid.whole_data.push_back(vtu_array<double>("before", values));
        grid.whole_data.push_back(vtu_array<double>("values", values, {.unit = "length"}));
        EXPECT_EQ(numbers_in<double>(grid.bytes(), "values"), values) << count;
    }
}

TEST(VtuGrid, CellsStandWithTheirFaces) {
    VtuGrid grid;
    for (int k = 0; k < 4; ++k) grid.points.emplace_back(k, 0.5, -k);
    grid.add_cell(VtuCell::line, std::array{3, 1});
    grid.add_polyhedron(std::vector<std::vector<Row>>{{2, 1, 0}, {0, 1, 3}, {2, 0, 3}, {1, 2, 3}});
    grid.add_cell(VtuCell::vertex, std::array{2});
    const std::string file = grid.bytes();
    using Wholes = std::vector<std::int64_t>;
    EXPECT_EQ(numbers_in<std::int64_t>(file, "connectivity"), (Wholes{3, 1, 2, 1, 0, 3, 2}));
    EXPECT_EQ(numbers_in<std::int64_t>(file, "offsets"), (Wholes{2, 6, 7}));
    EXPECT_EQ(numbers_in<std::uint8_t>(file, "types"), (std::vector<std::uint8_t>{3, 42, 1}));
    EXPECT_EQ(numbers_in<std::int64_t>(file, "faces"), (Wholes{4, 3, 2, 1, 0, 3, 0, 1, 3, 3, 2, 0, 3, 3, 1, 2, 3}));
    EXPECT_EQ(numbers_in<std::int64_t>(file, "faceoffsets"), (Wholes{-1, 17, -1}));
    EXPECT_EQ(numbers_in<double>(file, "Points")[11], -3);
    EXPECT_NE(file.find("<Piece NumberOfPoints=\"4\" NumberOfCells=\"3\">"), std::string::npos);
}

TEST(VtuGrid, TextsEndWithAZero) {
    VtuGrid grid;
    grid.lists["names"] = {"", "a b", ""};
    EXPECT_EQ(array_in(grid.bytes(), "names"), std::string("\0a b\0\0", 6));
    EXPECT_NE(grid.bytes().find("NumberOfTuples=\"3\""), std::string::npos);
}
