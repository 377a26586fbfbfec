#include "python/streams.hpp"

#include "base/text_stream.hpp"

namespace kaya::python {

namespace py = pybind11;

std::shared_ptr<const py::function> kept(const py::function& function) {
    return {new py::function(function), [](const py::function* last) {
                const py::gil_scoped_acquire hold;
                delete last;
            }};
}

void CloseUnlocked::operator()(std::FILE* stream) const {
    const py::gil_scoped_release others; // closing writes the rest
    std::fclose(stream);
}

Stream stream_to(const py::function& write) {
    const auto give = [write = kept(write)](std::string_view text) {
        const py::gil_scoped_acquire hold;
        try {
            (*write)(py::reinterpret_steal<py::str>(
                PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace")));
        } catch (py::error_already_set& problem) {
            problem.discard_as_unraisable("output of kaya"); // a message must not end a run
        }
    };
    return Stream(text_stream(give).release());
}

} // namespace kaya::python
