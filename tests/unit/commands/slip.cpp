// Residual shear from loading in joints, and the effect of sliding on a model.
#include "commands/stability/slip.hpp"

#include "running.hpp"

#include <algorithm>

namespace kaya {
namespace {

class Slips : public Running {
protected:
    Slips() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }

    /// A block on another, with normal and shear stress everywhere.
    void build() {
        run("poly brick 0 4 0 4 -1 0\npoly brick 0 4 0 4 0 2\nfix range z -1 0\nprop mat 1 density 2500\n"
            "gravity 2 0 -10\njmodel model mohr jkn 1e9 jks 1e9 jfric 45\ndamp local\nsolve");
        rows_ = static_cast<Row>(model().sub_contacts.size());
        ASSERT_GE(rows_, 4);
    }

    /// Lets some sub-contacts slip by a millimetre, a hundred times their shear stress over stiffness.
    void slip(Row first, Row end) {
        auto& subs = model().sub_contacts;
        for (Row i = first; i < end; ++i) subs.frictional_work[i] += 1e-3 * subs.shear_force[i].norm();
    }

    Row rows_ = 0;
};

TEST_F(Slips, OnlyJointsThatSlippedAreListed) {
    build();
    const Slip before(model());
    EXPECT_FALSE(before.has_turned_shear(model()));
    slip(0, rows_ / 2);
    EXPECT_TRUE(before.has_turned_shear(model()));
    EXPECT_EQ(static_cast<Row>(before.rows(model()).size()), rows_ / 2);
}

TEST_F(Slips, ForgettingSlipKeepsTheStressesOfBendingCells) {
    run("poly brick 0 4 0 1 0 1\ngen quad ndiv 4 1 1\nprop mat 1 density 2500 young 1e8 prat 0.25\nbound xvel 0 yvel 0 zvel 0 range x -0.1 0.1\n"
        "gravity 0 0 -10\ndamp local\ncycle 1");
    const Model start = model();
    run("solve");
    const auto bent = model().zones.warp;
    const auto carries = [](double value) { return value != 0; };
    ASSERT_TRUE(std::ranges::any_of(bent, [&](const auto& column) { return std::ranges::any_of(column, carries); }));
    forget_slip(model(), start, session().engine.joints);
    for (std::size_t k = 0; k < bent.size(); ++k) EXPECT_TRUE(std::ranges::equal(model().zones.warp[k], bent[k])) << k;
}

} // namespace
} // namespace kaya
