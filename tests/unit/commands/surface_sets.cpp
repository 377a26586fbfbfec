#include "commands/ranges/surface_sets.hpp"

#include "base/diagnostic.hpp"

#include <gtest/gtest.h>

using namespace kaya;

namespace {

SurfaceSets two_networks() {
    SurfaceSets sets;
    sets.surfaces["wall"] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    add_fracture(sets, "a", {{{0.1, 2, 3}, 30, 90, 4}});
    Fracture& polygon = add_fracture(sets, "b", polygon_fracture({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    polygon.dominance = 2;
    polygon.joint_set = 17;
    set_group(polygon, "rank=main road");
    set_group(polygon, "large");
    add_fracture(sets, "a", {{{5, 6, 7}, 80, 270, 1.5}});
    sets.laws["steep"].size = FractureLaw::Size::power_law;
    FractureLaw& measured = sets.laws["measured"];
    measured.orientation = FractureLaw::Orientation::bootstrapped;
    measured.planes.add({30.1, 120});
    measured.planes.add({88, 359.9}, 0.3);
    measured.size = FractureLaw::Size::bootstrapped;
    measured.diameters.add(2.7);
    measured.sizes = {0, 1e12};
    sets.last_law = "steep";
    return sets;
}

} // namespace

TEST(SurfaceSets, FracturesAreSavedWithTheirNumbersAndGroups) {
    const SurfaceSets sets = two_networks(), again = surfaces_from_text(surfaces_text(sets));
    EXPECT_EQ(again.networks, sets.networks);
    EXPECT_EQ(again.next_fracture, 4);
    EXPECT_EQ(again.surfaces, sets.surfaces);
    EXPECT_EQ(again.laws, sets.laws);
    EXPECT_EQ(again.last_law, "steep");
}

/// Earlier saves end with the laws: fractures are numbered in the order of their networks.
TEST(SurfaceSets, EarlierSavesHaveNoNumbers) {
    const SurfaceSets sets = two_networks();
    const std::string text = surfaces_text(sets);
    const std::size_t laws_end = text.find("5 steep\n", text.find("5 steep") + 1) + std::string("5 steep\n").size();
    const SurfaceSets earlier = surfaces_from_text(text.substr(0, laws_end));
    EXPECT_EQ(earlier.networks.at("a")[0].id, 1);
    EXPECT_EQ(earlier.networks.at("a")[1].id, 2);
    EXPECT_EQ(earlier.networks.at("b")[0].id, 3);
    EXPECT_EQ(earlier.next_fracture, 4);
    EXPECT_EQ(earlier.networks.at("b")[0].disc, sets.networks.at("b")[0].disc);
    // Sets without networks have the text that they had.
    SurfaceSets surfaces;
    surfaces.current = "wall";
    EXPECT_EQ(surfaces_text(surfaces), "0\n0\n4 wall\n0\n0 \n");
}

TEST(SurfaceSets, TruncatedTextsAreReadOrRefused) {
    const std::string whole = surfaces_text(two_networks());
    for (std::size_t end = 0; end < whole.size(); ++end) {
        try {
            surfaces_from_text(whole.substr(0, end));
        } catch (const Diagnostic& refused) { EXPECT_NE(refused.message.find("cannot be read"), std::string::npos); }
    }
}

TEST(SurfaceSets, GroupsHaveSlots) {
    Fracture fracture;
    set_group(fracture, "one");
    set_group(fracture, "rank=main");
    set_group(fracture, "two"); // in place of one
    EXPECT_EQ(fracture.groups, (std::vector<std::string>{"rank=main", "two"}));
    EXPECT_TRUE(in_group(fracture, "main"));
    EXPECT_TRUE(in_group(fracture, "rank=main"));
    EXPECT_FALSE(in_group(fracture, "side=main"));
    EXPECT_FALSE(in_group(fracture, "one"));
    set_group(fracture, "side=main", true);
    EXPECT_TRUE(in_group(fracture, "main"));
    set_group(fracture, "main", true);
    EXPECT_EQ(fracture.groups, (std::vector<std::string>{"two"}));
}
