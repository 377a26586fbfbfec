// Handles in Lua: one 64 bit number each (a light userdata), so that walking over a model makes no garbage.
#pragma once

#include "lang/script/lua_headers.hpp"
#include "lang/script/world.hpp"

#include <cstdint>

namespace kaya::script {

/// 6 bits table, 30 bits generation, 28 bits slot.
inline constexpr int slot_bits = 28, generation_bits = 30;

inline Handle unpack_handle(const void* packed) {
    const auto bits = reinterpret_cast<std::uintptr_t>(packed);
    return {static_cast<std::int32_t>(bits >> (slot_bits + generation_bits)),
            static_cast<std::uint32_t>(bits & ((1u << slot_bits) - 1)),
            static_cast<std::uint32_t>(bits >> slot_bits & ((1u << generation_bits) - 1))};
}

/// Whether there can be such an object: of a table of the model, with numbers that fit.
bool is_handle(const World& world, const Handle& handle);

/// Throws Diagnostic (own fault) when a number does not fit.
void* pack_handle(const Handle& handle);

/// The type of all handles: fields, methods, text, and errors for arithmetic.
void open_handles(lua_State* L);


} // namespace kaya::script
