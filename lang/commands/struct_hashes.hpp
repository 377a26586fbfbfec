// The members of a struct, down to numbers, texts and choices, as hashes: how far a struct agrees with another one.
#pragma once

#include "lang/commands/struct_text.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>

namespace kaya::lang {

struct MemberHash {
    std::uint64_t path = 0, value = 0;
    auto operator<=>(const MemberHash&) const = default;
};
/// Sorted. Places in the deck are left out.
using MemberHashes = std::vector<MemberHash>;

class HashWalk {
public:
    MemberHashes take() && {
        std::ranges::sort(hashes_);
        return std::move(hashes_);
    }

    void add(const Place&) {}
    void add(const std::monostate&) { put(0); }
    void add(const std::string& text) { put(std::hash<std::string>{}(text)); }
    void add(const Vec3& v) {
        for (int i = 0; i < 3; ++i) inside(static_cast<std::size_t>(i), v[i]);
    }
    void add(double number) { put(std::bit_cast<std::uint64_t>(number)); }
    template <class Number>
    requires std::is_integral_v<Number> || std::is_enum_v<Number>
    void add(Number number) { put(static_cast<std::uint64_t>(number)); }
    template <class Type> void add(const std::optional<Type>& value) {
        if (!value) return;
        put(1);
        inside(0, *value);
    }
    template <class First, class Second> void add(const std::pair<First, Second>& value) {
        inside(0, value.first);
        inside(1, value.second);
    }
    template <class Type> void add(const std::vector<Type>& list) { add_list(list); }
    template <class Type, std::size_t size> void add(const std::array<Type, size>& list) { add_list(list); }
    template <class... Type> void add(const std::variant<Type...>& value) {
        put(value.index());
        std::visit([&](const auto& held) { inside(value.index(), held); }, value);
    }
    template <class Struct>
    requires std::is_aggregate_v<Struct>
    void add(const Struct& value) {
        std::size_t member = 0;
        for_each_member(value, [&](const auto& each) { inside(member++, each); });
    }

private:
    template <class List> void add_list(const List& list) {
        std::size_t item = 0;
        for (const auto& each : list) inside(item++, each);
    }
    template <class Type> void inside(std::size_t number, const Type& value) {
        const std::uint64_t outer = path_;
        path_ = (path_ + number + 1) * 0x9e3779b97f4a7c15; // spreads the bits
        path_ ^= path_ >> 29;
        add(value);
        path_ = outer;
    }
    void put(std::uint64_t value) { hashes_.push_back({path_, value}); }

    MemberHashes hashes_;
    std::uint64_t path_ = 1;
};

template <class Struct> MemberHashes hashes_of(const Struct& value) {
    HashWalk walk;
    walk.add(value);
    return std::move(walk).take();
}

/// How a struct agrees with the wanted one, compared with the struct before some words were read.
struct Progress {
    int gained = 0; ///< members that are as wanted now, less those that were so before
    int lost = 0;   ///< members that were as wanted before, and are not
    int wrong = 0;  ///< members that have another value now, and neither the wanted one
    int mended = 0; ///< members that had a wrong value, and have another one
};
Progress progress(const MemberHashes& before, const MemberHashes& after, const MemberHashes& wanted);

} // namespace kaya::lang
