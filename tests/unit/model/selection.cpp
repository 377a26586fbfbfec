#include "model/kinds/selection.hpp"

#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using kaya::test::hand_made_model;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Selection, AnEmptyTestPassesAllInAscendingOrder) {
    const Model model = hand_made_model();
    EXPECT_THAT(select(model, ObjectKind::block, {}), ElementsAre(0, 1));
    EXPECT_THAT(select(model, ObjectKind::gridpoint, {}), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(select(model, ObjectKind::zone, {}), ElementsAre(0));
    EXPECT_THAT(select(model, ObjectKind::sub_contact, {}), ElementsAre(0, 1));
}

TEST(Selection, HiddenBlocksAndTheirObjectsAreExcluded) {
    Model model = hand_made_model();
    model.blocks.hidden[0] = 1;
    EXPECT_THAT(select(model, ObjectKind::block, {}), ElementsAre(1));
    EXPECT_THAT(select(model, ObjectKind::gridpoint, {}), ElementsAre(4, 5, 6, 7));
    EXPECT_THAT(select(model, ObjectKind::face, {}), ElementsAre(4, 5, 6, 7));
    EXPECT_THAT(select(model, ObjectKind::triangle, {}), ElementsAre(4, 5, 6, 7));
    EXPECT_THAT(select(model, ObjectKind::zone, {}), IsEmpty());
    EXPECT_THAT(select(model, ObjectKind::zone, {}, true), ElementsAre(0));
}

TEST(Selection, AContactNeedsBothOfItsBlocksVisible) {
    for (const Row hidden : {0, 1}) {
        Model model = hand_made_model();
        model.blocks.hidden[hidden] = 1;
        EXPECT_THAT(select(model, ObjectKind::contact, {}), IsEmpty());
        EXPECT_THAT(select(model, ObjectKind::sub_contact, {}), IsEmpty());
        EXPECT_THAT(select(model, ObjectKind::contact, {}, true), ElementsAre(0));
    }
}

TEST(Selection, TheTestReceivesKindAndRowAndNoHiddenRows) {
    Model model = hand_made_model();
    model.blocks.hidden[0] = 1;
    const auto above = [](const Model& m, ObjectKind kind, Row row) {
        EXPECT_EQ(m.blocks.hidden[block_of(m, kind, row)], 0);
        return reference_point(m, kind, row).z() > -0.5;
    };
    EXPECT_THAT(select(model, ObjectKind::gridpoint, above), ElementsAre(4, 5, 6));
}

TEST(Selection, NothingIsPickedFromAnEmptyModel) {
    const Model model;
    for (const auto kind : {ObjectKind::block, ObjectKind::gridpoint, ObjectKind::face, ObjectKind::triangle,
                            ObjectKind::zone, ObjectKind::contact, ObjectKind::sub_contact})
        EXPECT_THAT(select(model, kind, {}), IsEmpty());
}

TEST(Selection, ReferencePoints) {
    const Model model = hand_made_model();
    EXPECT_EQ(reference_point(model, ObjectKind::block, 0), Vec3(0.25, 0.25, 0.25));
    EXPECT_EQ(reference_point(model, ObjectKind::gridpoint, 3), Vec3(0, 0, 1));
    EXPECT_EQ(reference_point(model, ObjectKind::zone, 0), Vec3(0.25, 0.25, 0.25));
    EXPECT_LT((reference_point(model, ObjectKind::face, 0) - Vec3(1, 1, 0) / 3).norm(), 1e-15);
    EXPECT_LT((reference_point(model, ObjectKind::triangle, 0) - Vec3(1, 1, 0) / 3).norm(), 1e-15);
    EXPECT_EQ(reference_point(model, ObjectKind::contact, 0), Vec3(0.375, 0.25, 0));
    EXPECT_EQ(reference_point(model, ObjectKind::sub_contact, 1), Vec3(0.5, 0.25, 0));
}

TEST(Selection, TheBlockOfAContactIsItsFirst) {
    const Model model = hand_made_model();
    EXPECT_EQ(block_of(model, ObjectKind::contact, 0), 1);
    EXPECT_EQ(block_of(model, ObjectKind::sub_contact, 1), 1);
    EXPECT_EQ(block_of(model, ObjectKind::triangle, 5), 1);
    EXPECT_EQ(block_of(model, ObjectKind::gridpoint, 2), 0);
}

TEST(Selection, ModelSizeIsTheDiagonalAndNeverZero) {
    EXPECT_EQ(model_size(Model{}), 1e-30);
    EXPECT_DOUBLE_EQ(model_size(hand_made_model()), std::sqrt(1.0 + 1.0 + 4.0));
    Model model;
    model.gridpoints.resize(1);
    model.gridpoints.position[0] = Vec3(5, 5, 5);
    EXPECT_EQ(model_size(model), 1e-30);
}
