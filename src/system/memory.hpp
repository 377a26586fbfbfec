// Memory of large models: limits and page sizes of the operating system.
#pragma once

#include <cstddef>
#include <vector>

namespace kaya {

/// Gives memory that is free back to the system.
void give_back_memory();

/// Keeps memory that is freed for the next use, up to 256 MB: a search for contacts frees lists of some 10 MB, and the system would clear their
/// pages each time again. give_back_memory() gives it back all the same.
void keep_freed_memory();

/// Bytes; 0 where the system does not tell.
std::size_t memory_of_machine();

/// Bytes available without displacing other programs; the largest number where the system does not tell.
std::size_t memory_available();

/// Limits the memory of this program and its children to what was available at the start, or half of the machine's: an endless allocation,
/// as in a joint model, fails before the system ends some program silently. A lower limit is kept.
void limit_memory_to_available();

/// An array, such as a column of a table.
struct Bytes {
    const void* first;
    std::size_t count;

    bool operator==(const Bytes&) const = default;
};

/// Puts arrays on large pages where the system has them: a cycle reads all columns, and with pages of 4 kB spends a tenth of its time on
/// address translation. Arrays that lie next to each other share large pages. Does nothing where that is impossible.
void use_large_pages(std::vector<Bytes> arrays);

} // namespace kaya
