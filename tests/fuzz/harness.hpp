// Interface of a harness: one input, once. It must return without a crash for any bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments);

namespace kaya::fuzz {

/// Larger inputs find no more defects and take longer.
inline constexpr std::size_t largest = 1 << 16;

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Creates an empty working folder, because a script may write files. It is removed at the end of the program.
void work_in_empty_folder();

} // namespace kaya::fuzz
