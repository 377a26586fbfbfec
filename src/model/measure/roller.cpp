#include "model/measure/roller.hpp"

namespace kaya {

Vec3 roller_change(const Roller& roller, const Vec3& value, std::uint8_t fixed, const Vec3& speed) {
    // Gram and Schmidt: the part of each direction orthogonal to the earlier ones.
    constexpr double parallel = 1e-6;
    std::array<Vec3, 3> basis;
    std::array<double, 3> part{};
    int found = 0;
    Vec3 change = Vec3::Zero();
    for (std::int32_t k = 0; k < roller.count; ++k) {
        Vec3 direction = roller.direction[static_cast<std::size_t>(k)];
        double wanted = speed[k] - direction.dot(value);
        for (int axis = 0; axis < 3; ++axis)
            if (fixed & (1 << axis)) direction[axis] = 0;
        for (int j = 0; j < found; ++j) {
            const double along = direction.dot(basis[j]);
            direction -= along * basis[j];
            wanted -= along * part[j];
        }
        const double length = direction.norm();
        if (length < parallel) continue;
        basis[found] = direction / length;
        part[found] = wanted / length;
        change += part[found] * basis[found];
        ++found;
    }
    return change;
}

} // namespace kaya
