#include "commands/ranges/ranges.hpp"

#include "base/diagnostic.hpp"
#include "model/edit/build.hpp"

#include <limits>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaya {
namespace {

using lang::RangeElement;
using Kind = RangeElement::Kind;
using testing::ElementsAre;

RangeElement numbers(Kind kind, double low, double high) {
    RangeElement e;
    e.kind = kind;
    e.low = low;
    e.high = high;
    return e;
}

RangeElement named(Kind kind, const std::string& name) {
    RangeElement e;
    e.kind = kind;
    e.name = name;
    return e;
}

lang::RangePhrase both(std::vector<RangeElement> elements) { return {std::move(elements), false, {}}; }
lang::RangePhrase either(std::vector<RangeElement> elements) { return {std::move(elements), true, {}}; }

/// Three unit cubes in a row along x: regions 7, 8, 8; materials 1, 2, 1; the last one is in the group Arch. Two contacts between
/// neighbours, entered by hand.
class RangesTest : public testing::Test {
protected:
    RangesTest() {
        model.group_names.push_back("Arch");
        for (int i = 0; i < 3; ++i) {
            NewBlock options;
            options.region = i == 0 ? 7 : 8;
            options.material = i == 1 ? 2 : 1;
            options.group = i == 2 ? 1 : 0;
            add_block(model, make_brick({i * 1.0, 0, 0}, {i + 1.0, 1, 1}), options);
        }
        model.contacts.resize(2);
        for (Row row = 0; row < 2; ++row) {
            model.contacts.number[row] = row + 1;
            model.contacts.block1[row] = row + 1;
            model.contacts.block2[row] = row;
            model.contacts.material[row] = row + 4;
            model.contacts.joint_set[row] = row;
            model.contacts.position[row] = Vec3(row + 1.0, 0.5, 0.5);
        }
    }

    std::vector<Row> picked(ObjectKind kind, const lang::RangePhrase& phrase) {
        return select(model, kind, range_test(model, ranges, phrase, kind));
    }
    std::vector<Row> blocks(const lang::RangePhrase& phrase) { return picked(ObjectKind::block, phrase); }
    std::vector<Row> contacts(const lang::RangePhrase& phrase) { return picked(ObjectKind::contact, phrase); }

