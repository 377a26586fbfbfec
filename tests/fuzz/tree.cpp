// Bytes as the HDF5 file in a save: every object reachable from its root is read, within the bounds of the file.
#include "harness.hpp"

#include "io/hdf5_format.hpp"

#include <cstdlib>

using namespace kaya;

namespace {

constexpr std::uint64_t most_unpacked = 64 << 20; ///< as in the reader of saves, for all data together

/// Reads one object of the file: a group with its contents, or data.
void read_object(hdf5::Image& image, hdf5::Address header, int depth) {
    constexpr int deepest = 30;
    if (depth > deepest) return;
    try {
        for (const auto& [name, target] : hdf5::read_group(image, header).links) read_object(image, target, depth + 1);
        return;
    } catch (const TreeError& error) {
        if (*error.what() == '\0') std::abort();
    }
    try {
        const hdf5::Data data = hdf5::read_data(image, header);
        if (data.bytes > most_unpacked) return;
        std::string bytes(data.bytes, '\0');
        hdf5::unpack(data, bytes.data());
    } catch (const TreeError& error) {
        if (*error.what() == '\0') std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    hdf5::Image image({reinterpret_cast<const char*>(data), size});
    try {
        read_object(image, hdf5::root_group(image), 0);
    } catch (const TreeError&) { return 0; }
    return 0;
}
