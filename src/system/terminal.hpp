// The terminal behind a stream.
#pragma once

#include <cstddef>
#include <cstdio>

namespace kaya {

bool is_terminal(std::FILE* stream);

/// Characters in a line of it; 80 when it does not tell.
std::size_t columns_of(std::FILE* terminal);

} // namespace kaya
