#include "lang/script/values/handles.hpp"

#include "base/diagnostic.hpp"

namespace kaya::script {

bool is_handle(const World& world, const Handle& handle) {
    return handle.table >= 0 && handle.table < static_cast<std::int32_t>(world.tables().size()) &&
           handle.slot >> slot_bits == 0 && handle.generation >> generation_bits == 0;
}

void* pack_handle(const Handle& handle) {
    if (handle.table < 0 || handle.table >= 16 || handle.slot >> slot_bits || handle.generation >> generation_bits)
        throw Diagnostic("an object of the model cannot be named by a script: its number is too large", {}, Fault::own);
    const std::uintptr_t bits = static_cast<std::uintptr_t>(handle.table)
                                    << (slot_bits + generation_bits + model_bits) |
                                static_cast<std::uintptr_t>(handle.model) << (slot_bits + generation_bits) |
                                static_cast<std::uintptr_t>(handle.generation) << slot_bits | handle.slot;
    return reinterpret_cast<void*>(bits);
}

} // namespace kaya::script
