#include "base/number_text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

std::string number_text(double value) { return fmt::format("{:g}", value == 0 ? 0.0 : value); }

std::string vector_text(const Vec3& vector) {
    return fmt::format("({}, {}, {})", number_text(vector[0]), number_text(vector[1]), number_text(vector[2]));
}

std::string coordinates_text(const Vec3& place) {
    constexpr double far = 1e4, farther = 1e12, thousandth = 1e-3;
    const auto text = [&](double value) {
        const double size = std::abs(value);
        if (!(size >= far && size < farther)) return number_text(value);
        return fmt::format("{}", std::round(value / thousandth) / (1 / thousandth));
    };
    return fmt::format("{}, {}, {}", text(place[0]), text(place[1]), text(place[2]));
}

std::string place_text(const Vec3& place) { return fmt::format("({})", coordinates_text(place)); }

} // namespace kaya
