// A name on the first line, whose suffix selects the format, then bytes as a file of that format: the readers of blocks and of surfaces.
#include "harness.hpp"

#include "base/diagnostic.hpp"
#include "geometry/grid/file_formats.hpp"

#include <cstdlib>

using namespace kaya;

namespace {

void read_with(const auto& reader, const std::string& bytes) {
    if (reader == nullptr) return;
    try {
        reader(bytes, "file");
    } catch (const Diagnostic& mistake) {
        if (mistake.message.empty()) std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string all = fuzz::text_of(data, size);
    const std::size_t line = all.find('\n');
    if (line == all.npos || all.substr(0, line).find('\0') != all.npos) return 0;
    const FileFormat* format = file_format(all.substr(0, line));
    if (format == nullptr) return 0;
    const std::string bytes = all.substr(line + 1);
    read_with(format->blocks, bytes);
    read_with(format->surfaces, bytes);
    return 0;
}
