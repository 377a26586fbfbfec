// Roles of columns. Cutting, copying, excavating, filling, `reset` and the consistency check are loops over roles: a new column declares
// its role once, in columns().
#pragma once

#include <cstdint>

namespace kaya {

enum class Role : std::uint8_t {
    identity,     ///< ids, numbers, revisions: each row has its own
    link,         ///< rows of other tables, or their ids
    local_link,   ///< rows counted from the first of their block: right wherever the block is
    setting,      ///< set by the user: pieces and copies inherit it
    condition,    ///< holds and water: pieces inherit it, copies do not; refilled blocks keep it
    load,         ///< pieces share it by place or volume; blocks that are filled in and copies have none
    motion,       ///< velocities: blocks that are filled in and copies are at rest
    displacement, ///< the same, and `reset disp` and `reset jdisp` set it to zero
    state,        ///< forces, stresses, history: blocks that are filled in and copies carry nothing
    geometry      ///< shape, place and mass
};

/// The role of a column, and the target of its numbers: rows of the table `To`, or of a list of the model.
template <class To = void> struct ColumnRole {
    Role role;
    bool may_be_none = false; ///< no_row is allowed
    constexpr operator Role() const { return role; }
};

template <class To> constexpr ColumnRole<To> link() { return {Role::link}; }
template <class To> constexpr ColumnRole<To> link_or_none() { return {Role::link, true}; }
template <class To> constexpr ColumnRole<To> setting() { return {Role::setting}; }
template <class To> constexpr ColumnRole<To> condition() { return {Role::condition}; }

// Lists of the model that are not tables.
struct JointProperties;
struct Roller;
struct TimeFunction;
struct ZoneProperties;
struct Group; ///< Model::group_names

} // namespace kaya
