// The content of a command's struct as text, whatever its members are: two structs with the same text mean the same. Places in the deck are
// left out.
#pragma once

#include "lang/commands/commands.hpp"

#include <any>
#include <array>
#include <concepts>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace kaya::lang {

/// Converts to the type of any member but Vec3, whose constructors take anything.
struct AnyMember {
    template <class Type>
    requires(!std::same_as<Type, Vec3>) operator Type() const;
};
struct VectorMember {
    operator Vec3() const;
};

/// How many members an aggregate has: as many as it can be initialised with.
template <class Struct, class... Members> consteval std::size_t member_count() {
    if constexpr (requires { Struct{Members{}..., AnyMember{}}; }) return member_count<Struct, Members..., AnyMember>();
    else if constexpr (requires { Struct{Members{}..., VectorMember{}}; })
        return member_count<Struct, Members..., VectorMember>();
    else return sizeof...(Members);
}

template <class Struct, class Visit> void for_each_member(const Struct& value, Visit visit) {
    constexpr std::size_t count = member_count<Struct>();
    static_assert(count <= 24, "add a line below");
    [[maybe_unused]] const auto each = [&](const auto&... members) { (visit(members), ...); };
    // clang-format off
    if constexpr (count == 1) { const auto& [a] = value; each(a); }
    if constexpr (count == 2) { const auto& [a, b] = value; each(a, b); }
    if constexpr (count == 3) { const auto& [a, b, c] = value; each(a, b, c); }
    if constexpr (count == 4) { const auto& [a, b, c, d] = value; each(a, b, c, d); }
    if constexpr (count == 5) { const auto& [a, b, c, d, e] = value; each(a, b, c, d, e); }
    if constexpr (count == 6) { const auto& [a, b, c, d, e, f] = value; each(a, b, c, d, e, f); }
    if constexpr (count == 7) { const auto& [a, b, c, d, e, f, g] = value; each(a, b, c, d, e, f, g); }
    if constexpr (count == 8) { const auto& [a, b, c, d, e, f, g, h] = value; each(a, b, c, d, e, f, g, h); }
    if constexpr (count == 9) { const auto& [a, b, c, d, e, f, g, h, i] = value; each(a, b, c, d, e, f, g, h, i); }
    if constexpr (count == 10) { const auto& [a, b, c, d, e, f, g, h, i, j] = value; each(a, b, c, d, e, f, g, h, i, j); }
    if constexpr (count == 11) { const auto& [a, b, c, d, e, f, g, h, i, j, k] = value; each(a, b, c, d, e, f, g, h, i, j, k); }
    if constexpr (count == 12) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value; each(a, b, c, d, e, f, g, h, i, j, k, l); }
    if constexpr (count == 13) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m); }
    if constexpr (count == 14) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n); }
    if constexpr (count == 15) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o); }
    if constexpr (count == 16) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p); }
    if constexpr (count == 17) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q); }
    if constexpr (count == 18) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r); }
    if constexpr (count == 19) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s); }
    if constexpr (count == 20) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t); }
    if constexpr (count == 21) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u); }
    if constexpr (count == 22) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v); }
    if constexpr (count == 23) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w); }
    if constexpr (count == 24) { const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = value; each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x); }
    // clang-format on
}

inline void add_text(std::string& to, const Place&) { to += '_'; }
inline void add_text(std::string& to, const std::string& text) { to += fmt::format("'{}'", text); }
inline void add_text(std::string& to, const Vec3& v) { to += fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }
inline void add_text(std::string& to, const std::monostate&) { to += "nil"; }
template <class Number>
requires std::is_arithmetic_v<Number>
void add_text(std::string& to, Number number) { to += fmt::format("{}", number); }
template <class Enum>
requires std::is_enum_v<Enum>
void add_text(std::string& to, Enum value) { to += fmt::format("#{}", static_cast<int>(value)); }
template <class Type> void add_text(std::string& to, const std::optional<Type>& value);
template <class First, class Second> void add_text(std::string& to, const std::pair<First, Second>& value);
template <class Type> void add_text(std::string& to, const std::vector<Type>& list);
template <class Type, std::size_t size> void add_text(std::string& to, const std::array<Type, size>& list);
template <class... Type> void add_text(std::string& to, const std::variant<Type...>& value);
template <class Struct>
requires std::is_aggregate_v<Struct>
void add_text(std::string& to, const Struct& value) {
    to += '{';
    for_each_member(value, [&](const auto& member) {
        add_text(to, member);
        to += ' ';
    });
    to += '}';
}
template <class Type> void add_text(std::string& to, const std::optional<Type>& value) {
    if (value) add_text(to, *value);
    else to += '-';
}
template <class First, class Second> void add_text(std::string& to, const std::pair<First, Second>& value) {
    add_text(to, value.first);
    add_text(to, value.second);
}
template <class List> void add_list(std::string& to, const List& list) {
    to += '[';
    for (const auto& item : list) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(item)>, bool>) to += item ? '1' : '0';
        else add_text(to, item);
        to += ' ';
    }
    to += ']';
}
template <class Type> void add_text(std::string& to, const std::vector<Type>& list) { add_list(to, list); }
template <class Type, std::size_t size> void add_text(std::string& to, const std::array<Type, size>& list) {
    add_list(to, list);
}
template <class... Type> void add_text(std::string& to, const std::variant<Type...>& value) {
    to += fmt::format("|{}:", value.index());
    std::visit([&](const auto& held) { add_text(to, held); }, value);
}

template <class... Command> std::string text_of_one(const std::any& command, CommandList<Command...>) {
    std::string text = "of no command";
    const auto take = [&]<class One>(const One* one) {
        if (one == nullptr) return;
        text.clear();
        add_text(text, *one);
    };
    (take(std::any_cast<Command>(&command)), ...);
    return text;
}

/// "{1 'wall' [...] _}"
inline std::string struct_text(const std::any& command) { return text_of_one(command, Commands{}); }

} // namespace kaya::lang
