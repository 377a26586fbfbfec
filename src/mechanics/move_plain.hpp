// One step of gridpoints that nothing holds but fixities: eight at a time, with the account of their energy. What happens to each
// of their components is what advance_velocity (motion.hpp) does.
#pragma once

#include "mechanics/damping.hpp"
#include "mechanics/eight.hpp"
#include "mechanics/phase_sums.hpp"

#include <cstdint>

namespace kaya {

class PlainGridpoints {
public:
    explicit PlainGridpoints(Model& model)
        : model_(model), damping_(model.settings, model.clock), gravity_(for_each_row(model.settings.gravity)),
          step_(model.clock.time_step), kick_(model.clock.kick()), large_(model.settings.large_strain) {}

    /// Combined damping keeps more of each gridpoint.
    bool possible() const { return damping_.combined == 0; }

    /// Moves rows [row, row + 8).
    [[gnu::always_inline]] void move(std::size_t row) {
        auto& g = model_.gridpoints;
        const ThreeEights before = load_three(g.velocity[row].data()), inner = load_three(g.force[row].data()),
                          load = load_three(g.load[row].data());
        const Eight inertial = load_as<Eight>(&g.inertial_mass[row]);
        const ThreeEights mass = for_each_of_three(inertial),
                          weight_mass = for_each_of_three(load_as<Eight>(&g.mass[row])),
                          step_over_mass = for_each_of_three(kick_ / inertial);
        std::uint64_t fixed;
        std::memcpy(&fixed, &g.fixed[row], sizeof fixed);
        const ThreeEights held = fixed == 0 ? ThreeEights{} : prescribed(&g.fixed[row]);
        ThreeEights after;
        for (std::size_t i = 0; i < 3; ++i) {
            const Eight weight = weight_mass[i] * gravity_[i], whole = inner[i] + load[i] + weight;
            after[i] = damping_.advance(before[i], whole * step_over_mass[i]);
            if (fixed != 0) after[i] = held[i] != 0 ? before[i] : after[i];
            add_power(inner[i], before[i], after[i]);
            const Eight mean = 0.5 * (before[i] + after[i]);
            gravity_work_ += weight * mean * kick_;
            const Eight rest = (mass[i] * (after[i] - before[i]) - whole * kick_) * mean;
            boundary_ += load[i] * mean * kick_ + held[i] * rest;
            damped_ -= (1 - held[i]) * rest;
            kinetic_before_ += 0.5 * mass[i] * before[i] * before[i];
            kinetic_ += 0.5 * mass[i] * after[i] * after[i];
        }
        store(g.velocity[row].data(), after);
        place(row, after);
    }

    MotionSums sums() const {
        return {sum(kinetic_before_), sum(kinetic_), sum(gravity_work_), sum(boundary_),
                sum(damped_),         sum(power_),   sum(power_size_),   sum(power_gain_)};
    }

private:
    /// 1 for components whose velocity is given, else 0.
    static ThreeEights prescribed(const std::uint8_t* fixed) {
        std::array<double, 24> held;
        for (std::size_t l = 0; l < 8; ++l)
            for (std::size_t k = 0; k < 3; ++k) held[3 * l + k] = fixed[l] >> k & 1;
        return load_three(held.data());
    }

    void add_power(const Eight& force, const Eight& before, const Eight& after) {
        const Eight power = force * before;
        power_ += power;
        power_size_ += size_of(power);
        power_gain_ += force * (after - before);
    }

    void place(std::size_t row, const ThreeEights& velocity) {
        auto& g = model_.gridpoints;
        ThreeEights displacement = load_three(g.displacement[row].data()),
                    position = load_three(g.position[row].data());
        for (std::size_t i = 0; i < 3; ++i) {
            const Eight shift = velocity[i] * step_;
            displacement[i] += shift;
            position[i] += shift;
        }
        store(g.displacement[row].data(), displacement);
        if (large_) store(g.position[row].data(), position);
    }

    Model& model_;
    const DampingFactors damping_;
    const ThreeEights gravity_;
    const double step_, kick_;
    const bool large_;
    Eight kinetic_before_{}, kinetic_{}, gravity_work_{}, boundary_{}, damped_{}, power_{}, power_size_{},
        power_gain_{};
};

} // namespace kaya
