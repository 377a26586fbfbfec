// Handles in Lua: one 64 bit number each (a light userdata), so that walking over a model makes no garbage.
#pragma once

#include "lang/script/values/world.hpp"

#include <cstdint>

namespace kaya::script {

/// 4 bits table, 7 bits model, 26 bits generation, 27 bits slot.
inline constexpr int slot_bits = 27, generation_bits = 26, model_bits = 7;
static_assert(World::model_numbers == 1u << model_bits);

inline Handle unpack_handle(const void* packed) {
    const auto bits = reinterpret_cast<std::uintptr_t>(packed);
    const auto part = [bits](int from, int count) {
        return static_cast<std::uint32_t>(bits >> from & ((1u << count) - 1));
    };
    return {static_cast<std::int32_t>(bits >> (slot_bits + generation_bits + model_bits)), part(0, slot_bits),
            part(slot_bits, generation_bits), static_cast<std::uint8_t>(part(slot_bits + generation_bits, model_bits))};
}

/// Whether it belongs to the present model; handles of replaced models are stale.
inline bool is_of_this_model(const World& world, const Handle& handle) { return handle.model == world.model_number; }

/// Whether there can be such an object: of a table of the model, with numbers that fit.
bool is_handle(const World& world, const Handle& handle);

/// Throws Diagnostic (own fault) when a number does not fit.
void* pack_handle(const Handle& handle);

} // namespace kaya::script
