#include "mechanics/motion/damping.hpp"
#include "mechanics/motion/motion.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

namespace kaya {
namespace {

/// Velocities, forces and previous forces that reverse, are zero or constant, in all combinations.
TEST(Damping, EightComponentsGetTheBitsThatOneGets) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto some = [&] {
        const double x = any(random);
        return x > 0.7 ? 0.0 : x > 0.5 ? 0.1 : x;
    };
    for (const Damping kind : {Damping::local, Damping::combined, Damping::global, Damping::none}) {
        Settings settings;
        settings.damping = kind;
        settings.local_factor = 0.8;
        Clock clock;
        clock.time_step = clock.last_step = 0.1;
        clock.global_viscosity = 2;
        const DampingFactors damping(settings, clock);
        int turned = 0;
        for (int i = 0; i < 2000; ++i) {
            Eight velocity, force, last;
            for (int l = 0; l < eight; ++l) velocity[l] = some(), force[l] = some(), last[l] = some();
            const double step_over_mass = 0.4;
            std::array<double, eight> kept;
            store(kept.data(), last);
            const Eight after = damping.advance(velocity, force, force * step_over_mass, kept.data());
            for (int l = 0; l < eight; ++l) {
                Vec3 one_last = Vec3::Constant(last[l]);
                const Lanes one = damping.advance(lanes(Vec3::Constant(velocity[l])), lanes(Vec3::Constant(force[l])),
                                                  step_over_mass, one_last);
                EXPECT_EQ(std::bit_cast<std::uint64_t>(after[l]), std::bit_cast<std::uint64_t>(one[0]))
                    << velocity[l] << ' ' << force[l] << ' ' << last[l];
                EXPECT_EQ(kept[static_cast<std::size_t>(l)], kind == Damping::combined ? one_last[0] : last[l]);
                turned += after[l] * velocity[l] < 0;
            }
        }
        EXPECT_GT(turned, 500);
    }
}

} // namespace
} // namespace kaya
