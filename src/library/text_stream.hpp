// A stream whose text goes to a function of another program.
#pragma once

#include "kaya/kaya.h"

#include <cstdio>
#include <memory>

namespace kaya::library {

struct CloseStream {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

/// Text is given to `write` line by line; without `write` it is not kept. Throws std::bad_alloc.
Stream stream_to(kaya_writer write, void* user);

} // namespace kaya::library
