// One step of free rigid blocks, eight at a time; for each the same operations as `advance` in move_blocks.cpp.
#pragma once

#include "mechanics/supports/held_directions.hpp"
#include "mechanics/motion/plain_motion.hpp"
#include "mechanics/lanes/turn.hpp"

namespace kaya {

class PlainBlocks {
public:
    explicit PlainBlocks(Model& model) : model_(model), motion_(model), step_(model.clock.time_step) {}

    /// Combined damping needs earlier moments as well.
    bool possible() const { return !motion_.is_combined() && model_.settings.large_strain; }

    /// Whether blocks [row, row + 8) are rigid, joined to nothing and free, with loads at their centroids only.
    bool are(std::size_t row) const {
        const auto& blocks = model_.blocks;
        bool plain = true;
        for (std::size_t b = row; b < row + eight; ++b) {
            const auto held = blocks.deformable[b] | blocks.body[b] | blocks.fixed[b] |
                              static_cast<int>(roller_of(model_, static_cast<Row>(b)).count);
            plain &= held == 0;
        }
        for (std::size_t i = 0; plain && i < 9; ++i)
            plain = all_zero(load_as<Eight>(blocks.load_arms[row].data() + 8 * i));
        return plain;
    }

    /// Moves blocks [row, row + 8), but not their vertices.
    void move(std::size_t row) {
        auto& blocks = model_.blocks;
        ThreeEights shift = motion_.advance({blocks.velocity[row], blocks.force[row], blocks.load[row],
                                             blocks.mass[row], blocks.inertial_mass[row], blocks.last_force[row]});
        store(blocks.velocity[row].data(), shift);
        for (auto& of : shift) of *= step_;
        add_shift(blocks.displacement[row], shift);
        add_shift(blocks.centroid[row], shift);
        turn_eight(row);
    }

    MotionSums sums() const { return motion_.sums.sums(); }

private:
    using Triples = TripleOf<Eight>;

    static Triples triples(const ThreeEights& rows) {
        const Eight3 c = columns_of(rows);
        return {c.x, c.y, c.z};
    }

    /// Inverse inertia in the axes of the blocks.
    SymmetricInverseOf<Eight> inverse_inertia(std::size_t row) const {
        const auto& blocks = model_.blocks;
        const auto gather = [&](int i, int j) {
            Eight e;
            for (std::size_t l = 0; l < 8; ++l) e[l] = blocks.inertia[row + l](i, j);
            return e;
        };
        const Eight scale = load_as<Eight>(&blocks.inertial_mass[row]) / load_as<Eight>(&blocks.volume[row]);
        return {gather(0, 0), gather(1, 1), gather(2, 2), gather(1, 2), gather(0, 2), gather(0, 1), scale};
    }

    /// Moments act on the angular momentum, and that on the orientation.
    void turn_eight(std::size_t row) {
        auto& blocks = model_.blocks;
        const ThreeEights before = load_three(blocks.angular_momentum[row].data()),
                          inner = load_three(blocks.moment[row].data()), torque = load_three(blocks.torque[row].data()),
                          spin_before = load_three(blocks.rotational_velocity[row].data());
        ThreeEights moment;
        for (std::size_t i = 0; i < 3; ++i) moment[i] = inner[i] + torque[i];
        const ThreeEights after = motion_.advance_momentum(before, moment);
        store(blocks.angular_momentum[row].data(), after);
        const ThreeEights spin = turned(row, triples(after));
        store(blocks.rotational_velocity[row].data(), spin);

        auto& sums = motion_.sums;
        const double kick = motion_.kick();
        for (std::size_t i = 0; i < 3; ++i) {
            sums.add_power(inner[i], spin_before[i], spin[i]);
            const Eight mean = 0.5 * (spin_before[i] + spin[i]);
            sums.boundary += torque[i] * mean * kick;
            sums.damped -= (after[i] - before[i] - moment[i] * kick) * mean;
            sums.kinetic_before += 0.5 * spin_before[i] * before[i];
            sums.kinetic += 0.5 * spin[i] * after[i];
        }
    }

    /// Turns the blocks and returns their spins. A block without momentum keeps its bits.
    ThreeEights turned(std::size_t row, const Triples& momentum) {
        auto& blocks = model_.blocks;
        std::array<Four, 8> rows;
        for (std::size_t l = 0; l < 8; ++l) rows[l] = load_as<Four>(blocks.orientation[row + l].data());
        const std::array<Eight, 4> there = columns_of_rows(rows);
        RotorOf<Eight> orientation{there[0], {there[1], there[2], there[3]}};
        const Triples spin = turn(orientation, inverse_inertia(row), momentum, step_);
        const auto rests = (momentum.x == 0) & (momentum.y == 0) & (momentum.z == 0);
        rows = rows_of_columns({rests ? there[0] : orientation.w, rests ? there[1] : orientation.v.x,
                                rests ? there[2] : orientation.v.y, rests ? there[3] : orientation.v.z});
        for (std::size_t l = 0; l < 8; ++l) store(blocks.orientation[row + l].data(), rows[l]);
        const Eight zero{};
        return three_of({rests ? zero : spin.x, rests ? zero : spin.y, rests ? zero : spin.z});
    }

    Model& model_;
    PlainMotion motion_;
    const double step_;
};

} // namespace kaya
