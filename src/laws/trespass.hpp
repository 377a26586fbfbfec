// Detects writes of a law outside of its columns: columns between fences, and checksums of read-only data.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// A checksum that any likely change alters.
inline std::uint64_t sum_of_bits(const double* column, std::size_t n) {
    // Two sums, one of them weighted by position, so that it is a vector loop.
    std::uint64_t sum = 0, placed = 0, place = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(column[i]);
        sum += bits;
        placed ^= bits + place;
        place += 0x9e37'79b9'7f4a'7c15u;
    }
    return sum ^ placed << 1;
}

/// Up to `Most` columns of one row, each between two fences. Reused to save allocations.
template <std::size_t Most> class Fences {
public:
    Fences() : cells_((Most + 1) * (width + 1), fence) {}

    void clear() { count_ = 0; }

    /// Points a column at a fenced one, which receives a copy of it.
    template <class T> void add(const char* name, T*& column) {
        std::uint64_t* cell = cells_.data() + cell_of(count_);
        *cell = fence;
        std::memcpy(cell, column, sizeof(T));
        column = reinterpret_cast<T*>(cell);
        names_[count_] = name;
        sizes_[count_++] = sizeof(T);
    }

    /// The first column whose fence was overwritten; the fences are then restored.
    std::optional<std::string> breach() {
        std::optional<std::string> found;
        for (std::size_t k = 0; k < count_ && !found; ++k) {
            const std::uint64_t* cell = cells_.data() + cell_of(k);
            std::uint64_t tail = 0; // of a column with shorter numbers
            std::memcpy(&tail, cell, sizeof tail);
            const bool short_one = sizes_[k] < sizeof tail;
            if (short_one && tail >> 32 != fence >> 32) found = fmt::format("after the column '{}'", names_[k]);
            if (!is_whole(cell + 1)) found = fmt::format("after the column '{}'", names_[k]);
            if (k == 0 && !is_whole(cell - width)) found = fmt::format("before the column '{}'", names_[k]);
        }
        if (found) std::fill(cells_.begin(), cells_.end(), fence);
        return found;
    }

private:
    /// A number that no model computes.
    static constexpr std::uint64_t fence = 0x7ff4'6b61'7961'2121;
    static constexpr std::size_t width =
        64; ///< length of a fence in numbers: more than a loop that is off by one vector writes

    static std::size_t cell_of(std::size_t k) { return width + k * (width + 1); }
    static bool is_whole(const std::uint64_t* first) {
        std::uint64_t others = 0; // the whole fence, so that it is a vector loop
        for (std::size_t i = 0; i < width; ++i) others |= first[i] ^ fence;
        return others == 0;
    }

    std::vector<std::uint64_t> cells_;
    std::array<const char*, Most> names_{};
    std::array<std::size_t, Most> sizes_{};
    std::size_t count_ = 0;
};

} // namespace kaya
