#include "model/kinds/kinds.hpp"

#include "model/fields/field.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace kaya;
using kaya::test::hand_made_model;

TEST(Kinds, RowsStandInTheOrderOfTheirNumbers) {
    std::set<std::int32_t> histories;
    std::size_t k = 0;
    for (const KindInfo& info : kinds()) {
        EXPECT_EQ(static_cast<std::size_t>(info.kind), k++);
        EXPECT_EQ(&info_of(info.kind), &info);
        if (info.history >= 0) {
            EXPECT_TRUE(histories.insert(info.history).second) << info.name;
            EXPECT_EQ(recorded_kind(info.history), info.kind);
        }
    }
    EXPECT_EQ(k, static_cast<std::size_t>(ObjectKind::none));
    EXPECT_EQ(recorded_kind(-1), ObjectKind::none);
    EXPECT_EQ(recorded_kind(10), ObjectKind::none);
    // Numbers in existing save files.
    EXPECT_EQ(info_of(ObjectKind::gridpoint).history, 1);
    EXPECT_EQ(info_of(ObjectKind::cable_node).history, 6);
    EXPECT_EQ(static_cast<int>(ObjectKind::cable_node), 7);
}

TEST(Kinds, ObjectsOfScriptsCanBeFoundAgain) {
    const Model model = hand_made_model();
    for (const KindInfo& info : kinds()) {
        if (info.kind >= end_of_script_kinds) continue;
        EXPECT_NE(info.in_block == nullptr, info.identity == nullptr) << info.name;
        EXPECT_EQ(info.identity == nullptr, info.find == nullptr) << info.name;
        for (Row row = 0; row < static_cast<Row>(info.count(model)); ++row) {
            const Row block = info.block(model, row);
            if (info.in_block != nullptr) {
                const Span span = info.in_block(model, block);
                EXPECT_TRUE(row >= span.first && row < span.end()) << info.name << ' ' << row;
            } else {
                EXPECT_EQ(info.find(model, info.identity(model, row)), row) << info.name;
            }
        }
    }
}

TEST(Kinds, TheNumberIsTheFieldId) {
    const Model model = hand_made_model();
    for (const KindInfo& info : kinds()) {
        const Field* id = find_field(info.kind, "id");
        if (id == nullptr) continue;
        ASSERT_NE(info.number, nullptr) << info.name;
        for (Row row = 0; row < static_cast<Row>(info.count(model)); ++row)
            EXPECT_EQ(std::get<std::int64_t>(id->get(model, row)), info.number(model, row)) << info.name;
    }
}

TEST(Relations, ListsNameTheirOwners) {
    const Model model = hand_made_model();
    std::set<std::string_view> names;
    for (const Relation& relation : relations()) {
        EXPECT_EQ((relation.list != nullptr) + (relation.numbered != nullptr) + (relation.one != nullptr), 1);
        for (const auto& name : {relation.first.classic, relation.first.modern, relation.next.classic,
                                 relation.next.modern, relation.array}) {
            if (!name.empty()) { EXPECT_TRUE(names.insert(name).second) << name; }
        }
        const auto targets = static_cast<Row>(count_of(model, relation.to));
        for (Row row = 0; row < static_cast<Row>(count_of(model, relation.from)); ++row) {
            if (relation.list != nullptr) {
                const Span span = relation.list(model, row);
                EXPECT_LE(span.end(), targets);
                for (Row part = span.first; relation.owner != nullptr && part < span.end(); ++part)
                    EXPECT_EQ(relation.owner(model, part), row);
            } else if (relation.numbered != nullptr) {
                for (const Row part : relation.numbered(model, row)) EXPECT_TRUE(part >= 0 && part < targets);
            } else {
                EXPECT_LT(relation.one(model, row), targets);
            }
        }
    }
}
