// What the operating system can do about the memory of a large model.
#pragma once

#include <cstddef>

namespace kaya {

/// Gives memory that is free back to the system.
void give_back_memory();

/// Bytes that programs can still take without driving others out; the largest number where the system does not tell.
std::size_t memory_available();

/// From now on this program, and what it starts, gets no more memory than there was available when it began, or half of the
/// machine's: what takes memory without end, as a joint model may, meets an allocation that fails, before the system ends
/// some program without a word. A limit that is lower stays.
void limit_memory_to_available();

/// Puts a long array, such as a column of a large table, on large pages where the system has them: a cycle goes through
/// all columns, and with pages of 4 kB spends a tenth of its time on finding them. Nothing happens where it cannot be.
void use_large_pages(const void* first, std::size_t bytes);

} // namespace kaya
