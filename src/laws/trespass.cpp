#include "laws/trespass.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Numbers that a model never computes.
constexpr std::size_t fence_words = 64; ///< length of a fence: more than a loop that is off by one vector writes
constexpr std::uint64_t fence_word = 0x7ff4'6b61'7961'2121;
constexpr std::size_t fence_bytes = fence_words * sizeof fence_word;
constexpr std::size_t line =
    64; ///< bytes; copies lie in their lines as the columns do, so that the same instructions work on them

/// Longer than a fence with what fills up a line.
const std::array<std::uint64_t, fence_words + 2 * line / sizeof(std::uint64_t)> pattern = [] {
    std::array<std::uint64_t, fence_words + 2 * line / sizeof(std::uint64_t)> words{};
    words.fill(fence_word);
    return words;
}();

/// The first byte of the fence that is not whole; `to` when it is whole.
const std::byte* first_breach(const std::byte* from, const std::byte* to) {
    const auto* const wanted = reinterpret_cast<const std::byte*>(pattern.data());
    if (std::memcmp(from, wanted, static_cast<std::size_t>(to - from)) == 0) return to;
    return std::mismatch(from, to, wanted).first;
}

} // namespace

void FencedColumns::take() {
    std::size_t bytes = fence_bytes + line;
    for (const Column& column : columns_) bytes += column.bytes() + fence_bytes + line;
    if (room_.size() < bytes) room_.resize(bytes);
    const auto fill = [](std::byte* from, std::byte* to) {
        std::memcpy(from, pattern.data(), static_cast<std::size_t>(to - from));
        return to;
    };
    const auto in_line = [](const void* place) { return reinterpret_cast<std::uintptr_t>(place) % line; };
    std::byte* at = room_.data();
    for (Column& column : columns_) {
        std::byte* const first = at + fence_bytes;
        column.copy = fill(at, first + (in_line(column.own) + line - in_line(first)) % line);
        if (column.bytes() > 0) std::memcpy(column.copy, column.own, column.bytes());
        std::memcpy(column.pointer, &column.copy, sizeof column.copy);
        at = column.copy + column.bytes();
    }
    end_ = fill(at, at + fence_bytes);
}

std::optional<Trespass> FencedColumns::breach(const std::byte* from, const std::byte* to, const Column* before,
                                              const Column* after) const {
    const std::byte* const place = first_breach(from, to);
    if (place == to) return std::nullopt;
    const bool comes_after = before != nullptr && (after == nullptr || place - from < to - place);
    const char* where = comes_after ? "after" : "before";
    const Column& column = comes_after ? *before : *after;
    return Trespass{fmt::format("wrote {} the column '{}', outside of its data: it takes more rows or more "
                                "history variables than there are",
                                where, column.name),
                    comes_after && column.rows > 0 ? column.rows - 1 : 0};
}

std::optional<Trespass> FencedColumns::trespass() const {
    const std::byte* from = room_.data();
    const Column* before = nullptr;
    for (const Column& column : columns_) {
        if (auto found = breach(from, column.copy, before, &column)) return found;
        from = column.copy + column.bytes();
        before = &column;
        if (!column.is_read_only || column.bytes() == 0 || std::memcmp(column.copy, column.own, column.bytes()) == 0)
            continue;
        const auto* const own = static_cast<const std::byte*>(column.own);
        const auto changed = std::mismatch(column.copy, column.copy + column.bytes(), own).first - column.copy;
        return Trespass{fmt::format("wrote to '{}', which it may only read", column.name),
                        static_cast<std::size_t>(changed) / column.size};
    }
    return breach(from, end_, before, nullptr);
}

void FencedColumns::give() {
    for (const Column& column : columns_) {
        std::memcpy(column.pointer, &column.own, sizeof column.own);
        if (!column.is_read_only && column.bytes() > 0)
            std::memcpy(const_cast<void*>(column.own), column.copy, column.bytes());
    }
}

void add_columns(FencedColumns& fences, kaya_jbatch& b) {
    const auto add = [&](const char* name, auto*& column) {
        if (column != nullptr) fences.add(name, column, b.n);
    };
    add("area", b.area);
    add("normal_disp", b.normal_disp);
    add("normal_disp_inc", b.normal_disp_inc);
    for (auto*& column : b.shear_disp) add("shear_disp", column);
    for (auto*& column : b.shear_disp_inc) add("shear_disp_inc", column);
    add("pore_pressure", b.pore_pressure);
    add("normal_force", b.normal_force);
    for (auto*& column : b.shear_force) add("shear_force", column);
    add("normal_stiffness", b.normal_stiffness);
    add("shear_stiffness", b.shear_stiffness);
    add("frictional_work", b.frictional_work);
    add("state", b.state);
    add("object", b.object);
    for (auto*& column : b.position) add("position", column);
    for (auto*& column : b.normal) add("normal", column);
    for (auto*& column : b.block) add("block", column);
}

void add_columns(FencedColumns& fences, kaya_zbatch& b) {
    const auto add = [&](const char* name, auto*& column) { fences.add(name, column, b.n); };
    add("volume", b.volume);
    for (auto*& column : b.strain_inc) add("strain_inc", column);
    add("pore_pressure", b.pore_pressure);
    for (auto*& column : b.stress) add("stress", column);
    add("dissipation", b.dissipation);
    add("state", b.state);
    for (auto*& column : b.spin)
        if (column != nullptr) add("spin", column);
}

namespace {

/// The same bytes from one member to another, which have nothing but pointers and counts between them.
template <class Batch> bool same_between(const Batch& a, const Batch& b, std::size_t from, std::size_t to) {
    const auto bytes_of = [from](const Batch& batch) { return reinterpret_cast<const std::byte*>(&batch) + from; };
    return std::memcmp(bytes_of(a), bytes_of(b), to - from) == 0;
}

} // namespace

bool is_other_batch(const kaya_jbatch& before, const kaya_jbatch& after) {
    return !same_between(before, after, 0, offsetof(kaya_jbatch, stiffness_changed)) ||
           !same_between(before, after, offsetof(kaya_jbatch, frictional_work), offsetof(kaya_jbatch, message)) ||
           !same_between(before, after, offsetof(kaya_jbatch, object), offsetof(kaya_jbatch, row)) ||
           !same_between(before, after, offsetof(kaya_jbatch, field), sizeof(kaya_jbatch));
}

bool is_other_batch(const kaya_zbatch& before, const kaya_zbatch& after) {
    return !same_between(before, after, 0, offsetof(kaya_zbatch, row)) ||
           !same_between(before, after, offsetof(kaya_zbatch, spin), sizeof(kaya_zbatch));
}

} // namespace kaya
