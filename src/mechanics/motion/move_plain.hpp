// One step of gridpoints held by fixities only, eight at a time.
#pragma once

#include "mechanics/motion/plain_motion.hpp"

#include <cstdint>

namespace kaya {

class PlainGridpoints {
public:
    explicit PlainGridpoints(Model& model)
        : model_(model), motion_(model), step_(model.clock.time_step), large_(model.settings.large_strain) {}

    /// Moves rows [row, row + 8).
    [[gnu::always_inline]] void move(std::size_t row) {
        auto& g = model_.gridpoints;
        std::uint64_t fixed;
        std::memcpy(&fixed, &g.fixed[row], sizeof fixed);
        const PlainMotion::Rows rows{g.velocity[row], g.force[row],         g.load[row],
                                     g.mass[row],     g.inertial_mass[row], g.last_force[row]};
        ThreeEights velocity = fixed == 0 ? motion_.advance(rows) : motion_.advance(rows, prescribed(&g.fixed[row]));
        store(g.velocity[row].data(), velocity);
        for (auto& shift : velocity) shift *= step_;
        add_shift(g.displacement[row], velocity);
        if (large_) add_shift(g.position[row], velocity);
    }

    MotionSums sums() const { return motion_.sums.sums(); }

private:
    /// 1 for components whose velocity is given, else 0.
    static ThreeEights prescribed(const std::uint8_t* fixed) {
        std::array<double, 24> held;
        for (std::size_t l = 0; l < 8; ++l)
            for (std::size_t k = 0; k < 3; ++k) held[3 * l + k] = fixed[l] >> k & 1;
        return load_three(held.data());
    }

    Model& model_;
    PlainMotion motion_;
    const double step_;
    const bool large_;
};

} // namespace kaya
