#include "base/text_stream.hpp"

#include <new>
#include <utility>

namespace kaya {

namespace {

using Write = std::function<void(std::string_view)>;

ssize_t write_text(void* cookie, const char* bytes, std::size_t count) {
    (*static_cast<const Write*>(cookie))({bytes, count});
    return static_cast<ssize_t>(count);
}

int close_text(void* cookie) {
    delete static_cast<Write*>(cookie);
    return 0;
}

} // namespace

TextStream text_stream(Write write) {
    auto kept = std::make_unique<Write>(std::move(write));
    std::FILE* stream = fopencookie(kept.get(), "w", {nullptr, write_text, nullptr, close_text});
    if (stream == nullptr) throw std::bad_alloc();
    static_cast<void>(kept.release()); // close_text has it
    std::setvbuf(stream, nullptr, _IOLBF, BUFSIZ);
    return TextStream(stream);
}

} // namespace kaya
