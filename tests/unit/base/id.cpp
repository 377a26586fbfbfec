#include "base/id.hpp"

#include <gtest/gtest.h>

namespace {

struct Tag {};
using Ids = kaya::IdMap<Tag>;

TEST(IdMap, FindsTheRowOfAnId) {
    Ids ids;
    const auto a = ids.create(10), b = ids.create(11);
    EXPECT_EQ(ids.row(a), 10);
    EXPECT_EQ(ids.row(b), 11);
    EXPECT_NE(a, b);
}

TEST(IdMap, IdFollowsItsRow) {
    Ids ids;
    const auto id = ids.create(7);
    ids.move(id, 3);
    EXPECT_EQ(ids.row(id), 3);
}

TEST(IdMap, DestroyedIdFindsNothing) {
    Ids ids;
    const auto id = ids.create(0);
    ids.destroy(id);
    EXPECT_EQ(ids.row(id), kaya::no_row);
}

TEST(IdMap, ReusedSlotIsAnotherObject) {
    Ids ids;
    const auto old = ids.create(0);
    ids.destroy(old);
    const auto fresh = ids.create(5);
    EXPECT_EQ(fresh.slot, old.slot);
    EXPECT_EQ(ids.row(old), kaya::no_row);
    EXPECT_EQ(ids.row(fresh), 5);
}

TEST(IdMap, DestroyingTwiceDoesNotTouchTheNewOwner) {
    Ids ids;
    const auto old = ids.create(0);
    ids.destroy(old);
    const auto fresh = ids.create(5);
    ids.destroy(old);
    EXPECT_EQ(ids.row(fresh), 5);
}

TEST(IdMap, IdOfNothingAndForeignIdsFindNothing) {
    Ids ids;
    ids.create(0);
    EXPECT_FALSE(kaya::Id<Tag>{});
    EXPECT_EQ(ids.row({}), kaya::no_row);
    EXPECT_EQ(ids.row({99, 1}), kaya::no_row);
}

} // namespace
