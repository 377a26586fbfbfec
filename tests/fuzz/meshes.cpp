// A name on the first line, whose suffix selects the format, then bytes as a file of that format: the readers of blocks, surfaces, grounds, pits
// and fractures.
#include "harness.hpp"

#include "base/diagnostic.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/ground/ground.hpp"
#include "geometry/ground/pit.hpp"
#include "geometry/read/read_fractures.hpp"
#include "geometry/read/read_sample.hpp"

#include <array>
#include <cstdlib>

using namespace kaya;

namespace {

using Read = void (*)(std::string_view bytes, const std::string& file);

template <FractureFormat format> void fractures(std::string_view bytes, const std::string& file) {
    read_fractures(bytes, file, format);
}

/// The texts whose readers are chosen by a command, under suffixes of this harness.
struct Text {
    std::string_view suffix;
    Read read;
};
const std::array<Text, 8> texts{{
    {".xyz", [](std::string_view bytes, const std::string& file) { ground_from_points(bytes, file); }},
    {".asc", [](std::string_view bytes, const std::string& file) { ground_from_grid(bytes, file); }},
    {".pit", [](std::string_view bytes, const std::string& file) { ground_from_pit(bytes, file); }},
    {".discs", fractures<FractureFormat::discs>},
    {".polygons", fractures<FractureFormat::polygons>},
    {".traces", fractures<FractureFormat::traces>},
    {".fab", fractures<FractureFormat::fracman>},
    {".sample",
     [](std::string_view bytes, const std::string& file) {
         read_planes(bytes, file);
         read_diameters(bytes, file);
     }},
}};

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
    const std::string name = all.substr(0, line), bytes = all.substr(line + 1);
    for (const Text& text : texts)
        if (name.ends_with(text.suffix)) read_with(text.read, bytes);
    if (const FileFormat* format = file_format(name)) {
        read_with(format->blocks, bytes);
        read_with(format->surfaces, bytes);
    }
    return 0;
}
