// A stream whose text goes to a function.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <string_view>

namespace kaya {

struct CloseStream {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using TextStream = std::unique_ptr<std::FILE, CloseStream>;

/// Text is given to `write` line by line, the rest when the stream is closed. `write` must not throw. Throws std::bad_alloc.
TextStream text_stream(std::function<void(std::string_view text)> write);

} // namespace kaya
