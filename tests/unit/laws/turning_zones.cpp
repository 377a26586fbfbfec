// Zone models in steps with a spin.
#include "one_zone.hpp"

#include "laws/zone_trial.hpp"

namespace kaya {

using namespace one_zone;

namespace {

// Also about angles above 180 degrees, and while the rock yields.
TEST(TurningZones, RockThatTurnsWhileItIsStrainedTakesItsPlanesWithIt) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const Zone& fresh : all_zones())
        for (const double speed : {0.01, 0.3}) {
            Zone one = fresh, other = fresh;
            Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
            const Eigen::Vector3d steadily = speed * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
            for (int i = 0; i < 500; ++i) {
                const Eigen::Vector3d more(uniform(random), uniform(random), uniform(random));
                const Eigen::Vector3d spin = steadily + 0.5 * speed * more;
                turn = rotation_of(spin) * turn;
                const Tensor step = random_strain(random, 2e-5);
                one.strain(step);
                other.strain(tensor(turn * matrix(step) * turn.transpose()), spin);
                const Eigen::Matrix3d difference = turn * matrix(one.stress) * turn.transpose() - matrix(other.stress);
                ASSERT_LE(difference.norm(), 1e-8 * (1e5 + one.stress.norm())) << one.model.name << " in step " << i;
            }
        }
}

TEST(TurningZones, ModelsOfTheFirstInterfaceAreTaken) {
    const ZoneModel& model = models().get(std::string(KAYA_TEST_PLUGINS) + "/zones/interface-1.so");
    const std::vector<double> values{2e9, 1e9};
    EXPECT_NO_THROW(try_zone(model, values));
    Zone zone(model.name, moduli), own("elastic", moduli);
    std::mt19937 random(3);
    for (int i = 0; i < 20; ++i) {
        const Tensor step = random_strain(random, 1e-4);
        const Eigen::Vector3d spin(0.01, -0.02, 0.03);
        zone.strain(step, spin);
        own.strain(step, spin);
    }
    EXPECT_EQ(zone.stress, own.stress);
}

} // namespace
} // namespace kaya
