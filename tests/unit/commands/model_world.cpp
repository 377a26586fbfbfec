#include "tests/unit/commands/running.hpp"

#include "lang/script/values/field_index.hpp"

#include <gmock/gmock.h>

namespace kaya {
namespace {

using script::Handle;
using testing::ElementsAre;

constexpr auto block_table = script_table(ObjectKind::block);
constexpr auto gridpoint_table = script_table(ObjectKind::gridpoint);
constexpr auto zone_table = script_table(ObjectKind::zone);
constexpr auto contact_table = script_table(ObjectKind::contact);

class ModelWorldTest : public Running {
protected:
    ModelWorldTest() { run("poly brick 0 1\npoly brick 2 4\n"); }
    ModelWorld& world() { return session().engine.world; }

    std::size_t field(std::int32_t table, std::string_view name) {
        const auto& all = world().tables()[static_cast<std::size_t>(table)].fields;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].name == name) return i;
        ADD_FAILURE() << "no field " << name;
        return 0;
    }
    using Form = script::RelationInfo::Form;
    Handle next(Handle object) {
        return world().relate(
            static_cast<std::size_t>(script::find_relation(world(), Form::next, object.table, object.table)), object,
            {});
    }
    Handle first_of(Handle object, std::int32_t table) {
        return world().relate(script::list_of_parts(world(), object.table, table), object, {});
    }
    Handle nearest(std::int32_t table, const Vec3& place) {
        return world().relate(static_cast<std::size_t>(script::find_relation(world(), Form::nearest, -1, table)), {},
                              place);
    }
    double number(Handle object, std::string_view name) {
        return std::get<double>(world().get(object, field(object.table, name)));
    }
};

TEST_F(ModelWorldTest, TablesAreNamedInTheOrderOfTheirNumbers) {
    std::vector<std::string_view> names;
    for (const auto& table : world().tables()) names.push_back(table.name);
    EXPECT_THAT(names, ElementsAre("block", "gridpoint", "zone", "face", "contact", "sub_contact", "corner",
                                   "cable_node", "structure_node", "beam_element", "liner_element"));
    for (const auto& table : world().tables()) EXPECT_FALSE(table.fields.empty()) << table.name;
}

TEST_F(ModelWorldTest, NextWalksThroughAllBlocks) {
    const Handle first = world().at(block_table, 0), second = next(first);
    EXPECT_EQ(second, world().at(block_table, 1));
    EXPECT_EQ(next(second).generation, 0u);
    EXPECT_EQ(world().at(block_table, 2).generation, 0u);
}

TEST_F(ModelWorldTest, GridpointsAreWalkedThroughBlockByBlock) {
    int count = 0;
    for (Handle p = first_of(world().at(block_table, 1), gridpoint_table); p.generation != 0; p = next(p)) ++count;
    EXPECT_EQ(count, 8);
}

TEST_F(ModelWorldTest, ARigidBlockHasNoZonesAndAContactTableNoBlocks) {
    EXPECT_EQ(first_of(world().at(block_table, 0), zone_table).generation, 0u);
    EXPECT_THROW(first_of(world().at(block_table, 0), contact_table), Diagnostic);
}

TEST_F(ModelWorldTest, AHandleOfADeletedBlockSaysSo) {
    const Handle gone = world().at(block_table, 0), stays = world().at(block_table, 1);
    run("delete range x 0 1\n");
    EXPECT_FALSE(world().alive(gone));
    EXPECT_TRUE(world().alive(stays));
    EXPECT_DOUBLE_EQ(number(stays, "volume"), 8);
    try {
        number(gone, "volume");
        ADD_FAILURE() << "a deleted block was read";
    } catch (const Diagnostic& problem) { EXPECT_EQ(problem.message, "this block no longer exists"); }
}

TEST_F(ModelWorldTest, AHandleOfAGridpointDiesWhenRowsMove) {
    const Handle point = world().at(gridpoint_table, 3);
    EXPECT_TRUE(world().alive(point));
    run("poly brick 5 6\n");
    EXPECT_TRUE(world().alive(point)) << "a new block moves no old row";
    run("gen edge 1 range x 0 1\n");
    EXPECT_FALSE(world().alive(point));
}

TEST_F(ModelWorldTest, NullIsNotDead) {
    EXPECT_THROW(world().get(Handle{block_table, 0, 0}, 0), Diagnostic);
    EXPECT_FALSE(world().alive(Handle{block_table, 0, 0}));
}

TEST_F(ModelWorldTest, NearestLooksAtTheReferencePoint) {
    EXPECT_EQ(nearest(block_table, Vec3(0.9, 0.5, 0.5)), world().at(block_table, 0));
    EXPECT_EQ(nearest(block_table, Vec3(99, 0, 0)), world().at(block_table, 1));
    EXPECT_EQ(nearest(zone_table, Vec3::Zero()).generation, 0u);
}

TEST_F(ModelWorldTest, ReductionsNeedNoScriptLoop) {
    const std::size_t volume = field(block_table, "volume");
    EXPECT_DOUBLE_EQ(world().reduce(block_table, volume, "sum"), 9);
    EXPECT_DOUBLE_EQ(world().reduce(block_table, volume, "mean"), 4.5);
    EXPECT_DOUBLE_EQ(world().reduce(block_table, volume, "minimum"), 1);
    EXPECT_DOUBLE_EQ(world().reduce(block_table, volume, "maximum"), 8);
    EXPECT_THROW(world().reduce(block_table, volume, "product"), Diagnostic);
    EXPECT_THROW(world().reduce(zone_table, 0, "mean"), Diagnostic);
}

TEST_F(ModelWorldTest, ReadOnlyFieldsAreNotWritten) {
    EXPECT_THROW(world().set(world().at(block_table, 0), field(block_table, "volume"), 5.0), Diagnostic);
    EXPECT_DOUBLE_EQ(number(world().at(block_table, 0), "volume"), 1);
}

} // namespace
} // namespace kaya
