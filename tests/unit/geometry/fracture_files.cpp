// Fractures written to files, and read from those of a fracture modeller.
#include "base/diagnostic.hpp"
#include "geometry/polyhedra/random.hpp"
#include "geometry/read/write_fractures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

std::vector<Fracture> random_fractures(bool polygons, double far) {
    Random random(41);
    std::vector<Fracture> fractures;
    for (int k = 0; k < 40; ++k) {
        const Vec3 place = far * Vec3(1, -0.3, 0.01) + 10 * Vec3(random.uniform(), random.uniform(), random.uniform());
        fractures.push_back({{place, 90 * random.uniform(), 360 * random.uniform(), 0.1 + 5 * random.uniform()}});
        if (polygons) fractures.back() = polygon_fracture(outline_of(fractures.back(), 3 + k % 9));
        fractures.back().id = k + 1;
    }
    return fractures;
}

constexpr const char* two_fractures =
    "BEGIN FORMAT\r\n Format = Ascii\r\n Length_Unit = M\r\n XAxis = East\r\n Scale = 100.0\r\n No_Fractures = 2\r\n"
    "No_TessFractures = 0\r\nNo_Nodes = 7\r\nNo_Properties = 1\r\nEND FORMAT\r\n\r\n"
    "BEGIN PROPERTIES\r\nProp1 = (Real*4) \"Aperture\"\r\nEND PROPERTIES\r\n\r\n"
    "BEGIN SETS\r\nSet1 = \"bedding planes\"\r\nSet2 = \"\"\r\nEND SETS\r\n\r\n"
    "BEGIN FRACTURE\r\n"
    "1 4 1 0.001\r\n1 0 0 5\r\n2 2 0 5\r\n3 2 2 5\r\n4 0 2 5\r\n0 0 0 1\r\n"
    "2 3 2 0.002\r\n 1 1.0 0 0\r\n 2 1.0 4 0\r\n 3 1.0 0 3\r\n 0 1 0 0\r\n"
    "END FRACTURE\r\n\r\nBEGIN TESSFRACTURE\r\nEND TESSFRACTURE\r\n\r\nBEGIN ROCKBLOCK\r\nEND ROCKBLOCK\r\n";

std::string changed(const std::string& from, const std::string& to) {
    std::string text = two_fractures;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
    try {
        read_fracman(text, "f");
    } catch (const Diagnostic& refused) { return refused.message; }
    return "read";
}

} // namespace

TEST(FractureFiles, DiscsAndPolygonsComeBackWithAllBits) {
    for (const double far : {0.0, 1e6})
        for (const bool polygons : {false, true}) {
            const auto fractures = random_fractures(polygons, far);
            const FractureFormat format = polygons ? FractureFormat::polygons : FractureFormat::discs;
            const auto again = read_fractures(fractures_text(fractures, format, 12), "f", format);
            ASSERT_EQ(again.size(), fractures.size());
            for (std::size_t i = 0; i < again.size(); ++i) {
                EXPECT_EQ(again[i].disc, fractures[i].disc);
                EXPECT_EQ(again[i].corners, fractures[i].corners);
            }
        }
    EXPECT_THROW(fractures_text(random_fractures(true, 0), FractureFormat::discs, 12), Diagnostic);
}

TEST(FractureFiles, DiscsBecomePolygonsOfTheirArea) {
    const auto discs = random_fractures(false, 100);
    for (const FractureFormat format : {FractureFormat::polygons, FractureFormat::fracman}) {
        const auto again = read_fractures(fractures_text(discs, format, 16), "f", format);
        ASSERT_EQ(again.size(), discs.size());
        for (std::size_t i = 0; i < again.size(); ++i) {
            EXPECT_EQ(again[i].corners.size(), 16u);
            EXPECT_NEAR(area_of(again[i]), area_of(discs[i]), 1e-12 * area_of(discs[i]));
            EXPECT_LT((again[i].disc.centre - discs[i].disc.centre).norm(), 1e-12);
            EXPECT_LT((normal_of(again[i].disc) - normal_of(discs[i].disc)).norm(), 1e-12);
        }
    }
}

TEST(FractureFiles, SetsOfAFractureModellerAreGroups) {
    const auto fractures = read_fracman(two_fractures, "f");
    ASSERT_EQ(fractures.size(), 2u);
    EXPECT_EQ(fractures[0].groups, std::vector<std::string>{"set=bedding planes"});
    EXPECT_EQ(fractures[1].groups, std::vector<std::string>{"set=2"});
    EXPECT_DOUBLE_EQ(area_of(fractures[0]), 4);
    EXPECT_DOUBLE_EQ(area_of(fractures[1]), 6);
    EXPECT_EQ(fractures[1].disc.dip, 90);
    const auto again = read_fracman(fractures_text(fractures, FractureFormat::fracman, 12), "f");
    ASSERT_EQ(again.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again[i].corners, fractures[i].corners);
        EXPECT_EQ(again[i].groups, fractures[i].groups);
    }
}