    Model model;
    NamedRanges ranges;
};

TEST_F(RangesTest, AnEmptyPhrasePicksAll) { EXPECT_THAT(blocks({}), ElementsAre(0, 1, 2)); }

TEST_F(RangesTest, LimitsAreInclusiveInAnyOrder) {
    EXPECT_THAT(blocks(both({numbers(Kind::x, 0.5, 1.5)})), ElementsAre(0, 1));
    EXPECT_THAT(blocks(both({numbers(Kind::x, 1.5, 0.5)})), ElementsAre(0, 1));
}

TEST_F(RangesTest, LimitsHaveATolerance) {
    EXPECT_THAT(blocks(both({numbers(Kind::x, 0.5 + 1e-7, 1.5 - 1e-7)})), ElementsAre(0, 1));
    EXPECT_THAT(blocks(both({numbers(Kind::x, 0.5 + 1e-4, 1.5 - 1e-4)})), ElementsAre());
}

TEST_F(RangesTest, OneValueIsAPlane) {
    EXPECT_EQ(picked(ObjectKind::gridpoint, both({numbers(Kind::x, 0, 0)})).size(), 4u);
    EXPECT_EQ(picked(ObjectKind::gridpoint, both({numbers(Kind::x, 1, 1)})).size(), 8u);
}

TEST_F(RangesTest, ElementsAreAndedUnlessUnionIsSaid) {
    const auto left = numbers(Kind::x, 0, 1), eight = numbers(Kind::region, 8, 8);
    EXPECT_THAT(blocks(both({left, eight})), ElementsAre());
    EXPECT_THAT(blocks(either({left, eight})), ElementsAre(0, 1, 2));
}

TEST_F(RangesTest, NotInvertsOneElement) {
    auto eight = numbers(Kind::region, 8, 8);
    eight.negated = true;
    EXPECT_THAT(blocks(both({eight})), ElementsAre(0));
}

TEST_F(RangesTest, BoxSphereCylinderPlane) {
    RangeElement box;
    box.kind = Kind::box;
    box.centre = Vec3(2, 1, 1);
    box.end2 = Vec3(0, 0, 0);
    EXPECT_THAT(blocks(both({box})), ElementsAre(0, 1));

    RangeElement sphere;
    sphere.kind = Kind::sphere;
    sphere.centre = Vec3(0.5, 0.5, 0.5);
    sphere.radius2 = 1;
    EXPECT_THAT(blocks(both({sphere})), ElementsAre(0, 1));
    sphere.radius1 = 0.5;
    EXPECT_THAT(blocks(both({sphere})), ElementsAre(1));

    RangeElement cylinder;
    cylinder.kind = Kind::cylinder;
    cylinder.centre = Vec3(1.5, 0.5, 0);
    cylinder.end2 = Vec3(1.5, 0.5, 1);
    cylinder.radius2 = 0.1;
    EXPECT_THAT(blocks(both({cylinder})), ElementsAre(1));

    RangeElement plane;
    plane.kind = Kind::plane;
    plane.normal = Vec3(2, 0, 0);
    plane.centre = Vec3(1.5, 0, 0);
    plane.side = 1;
    plane.distance = std::numeric_limits<double>::infinity();
    EXPECT_THAT(blocks(both({plane})), ElementsAre(1, 2));
    plane.side = -1;
    EXPECT_THAT(blocks(both({plane})), ElementsAre(0, 1));
    plane.side = 0;
    plane.distance = 0;
    EXPECT_THAT(blocks(both({plane})), ElementsAre(1));
    plane.distance = 1;
    EXPECT_THAT(blocks(both({plane})), ElementsAre(0, 1, 2));
}

TEST_F(RangesTest, ACylinderOfNoLengthIsRefused) {
    RangeElement cylinder;
    cylinder.kind = Kind::cylinder;
    cylinder.radius2 = 1;
    EXPECT_THROW(blocks(both({cylinder})), Diagnostic);
}

TEST_F(RangesTest, GroupsAreFoundInAnyCase) {
    EXPECT_THAT(blocks(both({named(Kind::group, "ARCH")})), ElementsAre(2));
    EXPECT_THAT(contacts(both({named(Kind::group, "arch")})), ElementsAre(1));
}

TEST_F(RangesTest, AMisspeltGroupGetsAGuess) {
    try {
        blocks(both({named(Kind::group, "Ach")}));
        ADD_FAILURE() << "the group was accepted";
    } catch (const Diagnostic& mistake) {
        EXPECT_EQ(mistake.message, "there is no group 'Ach'");
        EXPECT_EQ(mistake.hint, "did you mean 'Arch'?");
    }
}

TEST_F(RangesTest, AContactMatchesWithOneOfItsBlocks) {
    EXPECT_THAT(contacts(both({numbers(Kind::region, 7, 7)})), ElementsAre(0));
    EXPECT_THAT(contacts(both({numbers(Kind::material, 2, 2)})), ElementsAre(0, 1));
}

TEST_F(RangesTest, IntersectionsPickContactsBetweenTwoNumbers) {
    EXPECT_THAT(contacts(both({numbers(Kind::region_intersection, 8, 7)})), ElementsAre(0));
    EXPECT_THAT(contacts(both({numbers(Kind::region_intersection, 8, 8)})), ElementsAre(1));
    EXPECT_THROW(blocks(both({numbers(Kind::region_intersection, 7, 8)})), Diagnostic);
}

TEST_F(RangesTest, NumbersOfBlocksAndContacts) {
    EXPECT_THAT(blocks(both({numbers(Kind::id, 2, 3)})), ElementsAre(1, 2));
    EXPECT_THAT(contacts(both({numbers(Kind::id, 2, 2)})), ElementsAre(1));
    EXPECT_THAT(contacts(both({numbers(Kind::block_id, 1, 1)})), ElementsAre(0));
    EXPECT_THAT(contacts(both({numbers(Kind::joint_material, 5, 5)})), ElementsAre(1));
    EXPECT_THAT(contacts(both({numbers(Kind::joint_set, 1, 1)})), ElementsAre(1));
    EXPECT_THROW(blocks(both({numbers(Kind::joint_material, 1, 1)})), Diagnostic);
    EXPECT_THROW(blocks(both({numbers(Kind::joint_set, 1, 1)})), Diagnostic);
}

TEST_F(RangesTest, NamedRangesMayContainEachOtherButNotThemselves) {
    ranges["left"] = both({numbers(Kind::x, 0, 1)});
    ranges["outer"] = either({named(Kind::named, "LEFT"), numbers(Kind::x, 2, 3)});
    EXPECT_THAT(blocks(both({named(Kind::named, "outer")})), ElementsAre(0, 2));
    ranges["left"] = both({named(Kind::named, "outer")});
    EXPECT_THROW(blocks(both({named(Kind::named, "outer")})), Diagnostic);
    EXPECT_THROW(blocks(both({named(Kind::named, "lefft")})), Diagnostic);
}

TEST_F(RangesTest, HiddenBlocksAreNotPicked) {
    model.blocks.hidden[1] = 1;
    EXPECT_THAT(blocks({}), ElementsAre(0, 2));
    EXPECT_THAT(contacts({}), ElementsAre());
}

} // namespace
} // namespace kaya
