#include "mechanics/contact/pair_motions.hpp"

#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/lanes/turn.hpp"
#include "mechanics/shape/rigid_pair.hpp"

#include <algorithm>
#include <array>

namespace kaya {

namespace {

using Triples = TripleOf<Eight>;
using Rows = std::array<Row, 8>;

Four row_of(const Vec3& v) {
#if defined(__AVX512VL__)
    return _mm256_maskz_loadu_pd(7, v.data());
#else
    return Four{v.x(), v.y(), v.z(), 0};
#endif
}

Triples gather(const Column<Vec3>& column, const Rows& rows) {
    std::array<Four, 8> vectors;
    for (std::size_t l = 0; l < 8; ++l) vectors[l] = row_of(column[rows[l]]);
    const std::array<Eight, 4> c = columns_of_rows(vectors);
    return {c[0], c[1], c[2]};
}

void scatter(Column<Vec3>& column, std::span<const Row> rows, const std::array<char, 8>& wanted, const Triples& t) {
    const std::array<Four, 8> vectors = rows_of_columns({t.x, t.y, t.z, Eight{}});
    for (std::size_t l = 0; l < rows.size(); ++l)
        if (wanted[l]) column[rows[l]] = Vec3(vectors[l][0], vectors[l][1], vectors[l][2]);
}

Eight3 columns(const Triples& t) { return {t.x, t.y, t.z}; }

/// Motion of rigid blocks in a step. Velocities and arms are those of the middle of the step: with the arms of either end a turning block
/// would close its joints by half the square of the angle in each step.
struct RigidMotions {
    Triples velocity, spin, centroid;

    RigidMotions(const Model& model, const Rows& blocks)
        : velocity(gather(model.blocks.velocity, blocks)), spin(gather(model.blocks.rotational_velocity, blocks)),
          centroid(gather(model.blocks.centroid, blocks)) {
        if (model.settings.large_strain)
            centroid = centroid - 0.5 * model.clock.time_step * velocity; // they have moved already
    }
    Triples at(const Triples& place) const { return velocity + spin.cross(place - centroid); }
};

} // namespace

void PairMotions::take(Model& model, std::span<const Row> rows) {
    auto& contacts = model.contacts;
    Rows block1, block2, row;
    std::array<char, 8> wanted{};
    Eight first{}; // weight of block 1 in the rotation of the plane
    for (std::size_t l = 0; l < 8; ++l) {
        const Row c = row[l] = rows[std::min(l, rows.size() - 1)];
        block1[l] = contacts.block1[c];
        block2[l] = contacts.block2[c];
        wanted[l] = is_rigid_joint(model, c);
        first[static_cast<int>(l)] = contacts.reference[c] == 0 ? 0.5 : part_of_first(model, block1[l], block2[l]);
    }
    const RigidMotions one(model, block1), two(model, block2);
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    const double half = large ? 0.5 : 0;
    const Triples o = gather(contacts.position, row), before = gather(contacts.normal, row);
    const Triples middle = o + 0.5 * half * step * (two.at(o) + one.at(o)); // of the way of the origin
    const Triples velocity1 = one.at(middle), velocity2 = two.at(middle);
    const Triples shift = 0.5 * step * (velocity2 + velocity1), turn = 0.5 * step * (two.spin + one.spin);
    Triples n = before;
    if (large) {
        const Triples spin = first * one.spin + (1 - first) * two.spin;
        n = turned_a_little(before, step * spin);
        scatter(contacts.normal, rows, wanted, n);
        scatter(contacts.position, rows, wanted, o + shift); // the origin of moments goes with the mean of the blocks
    }
    origin = columns(o);
    normal = columns(n);
    normal_middle = columns(0.5 * (n + before));
    apart = columns(step * (velocity2 - velocity1));
    apart_turn = columns(step * (two.spin - one.spin));
    mean = columns(shift);
    mean_turn = columns(turn);
    twist = turn.dot(n);
}

} // namespace kaya
