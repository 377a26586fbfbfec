#include "io/save_trailer.hpp"

#include "base/diagnostic.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace kaya {

namespace {

constexpr std::string_view hdf5_signature{"\x89HDF\r\n\x1a\n", 8};
constexpr std::string_view trailer_mark = "KAYASAVE";

/// Numbers are stored in the byte order of the machine; files are written on little-endian machines only.
struct Trailer {
    std::array<char, 8> mark;
    std::uint64_t length;
    std::uint64_t digest;
};
static_assert(sizeof(Trailer) == 24, "no padding");

std::uint64_t digest_of(std::string_view bytes) {
    Hash hash;
    hash.add(bytes);
    return hash.value();
}

Diagnostic unusable_file(std::string message) {
    return Diagnostic(std::move(message), "the model is unchanged; restore another save file", Fault::run);
}

} // namespace

std::string with_trailer(std::string image) {
    Trailer trailer{{}, image.size(), digest_of(image)};
    std::memcpy(trailer.mark.data(), trailer_mark.data(), trailer_mark.size());
    image.append(reinterpret_cast<const char*>(&trailer), sizeof trailer);
    return image;
}

std::string_view without_trailer(std::string_view file, const std::string& name) {
    if (file.empty()) throw unusable_file(fmt::format("'{}' is empty", name));
    const auto head = file.substr(0, hdf5_signature.size());
    if (head != hdf5_signature.substr(0, head.size()))
        throw unusable_file(fmt::format("'{}' is not a save file of kaya", name));
    Trailer trailer{};
    if (file.size() >= sizeof trailer)
        std::memcpy(&trailer, file.data() + file.size() - sizeof trailer, sizeof trailer);
    const std::string_view mark(trailer.mark.data(), trailer.mark.size());
    if (mark != trailer_mark || trailer.length != file.size() - sizeof trailer)
        throw unusable_file(fmt::format("'{}' is cut short, or another program wrote it", name));
    const auto image = file.substr(0, file.size() - sizeof trailer);
    if (digest_of(image) != trailer.digest)
        throw unusable_file(fmt::format("'{}' is damaged: its bytes are not those that were written", name));
    return image;
}

} // namespace kaya
