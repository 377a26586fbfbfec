#include "report/packed.hpp"

#include "base/base64.hpp"
#include "base/deflate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

namespace kaya {

std::string packed_bytes(std::string_view bytes) { return base64(deflated(bytes)); }

std::string byte_planes(std::string_view bytes, std::size_t size) {
    const std::size_t count = bytes.size() / size;
    std::string planes(bytes.size(), '\0');
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < size; ++k) planes[k * count + i] = bytes[i * size + k];
    return planes;
}

float rounded(float number) {
    if (!std::isfinite(number)) return number;
    constexpr std::uint32_t low = 0xff; // of the 23 bits after the first
    const auto bits = std::bit_cast<std::uint32_t>(number) + (low + 1) / 2;
    const float result = std::bit_cast<float>(bits & ~low);
    return std::isfinite(result) ? result : number;
}

std::string packed_rounded(std::vector<float> numbers) {
    std::ranges::transform(numbers, numbers.begin(), rounded);
    return packed(std::span<const float>(numbers));
}

} // namespace kaya