/// Six digits at 500 m leave a polygon of 10 m off its plane by 1e-4 of its size.
TEST(FractureFiles, RoundedCornersAreStillPlane) {
    auto fractures = random_fractures(true, 500);
    for (Fracture& fracture : fractures) {
        const double area = area_of(fracture);
        std::string text = "BEGIN FRACTURE\n";
        text += fmt::format("1 {} 1\n", fracture.corners.size());
        double largest = 0;
        for (const Vec3& c : fracture.corners) {
            text += fmt::format("1 {:.3f} {:.3f} {:.3f}\n", c.x(), c.y(), c.z());
            largest = std::max(largest, (c - fracture.disc.centre).norm());
        }
        text += "0 0 0 1\nEND FRACTURE\n";
        if (largest < 2) continue; // coarser than a thousandth
        const auto again = read_fracman(text, "f");
        EXPECT_NEAR(area_of(again[0]), area, 2e-3 * area);
        EXPECT_LT((again[0].disc.centre - fracture.disc.centre).norm(), 1e-3);
    }
}

TEST(FractureFiles, WrongFilesAreLocated) {
    EXPECT_EQ(refusal(two_fractures), "read");
    EXPECT_EQ(refusal(""), "f has no fractures");
    EXPECT_EQ(refusal("x y z\n"), "f, line 1: this line stands outside of all sections");
    EXPECT_EQ(refusal(changed("Ascii", "Binary")), "f, line 2: the format Binary is not read");
    EXPECT_EQ(refusal(changed("East", "North")), "f, line 4: the x axis points North, not East");
    EXPECT_EQ(refusal(changed("No_Fractures = 2", "No_Fractures = 3")), "f announces 3 fractures and has 2");
    EXPECT_EQ(refusal(changed("No_Fractures = 2", "No_Fractures = two")), "f, line 6: 'two' is not a number");
    EXPECT_EQ(refusal(changed("No_Fractures = 2", "No_Fractures 2")), "f, line 6: an '=' is missing");
    EXPECT_EQ(refusal(changed("1 4 1 0.001", "1 2 1")), "f, line 22: a fracture has from 3 to 10000 corners, not 2");
    EXPECT_EQ(refusal(changed("1 4 1 0.001", "1 3.5 1")),
              "f, line 22: a fracture has from 3 to 10000 corners, not 3.5");
    EXPECT_EQ(refusal(changed("1 4 1 0.001", "1 4")),
              "f, line 22: a fracture has a number, a number of corners and a set");
    EXPECT_EQ(refusal(changed("1 4 1 0.001", "1 3 1")),
              "f, line 26: the last line of a fracture, 0 and the normal, is missing");
    EXPECT_EQ(refusal(changed("2 2 0 5", "2 2 x 5")), "f, line 24: 'x' is not a number");
    EXPECT_EQ(refusal(changed("2 2 0 5", "2 2 0")), "f, line 24: 3 words where a corner has a number and x, y, z");
    EXPECT_EQ(refusal(changed("3 2 2 5", "3 2 2 6")),
              "f, the fracture that begins in line 22: the corners of the polygon do not lie in one plane");
    EXPECT_EQ(refusal(changed("3 2 2 5", "3 0.1 0.1 5")),
              "f, the fracture that begins in line 22: the polygon is not convex");
    EXPECT_EQ(refusal(changed("BEGIN TESSFRACTURE\r\n", "BEGIN TESSFRACTURE\r\n1 3 1 1\r\n")),
              "f, line 36: the section tessfracture is not read");
    EXPECT_EQ(refusal(changed("END SETS\r\n", "")), "f, line 20: a section begins in the section sets");
    EXPECT_EQ(refusal(changed("END SETS", "END FORMAT")),
              "f, line 19: the end of 'format' is not that of a section that is open");
    EXPECT_EQ(refusal(changed(" 0 1 0 0\r\nEND FRACTURE", "END FRACTURE")),
              "f, line 32: the fracture that begins in line 28 is not complete");
    EXPECT_EQ(refusal(changed("END ROCKBLOCK\r\n", "")), "f, line 38: the section rockblock does not end");
}

TEST(FractureFiles, TruncatedFilesAreReadOrRefused) {
    const std::string whole = two_fractures;
    std::size_t read = 0;
    for (std::size_t end = 0; end < whole.size(); ++end) {
        const std::string message = refusal(whole.substr(0, end));
        read += message == "read";
        EXPECT_TRUE(message == "read" || message.starts_with("f")) << message;
    }
    EXPECT_LT(read, 80u); // behind the last fracture only
}
