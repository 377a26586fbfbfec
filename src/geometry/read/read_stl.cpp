// Stereolithography files: triangles corner by corner, as text or binary (80 bytes, number of triangles,
// 50 bytes for each).
#include "base/diagnostic.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/read/words.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace kaya {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are read as they lie in memory");

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t triangle_count(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

/// A binary file has exactly the length given by its count; text files may begin like binary ones and vice versa, so only this test is
/// certain.
bool is_binary(std::string_view bytes) {
    return bytes.size() >= header_bytes &&
           bytes.size() == header_bytes + triangle_bytes * static_cast<std::size_t>(triangle_count(bytes));
}

std::vector<FaceSoup> read_binary(std::string_view bytes, const std::string& file) {
    FaceSoup soup;
    for (std::size_t i = 0; i < triangle_count(bytes); ++i) {
        std::array<float, 9> corners;
        std::memcpy(corners.data(), bytes.data() + header_bytes + i * triangle_bytes + 12, sizeof corners);
        std::vector<Vec3> loop;
        for (int k = 0; k < 3; ++k) {
            loop.emplace_back(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
            if (!loop.back().allFinite())
                throw Diagnostic(
                    fmt::format("{}: triangle {} has a coordinate that is not a finite number", file, i + 1));
        }
        soup.loops.push_back(std::move(loop));
    }
    return {std::move(soup)};
}

std::vector<FaceSoup> read_text(std::string_view text, const std::string& file) {
    Words words(text, file, "", "");
    std::vector<FaceSoup> soups;
    while (!words.peek().empty()) {
        FaceSoup soup;
        words.expect("solid");
        soup.name = words.next_in_line();
        words.skip_line();
        while (same_word(words.peek(), "facet")) {
            words.expect("facet");
            words.skip_line(); // the normal follows from the corners
            words.expect("outer");
            words.expect("loop");
            std::vector<Vec3> loop;
            while (same_word(words.peek(), "vertex")) {
                words.expect("vertex");
                loop.push_back(words.point("a coordinate"));
            }
            words.expect("endloop");
            words.expect("endfacet");
            soup.loops.push_back(std::move(loop));
        }
        words.expect("endsolid");
        words.skip_line();
        soups.push_back(std::move(soup));
    }
    return soups;
}

} // namespace

std::vector<FaceSoup> read_stl(std::string_view bytes, const std::string& file) {
    const bool binary = is_binary(bytes);
    if (!binary && !same_word(bytes.substr(0, 5), "solid"))
        throw Diagnostic(fmt::format("{} is not a whole STL file: it does not begin with 'solid', and its length is "
                                     "not that of its number of triangles",
                                     file),
                         "export it again");
    return binary ? read_binary(bytes, file) : read_text(bytes, file);
}

} // namespace kaya
