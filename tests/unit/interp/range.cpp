#include "bound.hpp"

namespace kaya::lang {
namespace {

using Kind = RangeElement::Kind;

RangePhrase range(const std::string& text) { return bound_as<Hide>("hide " + text).range; }

RangeElement element(const std::string& text) {
    const RangePhrase phrase = range(text);
    EXPECT_EQ(phrase.elements.size(), 1u) << text;
    return phrase.elements.empty() ? RangeElement{} : phrase.elements.front();
}

TEST(Range, NoPhraseMeansAllVisible) {
    const RangePhrase none = range("");
    EXPECT_TRUE(none.elements.empty());
    EXPECT_FALSE(none.place);
}

TEST(Range, Coordinates) {
    for (const char* text :
         {"range z 0 .1", "range zr 0 0.1", "range z (0,0.1)", "z 0 .1", "ran z 0 .1", "range position-z 0 .1"}) {
        const RangeElement e = element(text);
        EXPECT_EQ(e.kind, Kind::z) << text;
        EXPECT_EQ(e.low, 0);
        EXPECT_EQ(e.high, 0.1);
    }
    const RangeElement plane = element("range x 2.5");
    EXPECT_EQ(plane.kind, Kind::x);
    EXPECT_EQ(plane.low, 2.5);
    EXPECT_EQ(plane.high, 2.5);
}

TEST(Range, ElementsAreJoined) {
    const RangePhrase phrase = range("range x 0 1 y 0 1 not group 'North Wall' union");
    ASSERT_EQ(phrase.elements.size(), 3u);
    EXPECT_FALSE(phrase.elements[0].negated);
    EXPECT_TRUE(phrase.elements[1].negated);
    EXPECT_EQ(phrase.elements[2].name, "North Wall");
    EXPECT_TRUE(phrase.any);
    EXPECT_EQ(phrase.place.column, 6);
    EXPECT_EQ(phrase.elements[1].place.column, 18);
}

TEST(Range, PlaneByDipAndDirection) {
    const RangeElement e = element("range plane dip 30 dd 90 origin 1 2 3 above");
    EXPECT_EQ(e.kind, Kind::plane);
    EXPECT_NEAR(e.normal.x(), 0.5, 1e-15);
    EXPECT_NEAR(e.normal.y(), 0, 1e-15);
    EXPECT_NEAR(e.normal.z(), std::sqrt(0.75), 1e-15);
    EXPECT_EQ(e.centre, Vec3(1, 2, 3));
    EXPECT_EQ(e.side, 1);
    EXPECT_EQ(element("range plane below").normal, Vec3::UnitZ()) << "dip 0, dd 0";
    EXPECT_EQ(element("range plane below").side, -1);
}

TEST(Range, PlaneByNormal) {
    const RangeElement e = element("range plane normal 0 3 4 origin 0 0 1 distance 0.2");
    EXPECT_NEAR((e.normal - Vec3(0, 0.6, 0.8)).norm(), 0, 1e-15);
    EXPECT_EQ(e.side, 0);
    EXPECT_EQ(e.distance, 0.2);
    EXPECT_EQ(mistake("hide range plane normal 0 0 0 above").message, "the normal of the plane is zero");
}

TEST(Range, RoundOnes) {
    const RangeElement ball = element("range sphere c 1 2 3 r 4");
    EXPECT_EQ(ball.kind, Kind::sphere);
    EXPECT_EQ(ball.centre, Vec3(1, 2, 3));
    EXPECT_EQ(ball.radius1, 0);
    EXPECT_EQ(ball.radius2, 4);
    const RangeElement shell = element("range annulus center 0 0 0 radius 3 2");
    EXPECT_EQ(shell.radius1, 2);
    EXPECT_EQ(shell.radius2, 3);
    const RangeElement pipe = element("range cyl end1 0 0 0 end2 0 5 0 rad 1 2");
    EXPECT_EQ(pipe.kind, Kind::cylinder);
    EXPECT_EQ(pipe.end2, Vec3(0, 5, 0));
    EXPECT_EQ(pipe.radius1, 1);
    EXPECT_EQ(pipe.radius2, 2);
}

TEST(Range, BoxIsSorted) {
    const RangeElement box = element("range position 1 0 3 0 2 1");
    EXPECT_EQ(box.kind, Kind::box);
    EXPECT_EQ(box.centre, Vec3(0, 0, 1));
    EXPECT_EQ(box.end2, Vec3(1, 2, 3));
}

TEST(Range, Numbers) {
    EXPECT_EQ(element("range region 3").kind, Kind::region);
    EXPECT_EQ(element("region 3").low, 3);
    EXPECT_EQ(element("range mat 2").kind, Kind::material);
    EXPECT_EQ(element("range cons 2").kind, Kind::constitutive);
    EXPECT_EQ(element("range jmat 2").kind, Kind::joint_material);
    EXPECT_EQ(element("range jset 2").kind, Kind::joint_set);
    EXPECT_EQ(element("range id 2 7").high, 7);
    EXPECT_EQ(element("range bid 4").kind, Kind::block_id);
    EXPECT_EQ(element("range block id 4").kind, Kind::block_id);
    const RangeElement both = element("range mint 1 2");
    EXPECT_EQ(both.kind, Kind::material_intersection);
    EXPECT_EQ(both.low, 1);
    EXPECT_EQ(both.high, 2);
    EXPECT_EQ(element("range rint 1 2").kind, Kind::region_intersection);
}

TEST(Range, SeveralNamesAfterOneWord) {
    const RangePhrase phrase = range("range union nrange A 'B' C x 0 1");
    ASSERT_EQ(phrase.elements.size(), 4u);
    EXPECT_EQ(phrase.elements[0].name, "A");
    EXPECT_EQ(phrase.elements[2].name, "C");
    EXPECT_EQ(phrase.elements[3].kind, Kind::x);
}

TEST(Range, KeywordsOfTheCommandComeFirst) {
    const Change c = bound_as<Change>("change mat 2 region 3");
    EXPECT_EQ(c.material, 2);
    ASSERT_EQ(c.range.elements.size(), 1u);
    EXPECT_EQ(c.range.elements[0].kind, Kind::region);
}

TEST(Range, Mistakes) {
    EXPECT_EQ(mistake("hide range").message, "the range is empty");
    EXPECT_EQ(mistake("hide range union").message, "the range has no element");
    EXPECT_EQ(mistake("hide range z").message, "a number is missing after 'z'");
    EXPECT_EQ(mistake("hide range grup a").hint, "did you mean 'group'?");
    EXPECT_EQ(mistake("hide range block 5").message, "expected the word 'id' of block id, found '5'");
    const Diagnostic after = mistake("bound range z 0 1 xvel 0");
    EXPECT_EQ(after.message, "'xvel' is not a range element");
}

} // namespace
} // namespace kaya::lang
