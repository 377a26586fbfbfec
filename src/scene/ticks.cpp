#include "scene/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace kaya {

namespace {

Colour between(std::span<const Colour> stops, double part) {
    const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double rest = place - static_cast<double>(first);
    Colour colour;
    for (std::size_t k = 0; k < 3; ++k) colour[k] = stops[first][k] * (1 - rest) + stops[first + 1][k] * rest;
    return colour;
}

} // namespace

Ticks round_ticks(double low, double high, int about) {
    if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
    if (low > high) std::swap(low, high);
    // A range that is rounding only is shown as one value in the middle.
    const double size = std::max(std::abs(low), std::abs(high));
    if (high - low <= 1e-9 * size || high == low) {
        const double half = size > 0 ? 0.5 * size : 0.5;
        low -= half, high += half;
    }
    const double rough = (high - low) / std::max(about, 1), power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough * (1 - 1e-9)) {
            step = factor * power;
            break;
        }
    return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step};
}

std::vector<double> Ticks::values() const {
    std::vector<double> all;
    const double first = std::ceil(low / step - 1e-9) * step, last = std::floor(high / step + 1e-9) * step;
    const auto count = std::llround((last - first) / step);
    for (long long k = 0; k <= count; ++k) all.push_back(first + static_cast<double>(k) * step);
    return all;
}

void make_equal(Ticks& x, Ticks& y, double width, double height) {
    const double across = (x.high - x.low) / width, upward = (y.high - y.low) / height;
    Ticks& narrow = across < upward ? x : y;
    const double middle = (narrow.low + narrow.high) / 2,
                 half = std::max(across, upward) * (across < upward ? width : height) / 2;
    constexpr int about = 7;
    narrow = {middle - half, middle + half,
              std::max(narrow.step, round_ticks(middle - half, middle + half, about).step)};
}

std::string Ticks::label(double value) const {
    if (std::abs(value) < 1e-6 * step) value = 0;
    const double largest = std::max(std::abs(low), std::abs(high));
    if (value != 0 && (largest >= 1e6 || largest < 1e-3)) {
        const double whole = std::floor(std::log10(largest)), digits = whole - std::floor(std::log10(step) + 1e-9);
        const int power = static_cast<int>(whole);
        return fmt::format("{:.{}f}e{}", value / std::pow(10, power), static_cast<int>(std::clamp(digits, 0.0, 9.0)),
                           power);
    }
    const int places = static_cast<int>(std::clamp(-std::floor(std::log10(step) + 1e-9), 0.0, 12.0));
    return fmt::format("{:.{}f}", value, places);
}

double round_length(double most) {
    const double power = std::pow(10, std::floor(std::log10(most) + 1e-12));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= most * (1 + 1e-12)) return factor * power;
    return power;
}

std::string short_number(double value) {
    std::string text = fmt::format("{:.4g}", value == 0 ? 0.0 : value);
    // 1e+06 and 1e-07: as people write them.
    const auto mark = text.find('e');
    if (mark == std::string::npos) return text;
    return text.substr(0, mark + 1) + std::to_string(std::stoi(text.substr(mark + 1)));
}

Colour sequential_colour(double part) {
    static constexpr Colour stops[] = {{0.267, 0.005, 0.329}, {0.283, 0.141, 0.458}, {0.254, 0.265, 0.530},
                                       {0.207, 0.372, 0.553}, {0.164, 0.471, 0.558}, {0.128, 0.567, 0.551},
                                       {0.135, 0.659, 0.518}, {0.267, 0.749, 0.441}, {0.478, 0.821, 0.318},
                                       {0.741, 0.873, 0.150}, {0.993, 0.906, 0.144}};
    return between(stops, part);
}

Colour diverging_colour(double part) {
    static constexpr Colour stops[] = {{0.02, 0.19, 0.38}, {0.26, 0.58, 0.76}, {0.82, 0.90, 0.94}, {0.97, 0.97, 0.97},
                                       {0.98, 0.86, 0.70}, {0.88, 0.51, 0.08}, {0.50, 0.23, 0.03}};
    return between(stops, part);
}

Colour named_colour(std::size_t index) {
    static constexpr Colour colours[] = {{0.34, 0.71, 0.91}, {0.90, 0.62, 0.00}, {0.00, 0.62, 0.45},
                                         {0.94, 0.89, 0.26}, {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00},
                                         {0.80, 0.47, 0.65}, {0.55, 0.55, 0.55}};
    return colours[index % std::size(colours)];
}

} // namespace kaya
