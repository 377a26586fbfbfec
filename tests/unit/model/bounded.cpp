#include "model/edit/bounded.hpp"

#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace kaya;
using kaya::test::hand_made_model;
using ::testing::HasSubstr;

namespace {

constexpr double nan_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

struct Wrong {
    const char* sentence;
    std::function<void(Model&)> change;
};

const Wrong wrong_numbers[] = {
    {"the velocity of block 2 is (1e+308, 0, -1e+308); numbers beyond 1e+30",
     [](Model& m) { m.blocks.velocity[1] = Vec3(1e308, 0, -1e308); }},
    {"the centroid of block 1 is (0, nan, 0)", [](Model& m) { m.blocks.centroid[0] = Vec3(0, nan_number, 0); }},
    {"the position of a gridpoint of block 2 is (-inf, 0, 0)",
     [](Model& m) { m.gridpoints.position[5] = Vec3(-infinite, 0, 0); }},
    {"the displacement of a gridpoint of block 1 is (0, 0, 2e+30)",
     [](Model& m) { m.gridpoints.displacement[3] = Vec3(0, 0, 2e30); }},
    {"the mass of block 1 is -1", [](Model& m) { m.blocks.mass[0] = -1; }},
    {"the inertial mass of a gridpoint of block 1 is nan",
     [](Model& m) { m.gridpoints.inertial_mass[0] = nan_number; }},
    {"the volume of a zone of block 1 is -0.5", [](Model& m) { m.zones.volume[0] = -0.5; }},
    {"the normal of contact 1 is (nan, 0, 0)", [](Model& m) { m.contacts.normal[0] = Vec3(nan_number, 0, 0); }},
    {"the time is inf", [](Model& m) { m.clock.time = infinite; }},
    {"the time step is -0", [](Model& m) { m.clock.time_step = -0.0; }},
    {"the time step is nan", [](Model& m) { m.clock.time_step = nan_number; }},
    {"the last time step is -1", [](Model& m) { m.clock.last_step = -1; }},
    {"the given time step is inf", [](Model& m) { m.settings.given_time_step = infinite; }},
    {"gravity is (0, 0, nan)", [](Model& m) { m.settings.gravity = Vec3(0, 0, nan_number); }},
};

} // namespace

TEST(Bounded, AnUnboundedModelHasNoProblem) {
    Model model = hand_made_model();
    EXPECT_EQ(unbounded_number(model), "");
}

TEST(Bounded, NumbersUpToTheLimitAreRight) {
    Model model = hand_made_model();
    model.gridpoints.position[0] = Vec3(largest_coordinate, -largest_coordinate, 0);
    EXPECT_EQ(unbounded_number(model), "");
}

TEST(Bounded, TheFirstWrongNumberIsNamedWithItsObject) {
    for (const auto& [sentence, change] : wrong_numbers) {
        Model model = hand_made_model();
        change(model);
        EXPECT_THAT(unbounded_number(model), HasSubstr(sentence));
        try {
            require_bounded(model);
            ADD_FAILURE() << sentence;
        } catch (const Diagnostic& error) {
            EXPECT_EQ(error.fault, Fault::run);
            EXPECT_FALSE(error.hint.empty());
        }
    }
}
