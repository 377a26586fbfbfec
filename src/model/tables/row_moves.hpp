// Rows of a table that change places: few leave their order at a time, and the others move in place, in runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kaya {

/// Initial value of a new row. Eigen leaves vectors uninitialised, so they are set here.
template <class T> T new_value() {
    if constexpr (requires { T::Zero(); }) return T::Zero();
    else return T{};
}

/// The source of each future row, sorted for the move of columns.
class RowMoves {
public:
    /// `rows` may repeat a row; negative ones are new.
    explicit RowMoves(const std::vector<std::int32_t>& rows) : size_(rows.size()) {
        std::int32_t last = -1; // runs go up: so they can move in place
        for (std::size_t to = 0; to < rows.size(); ++to) {
            const std::int32_t from = rows[to];
            if (from <= last) {
                others_.push_back({from, to});
                continue;
            }
            if (!runs_.empty() && from == last + 1 && runs_.back().to + runs_.back().count == to) ++runs_.back().count;
            else runs_.push_back({static_cast<std::size_t>(from), to, 1});
            last = from;
        }
    }

    /// Whether no row is new, is repeated or leaves the order of the others: then nothing is copied.
    bool in_order() const { return others_.empty(); }

    template <class T> void apply(std::vector<T>& column) const {
        std::vector<T> others;
        others.reserve(others_.size());
        for (const Other& o : others_)
            others.push_back(o.from < 0 ? new_value<T>() : column[static_cast<std::size_t>(o.from)]);
        // One part of so many: tables that grow a little at a time stay where they are.
        constexpr std::size_t spare = 32;
        if (size_ > column.capacity()) column.reserve(column.empty() ? size_ : size_ + size_ / spare);
        if (size_ > column.size()) column.resize(size_, new_value<T>());
        // A run that moves down reaches no row that a later one needs, nor does one that moves up any that an earlier one needs.
        for (const Run& run : runs_)
            if (run.to < run.from)
                std::move(column.data() + run.from, column.data() + run.from + run.count, column.data() + run.to);
        for (auto run = runs_.rbegin(); run != runs_.rend(); ++run)
            if (run->to > run->from)
                std::move_backward(column.data() + run->from, column.data() + run->from + run->count,
                                   column.data() + run->to + run->count);
        for (std::size_t i = 0; i < others.size(); ++i) column[others_[i].to] = others[i];
        column.erase(column.begin() + static_cast<std::ptrdiff_t>(size_), column.end());
    }

private:
    /// Rows that stay next to each other.
    struct Run {
        std::size_t from, to, count;
    };
    struct Other {
        std::int32_t from;
        std::size_t to;
    };

    std::size_t size_;
    std::vector<Run> runs_;
    std::vector<Other> others_;
};

} // namespace kaya
