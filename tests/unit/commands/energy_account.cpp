// The energy account compared with the energy of the model.
#include "running.hpp"

#include <cmath>

namespace kaya {
namespace {

class EnergyAccount : public Running {
protected:
    EnergyAccount() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }

    /// Energy of the springs of all sub-contacts, normal and shear stiffness 1e8; of overlaps by their energy.
    double in_springs() {
        const auto& s = model().sub_contacts;
        const auto& contacts = model().contacts;
        double sum = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (!(s.area[i] > 0)) continue;
            const auto c = static_cast<std::size_t>(s.contact[i]);
            const double normal = s.normal_force[i];
            sum += contacts.kind[c] == ContactKind::overlap ? normal * contacts.energy_length[c]
                                                            : 0.5 * normal * normal / (1e8 * s.area[i]);
            sum += 0.5 * s.shear_force[i].squaredNorm() / (1e8 * s.area[i]);
        }
        return sum;
    }
};

TEST_F(EnergyAccount, JointEnergyIsThatOfTheSpringsAfterContactsWereCreatedDeletedAndRotated) {
    run("poly brick -3 3 -3 3 -1 0\nfix\n"
        "poly brick -1.5 -0.5 -0.5 0.5 0.1 1.1\npoly brick -0.4 0.6 -0.4 0.6 0.15 1.15\n"
        "poly brick -1.2 -0.2 -0.3 0.7 1.3 2.3\npoly brick 0.1 1.1 -0.7 0.3 1.4 2.4\n"
        "prop mat 1 dens 2500\ngravity 0 0 -9.81\njmodel model mohr jkn 1e8 jks 1e8 jfric 20\ndamp none\nfraction 0.05\n"
        "cycle time 0.9");
    const Energy& energy = model().energy;
    EXPECT_GT(in_springs(), 0);
    // Shear springs of rolling contacts are accounted with the current area.
    EXPECT_NEAR(energy.joint_stored(), in_springs(), 0.005 * energy.supplied());
    EXPECT_LT(std::abs(energy.error()), 0.01 * energy.supplied());
}

} // namespace
} // namespace kaya
