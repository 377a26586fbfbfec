// Whether the account of energy agrees with what is there.
#include "running.hpp"

#include <cmath>

namespace kaya {
namespace {

class EnergyAccount : public Running {
protected:
    EnergyAccount() { session().joints.set_path({KAYA_TEST_JOINTS}); }

    /// In the springs of all sub-contacts, normal and shear stiffness 1e8.
    double in_springs() {
        const auto& s = model().sub_contacts;
        double sum = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.area[i] > 0)
                sum += 0.5 * (s.normal_force[i] * s.normal_force[i] + s.shear_force[i].squaredNorm()) / (1e8 * s.area[i]);
        return sum;
    }
};

TEST_F(EnergyAccount, StoredInJointsIsWhatIsInTheSpringsWhenContactsHaveComeGoneAndTurned) {
    run("poly brick -3 3 -3 3 -1 0\nfix\n"
        "poly brick -1.5 -0.5 -0.5 0.5 0.1 1.1\npoly brick -0.4 0.6 -0.4 0.6 0.15 1.15\n"
        "poly brick -1.2 -0.2 -0.3 0.7 1.3 2.3\npoly brick 0.1 1.1 -0.7 0.3 1.4 2.4\n"
        "prop mat 1 dens 2500\ngravity 0 0 -9.81\njmodel model mohr jkn 1e8 jks 1e8 jfric 20\ndamp none\nfraction 0.05\n"
        "cycle time 0.9");
    const Energy& energy = model().energy;
    EXPECT_GT(std::abs(energy.joint_lost), 5 * in_springs()); // so much is lost where touches change
    EXPECT_GT(in_springs(), 0);
    EXPECT_NEAR(energy.joint_stored(), in_springs(), 0.02 * energy.joint_lost);
    EXPECT_LT(std::abs(energy.error()), 0.01 * energy.supplied());
}

} // namespace
} // namespace kaya
