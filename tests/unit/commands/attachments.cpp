// Sub-contacts keep valid references to their gridpoints when the blocks around them change.
#include "running.hpp"

namespace kaya {
namespace {

class Attachments : public Running {
protected:
    /// Three bricks on a long one, and a distant one created first.
    void make() {
        session().engine.joints.set_path({KAYA_TEST_JOINTS});
        run("poly brick 50 51 0 1 0 1 region 9\n"
            "poly brick 0 3 0 1 -1 0\n"
            "poly brick 0 1 0 1 0 1\n"
            "poly brick 1 2 0 1 0 1\n"
            "poly brick 2 3 0 1 0 1\n"
            "prop jmat 1 jkn 1e9 jks 1e9\n"
            "change jmat 1\n");
        ASSERT_GT(model().sub_contacts.size(), 0u);
    }

    /// The number of attached sides; checks that all of them refer to nearby gridpoints of their own block.
    std::size_t attached() {
        std::size_t count = 0;
        const auto& points = model().sub_contacts;
        for (std::size_t s = 0; s < points.size(); ++s) {
            const Row contact = points.contact[s];
            const std::pair<const Attachment*, Row> sides[] = {{&points.side1[s], model().contacts.block1[contact]},
                                                               {&points.side2[s], model().contacts.block2[contact]}};
            for (const auto& [side, block] : sides) {
                if (!side->attached()) continue;
                ++count;
                Vec3 place = Vec3::Zero();
                for (std::size_t k = 0; k < 3; ++k) {
                    if (side->weights[k] == 0) continue;
                    EXPECT_EQ(model().gridpoints.block[side->gridpoints[k]], block);
                    place += side->weights[k] * model().gridpoints.position[side->gridpoints[k]];
                }
                EXPECT_LT((place - points.position[s]).norm(), 1e-9);
            }
        }
        return count;
    }
};

TEST_F(Attachments, FollowTheRowsWhenABlockIsDeleted) {
    make();
    run("delete region 9\n");
    EXPECT_EQ(attached(), 2 * model().sub_contacts.size());
}

TEST_F(Attachments, FacesOfContactsFollowToo) {
    make();
    run("delete region 9\n");
    for (std::size_t c = 0; c < model().contacts.size(); ++c) {
        ASSERT_NE(model().contacts.face1[c], no_row);
        EXPECT_EQ(model().faces.block[model().contacts.face1[c]], model().contacts.block1[c]);
        EXPECT_EQ(model().faces.block[model().contacts.face2[c]], model().contacts.block2[c]);
    }
}

TEST_F(Attachments, OfABlockWithANewShapeAreDeletedUntilItsContactsAreSearched) {
    make();
    const std::size_t before = attached();
    run("gen edge 0.5 range x 0 1 z 0 1\n");
    EXPECT_LT(attached(), before);
    EXPECT_GT(attached(), 0u);
    run("change jmat 1\n");
    EXPECT_EQ(attached(), 2 * model().sub_contacts.size());
}

} // namespace
} // namespace kaya
