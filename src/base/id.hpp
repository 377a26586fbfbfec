// Typed names of rows. A row number changes when its table is compacted; an id does not.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace kaya {

using Row = std::int32_t;
inline constexpr Row no_row = -1;

/// Slot and generation: a handle of a deleted object is recognised, never followed.
template <class Tag> struct Id {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; // 0 is the id of nothing

    explicit operator bool() const { return generation != 0; }
    auto operator<=>(const Id&) const = default;
};

/// Hands out ids for one table and finds the row that an id stands for.
template <class Tag> class IdMap {
public:
    Id<Tag> create(Row row) {
        if (free_.empty()) {
            slots_.push_back({row, 1});
            return {static_cast<std::uint32_t>(slots_.size() - 1), 1};
        }
        const auto slot = free_.back();
        free_.pop_back();
        slots_[slot].row = row;
        return {slot, slots_[slot].generation};
    }

    void destroy(Id<Tag> id) {
        if (row(id) == no_row) return;
        slots_[id.slot].row = no_row;
        ++slots_[id.slot].generation;
        free_.push_back(id.slot);
    }

    void move(Id<Tag> id, Row row) { slots_[id.slot].row = row; }

    /// The row, or no_row when the object was deleted.
    Row row(Id<Tag> id) const {
        if (id.slot >= slots_.size() || slots_[id.slot].generation != id.generation) return no_row;
        return slots_[id.slot].row;
    }

    void clear() {
        slots_.clear();
        free_.clear();
    }

    /// Whole state, for save and restore.
    struct Slot {
        Row row;
        std::uint32_t generation;
    };
    std::vector<Slot>& slots() { return slots_; }
    const std::vector<Slot>& slots() const { return slots_; }
    std::vector<std::uint32_t>& free_slots() { return free_; }
    const std::vector<std::uint32_t>& free_slots() const { return free_; }

private:
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
};

} // namespace kaya
