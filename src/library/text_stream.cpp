#include "library/text_stream.hpp"

#include <new>

namespace kaya::library {

namespace {

struct Sink {
    kaya_writer write;
    void* user;
};

ssize_t write_text(void* cookie, const char* bytes, std::size_t count) {
    const auto& sink = *static_cast<const Sink*>(cookie);
    if (sink.write != nullptr) sink.write(sink.user, bytes, count);
    return static_cast<ssize_t>(count);
}

int close_sink(void* cookie) {
    delete static_cast<Sink*>(cookie);
    return 0;
}

} // namespace

Stream stream_to(kaya_writer write, void* user) {
    auto sink = std::make_unique<Sink>(Sink{write, user});
    std::FILE* stream = fopencookie(sink.get(), "w", {nullptr, write_text, nullptr, close_sink});
    if (stream == nullptr) throw std::bad_alloc();
    static_cast<void>(sink.release()); // close_sink has it
    std::setvbuf(stream, nullptr, _IOLBF, BUFSIZ);
    return Stream(stream);
}

} // namespace kaya::library
