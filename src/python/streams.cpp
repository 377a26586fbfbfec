#include "python/streams.hpp"

#include <new>
#include <string>

namespace kaya::python {

namespace py = pybind11;

namespace {

struct Sink {
    py::function write;
};

ssize_t write_text(void* cookie, const char* bytes, std::size_t count) {
    const py::gil_scoped_acquire hold;
    try {
        static_cast<Sink*>(cookie)->write(
            py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(bytes, static_cast<Py_ssize_t>(count), "replace")));
    } catch (py::error_already_set& problem) {
        problem.discard_as_unraisable("output of kaya"); // a message must not end a run
    }
    return static_cast<ssize_t>(count);
}

int close_sink(void* cookie) {
    const py::gil_scoped_acquire hold;
    delete static_cast<Sink*>(cookie);
    return 0;
}

} // namespace

void CloseStream::operator()(std::FILE* stream) const {
    const py::gil_scoped_release others; // closing writes the rest
    std::fclose(stream);
}

Stream stream_to(const py::function& write) {
    auto sink = std::make_unique<Sink>(Sink{write});
    std::FILE* stream = fopencookie(sink.get(), "w", {nullptr, write_text, nullptr, close_sink});
    if (stream == nullptr) throw std::bad_alloc();
    static_cast<void>(sink.release()); // close_sink has it
    std::setvbuf(stream, nullptr, _IOLBF, BUFSIZ);
    return Stream(stream);
}

} // namespace kaya::python
