// Grids of any size and content, read back by VTK: every number with its bits, every text with its bytes.
#include "geometry/grid/vtu_grid.hpp"

#include "tests/unit/vtk/read_back.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <random>

using namespace kaya;
using namespace kaya::test;

namespace {

/// The uncompressed bytes of one block of the file: arrays below, at and above it are tested.
constexpr std::size_t block = 1U << 18;

template <class Number>
void expect_bits(vtkFieldData* data, const std::string& name, const std::vector<Number>& given) {
    vtkDataArray* array = data->GetArray(name.c_str());
    ASSERT_NE(array, nullptr) << name;
    ASSERT_EQ(static_cast<std::size_t>(array->GetNumberOfValues()), given.size()) << name;
    ASSERT_EQ(static_cast<std::size_t>(array->GetDataTypeSize()), sizeof(Number)) << name;
    if (given.empty()) return;
    EXPECT_EQ(std::memcmp(array->GetVoidPointer(0), given.data(), given.size() * sizeof(Number)), 0) << name;
}

struct Draw {
    std::mt19937_64 engine;
    explicit Draw(unsigned seed) : engine(seed) {}

    std::size_t below(std::size_t n) { return engine() % n; }
    /// Any bits: NaNs, infinities and denormals too; half of them small numbers that compress.
    double real() { return engine() % 2 ? std::bit_cast<double>(engine()) : static_cast<double>(below(100)); }
    template <class Number> std::vector<Number> numbers(std::size_t count) {
        std::vector<Number> values(count);
        for (Number& value : values) {
            if constexpr (std::is_same_v<Number, double>) value = real();
            else value = static_cast<Number>(engine() >> below(64));
        }
        return values;
    }
    std::vector<std::string> texts(std::size_t count) {
        std::vector<std::string> result(count);
        for (auto& text : result)
            for (std::size_t n = below(20); n > 0; --n) text += static_cast<char>(1 + below(255));
        return result;
    }
};

/// As many tuples of `components` doubles as fill one block; one fewer, one more; zero.
std::size_t tuples_of(int trial, Draw& draw) {
    const std::array<std::size_t, 6> sizes{0, 1, block / 8 - 1, block / 8, block / 8 + 1, 2 * block / 8};
    return trial < 6 ? sizes[static_cast<std::size_t>(trial)] : draw.below(3000);
}

} // namespace

TEST(RandomGrids, EveryNumberAndTextComesBack) {
    for (int trial = 0; trial < 24; ++trial) {
        SCOPED_TRACE(trial);
        Draw draw(static_cast<unsigned>(trial));
        VtuGrid grid;
        const std::size_t points = tuples_of(trial, draw);
        for (std::size_t k = 0; k < points; ++k) grid.points.emplace_back(draw.real(), draw.real(), draw.real());
        const auto reals = draw.numbers<double>(points);
        const auto wholes = draw.numbers<std::int64_t>(2 * points);
        const auto places = draw.numbers<std::int32_t>(points);
        const auto whole = draw.numbers<std::uint8_t>(draw.below(3) * block + draw.below(3));
        grid.point_data.push_back(vtu_array<double>("reals & \"<more>\"", reals, {.unit = "force/length & <\">"}));
        grid.point_data.push_back(vtu_array<std::int64_t>("wholes", wholes, {.components = 2}));
        grid.point_data.push_back(vtu_array<std::int32_t>("places", places));
        grid.whole_data.push_back(vtu_array<std::uint8_t>("whole", whole));
        grid.lists["texts"] = draw.texts(trial % 7 == 0 ? 40000 : draw.below(5));

        const auto read = parsed(grid.bytes());
        ASSERT_EQ(static_cast<std::size_t>(read->GetNumberOfPoints()), points);
        for (std::size_t k = 0; k < points; ++k) {
            std::array<double, 3> place{};
            read->GetPoint(static_cast<vtkIdType>(k), place.data());
            ASSERT_EQ(std::memcmp(place.data(), grid.points[k].data(), sizeof place), 0) << k;
        }
        expect_bits(read->GetPointData(), "reals & \"<more>\"", reals);
        expect_bits(read->GetPointData(), "wholes", wholes);
        expect_bits(read->GetPointData(), "places", places);
        expect_bits(read->GetFieldData(), "whole", whole);
        EXPECT_EQ(unit_of(read->GetPointData()->GetArray(0)), "force/length & <\">");
        EXPECT_EQ(unit_of(read->GetPointData()->GetArray(1)), "");
        EXPECT_EQ(names_in(read->GetFieldData(), "texts"), grid.lists["texts"]);
        EXPECT_EQ(read->GetPointData()->GetArray("wholes")->GetNumberOfComponents(), 2);
    }
}

TEST(RandomGrids, EveryCellComesBackInAnyOrderOfShapes) {
    const std::array<std::pair<VtuCell, std::size_t>, 5> shapes{{{VtuCell::vertex, 1},
                                                                 {VtuCell::line, 2},
                                                                 {VtuCell::triangle, 3},
                                                                 {VtuCell::tetrahedron, 4},
                                                                 {VtuCell::polygon, 0}}};
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        Draw draw(seed);
        VtuGrid grid;
        const std::size_t points = 4 + draw.below(40);
        for (std::size_t k = 0; k < points; ++k) grid.points.emplace_back(k, 0, 0);
        const auto some = [&](std::size_t count) {
            std::vector<Row> all(points);
            for (std::size_t k = 0; k < points; ++k) all[k] = static_cast<Row>(k);
            std::ranges::shuffle(all, draw.engine);
            all.resize(count);
            return all;
        };
        std::vector<std::pair<VtuCell, std::vector<std::vector<Row>>>> cells; // a polyhedron has its faces
        for (std::size_t n = draw.below(30); n > 0; --n) {
            if (draw.below(3) == 0) {
                std::vector<std::vector<Row>> faces;
                for (std::size_t k = 4 + draw.below(4); k > 0; --k) faces.push_back(some(3 + draw.below(2)));
                grid.add_polyhedron(faces);
                cells.emplace_back(VtuCell::polyhedron, faces);
            } else {
                const auto [shape, corners] = shapes[draw.below(shapes.size())];
                cells.emplace_back(shape,
                                   std::vector<std::vector<Row>>{some(corners > 0 ? corners : 3 + draw.below(2))});
                grid.add_cell(shape, cells.back().second.front());
            }
        }
        const auto read = parsed(grid.bytes());
        ASSERT_EQ(static_cast<std::size_t>(read->GetNumberOfCells()), cells.size());
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const auto& [shape, faces] = cells[k];
            vtkCell* cell = read->GetCell(static_cast<vtkIdType>(k));
            ASSERT_EQ(cell->GetCellType(), static_cast<int>(shape)) << k;
            const bool solid = shape == VtuCell::polyhedron;
            ASSERT_TRUE(!solid || static_cast<std::size_t>(cell->GetNumberOfFaces()) == faces.size()) << k;
            for (std::size_t f = 0; f < faces.size(); ++f) {
                vtkIdList* corners = solid ? cell->GetFace(static_cast<int>(f))->GetPointIds() : cell->GetPointIds();
                std::vector<Row> numbers;
                for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
                    numbers.push_back(static_cast<Row>(corners->GetId(i)));
                ASSERT_EQ(numbers, faces[f]) << k;
            }
        }
    }
}
